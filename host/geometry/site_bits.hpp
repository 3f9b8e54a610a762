// A bit for each site of a lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "host/geometry/geometry.hpp"

namespace slagflow {

// Each row of sites along x begins with a word of its own, so that threads may share the rows.
class SiteBits {
 public:
  using Word = std::uint64_t;
  static constexpr std::int64_t width = 64;  // sites of a word

  explicit SiteBits(const Lattice& lattice)
      : count_(lattice.count()),
        words_((count_[0] + width - 1) / width),
        bits_(static_cast<std::size_t>(words_) * rows(), 0) {}

  std::size_t rows() const { return static_cast<std::size_t>(count_[1] * count_[2]); }
  std::size_t words() const { return static_cast<std::size_t>(words_); }  // of a row
  SiteIndex first_of(std::size_t row) const {
    const auto r = static_cast<std::int64_t>(row);
    return {0, r % count_[1], r / count_[1]};
  }
  std::size_t row_of(const SiteIndex& s) const { return static_cast<std::size_t>(s[1] + count_[1] * s[2]); }
  Word* row(std::size_t r) { return bits_.data() + r * words(); }
  const Word* row(std::size_t r) const { return bits_.data() + r * words(); }

  // Where a site has its bit; steps along x change it by 1, along y by width words(), and so on.
  std::int64_t place(const SiteIndex& s) const { return s[0] + width * words_ * (s[1] + count_[1] * s[2]); }
  bool at(std::int64_t place) const {
    return (bits_[static_cast<std::size_t>(place / width)] >> (place % width) & 1) != 0;
  }
  bool test(const SiteIndex& s) const { return at(place(s)); }
  void set(const SiteIndex& s) {
    bits_[static_cast<std::size_t>(place(s) / width)] |= Word{1} << (place(s) % width);
  }

  // All sites at most as many steps away as a wall has layers, along each axis and round periodic ones.
  SiteBits widened(const Lattice& lattice) const;

 private:
  void widen_row(const Lattice& lattice, const Word* from, Word* to) const;
  SiteBits joined(const Lattice& lattice, int axis) const;

  SiteIndex count_;
  std::int64_t words_;
  std::vector<Word> bits_;
};

}  // namespace slagflow
