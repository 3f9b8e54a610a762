#include "host/geometry/touching.hpp"

#include <algorithm>

namespace slagflow {
namespace {

// Rows of fluid along x, joined where they touch.
class Rows {
 public:
  explicit Rows(const StartSites& sites) : sites_(sites), lattice_(sites.lattice()) {
    const auto [nx, ny, nz] = lattice_.count();
    begin_.assign(static_cast<std::size_t>(ny * nz) + 1, 0);
    sites.for_each_row([&](std::size_t first, std::size_t count) {
      const SiteIndex s = sites.index(first);
      rows_.push_back({s, s[0] + static_cast<std::int64_t>(count)});
      ++begin_[line(s) + 1];
    });
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  }

  FluidBodies find() {
    Sets sets(rows_.size());
    for (std::size_t r = 0; r < rows_.size(); ++r) join(r, sets);
    std::vector<std::uint32_t> row(sites_.particles());
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::size_t first = lattice_.linear(rows_[r].first), root = sets.root(r);
      const auto count = static_cast<std::size_t>(rows_[r].end - rows_[r].first[0]);
      for (std::size_t k = 0; k < count; ++k)
        row[static_cast<std::size_t>(sites_.fluid(first + k))] = static_cast<std::uint32_t>(root);
    }
    return numbered_bodies(row.size(), rows_.size(), [&](std::size_t i) { return row[i]; });
  }

 private:
  struct Row {
    SiteIndex first;
    std::int64_t end;  // along x, not included
  };

  std::size_t line(const SiteIndex& s) const {
    return static_cast<std::size_t>(s[1] + lattice_.count()[1] * s[2]);
  }

  void join(std::size_t r, Sets& sets) const {
    const std::int64_t first = rows_[r].first[0], end = rows_[r].end, nx = lattice_.count()[0];
    for (std::int64_t k = 0; k < 9; ++k) {
      SiteIndex s = rows_[r].first;
      if (!lattice_.move(s, 1, k % 3 - 1) || !lattice_.move(s, 2, k / 3 - 1)) continue;
      join_across(r, line(s), {first - 1, end + 1}, sets);
      if (!lattice_.periodic(0)) continue;
      if (first == 0) join_across(r, line(s), {nx - 1, nx}, sets);
      if (end == nx) join_across(r, line(s), {0, 1}, sets);
    }
  }

  struct Range {
    std::int64_t first, end;
  };
  void join_across(std::size_t r, std::size_t line, Range range, Sets& sets) const {
    const auto at = [&](std::size_t k) { return rows_.begin() + static_cast<std::ptrdiff_t>(k); };
    const auto last = at(begin_[line + 1]);
    auto other =
        std::partition_point(at(begin_[line]), last, [&](const Row& row) { return row.end <= range.first; });
    for (; other != last && other->first[0] < range.end; ++other)
      sets.join(r, static_cast<std::size_t>(other - rows_.begin()));
  }

  const StartSites& sites_;
  const Lattice& lattice_;
  std::vector<Row> rows_;           // in the order of the lattice
  std::vector<std::size_t> begin_;  // of each line of sites, its first row
};

}  // namespace

FluidBodies touching_bodies(const StartSites& sites) { return Rows(sites).find(); }

}  // namespace slagflow
