#include "host/geometry/site_bits.hpp"

#include "backend/host_loop.hpp"

namespace slagflow {
namespace {

constexpr std::size_t rows_at_once = 256;

}  // namespace

// A row's bits and those some steps before and behind them.
void SiteBits::widen_row(const Lattice& lattice, const Word* from, Word* to) const {
  const std::int64_t nx = count_[0], layers = lattice.layers();
  const auto bit = [](std::int64_t x) { return Word{1} << (x % width); };
  for (std::int64_t w = 0; w < words_; ++w) {
    const Word before = w > 0 ? from[w - 1] : 0, own = from[w], behind = w + 1 < words_ ? from[w + 1] : 0;
    to[w] = own;
    for (std::int64_t k = 1; k <= layers; ++k)
      to[w] |= (own << k) | (before >> (width - k)) | (own >> k) | (behind << (width - k));
  }
  if (nx % width != 0) to[words_ - 1] &= bit(nx) - 1;
  const std::int64_t ends = lattice.periodic(0) ? (nx < layers ? nx : layers) : 0;
  for (std::int64_t k = 0; k < ends; ++k)
    for (const std::int64_t x : {k, nx - 1 - k})
      for (std::int64_t step = -layers; (from[x / width] & bit(x)) != 0 && step <= layers; ++step) {
        SiteIndex s{x, 0, 0};
        lattice.move(s, 0, step);
        to[s[0] / width] |= bit(s[0]);
      }
}

// The bits of rows that are some steps apart along an axis.
SiteBits SiteBits::joined(const Lattice& lattice, int axis) const {
  SiteBits all(lattice);
  for_each_range(rows(), rows_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r)
      for (std::int64_t step = -lattice.layers(); step <= lattice.layers(); ++step) {
        SiteIndex s = first_of(r);
        if (!lattice.move(s, axis, step)) continue;
        const Word* const from = row(row_of(s));
        Word* const to = all.row(r);
        for (std::size_t w = 0; w < words(); ++w) to[w] |= from[w];
      }
  });
  return all;
}

SiteBits SiteBits::widened(const Lattice& lattice) const {
  SiteBits along(lattice);
  for_each_range(rows(), rows_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) widen_row(lattice, row(r), along.row(r));
  });
  return along.joined(lattice, 1).joined(lattice, 2);
}

}  // namespace slagflow
