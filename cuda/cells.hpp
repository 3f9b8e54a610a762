// A grid of cells over the domain, and where each cell's particles stand in a sorted array.
#pragma once

#include <array>

#include "backend/buffer.hpp"
#include "math.hpp"
#include "params.hpp"

namespace slagflow {

// Places outside of the grid belong to its border cells: two places are never fewer cells apart than their
// distance asks for.
struct CellGrid {
  int count[3] = {1, 1, 1};
  Vec3 inverse_width;    // [1/m]
  double narrowest = 0;  // width of a cell along its narrowest axis [m]
  bool periodic[3] = {false, false, false};

  // Cells at least `width` wide over a domain of the given extent [m].
  static CellGrid cover(Vec3d extent, const std::array<bool, 3>& periodic, double width);

  HOST_DEVICE Index cells() const { return count[0] * count[1] * count[2]; }
  HOST_DEVICE int along(int axis, Real coordinate) const {
    const int n = count[axis];
    const Real scaled = std::floor(coordinate * inverse_width[axis]);
    if (periodic[axis]) {
      const int c = static_cast<int>(scaled) % n;
      return c < 0 ? c + n : c;
    }
    return scaled > 0 ? (scaled < Real(n) ? smaller(static_cast<int>(scaled), n - 1) : n - 1) : 0;
  }
  HOST_DEVICE Index cell_of(Vec3 place) const {
    return (along(2, place.z) * count[1] + along(1, place.y)) * count[0] + along(0, place.x);
  }

  // Calls visit(first_cell, last_cell) for runs of cells that follow each other in memory and together are
  // the cell of `place` and those up to `range` cells away, each once.
  template <class Visit>
  HOST_DEVICE void for_neighbour_cells(Vec3 place, int range, Visit visit) const {
    const Around x = around(0, along(0, place.x), range);
    for_rows_around(along(1, place.y), along(2, place.z), range, [&](Index row) {
      const int n = count[0];
      visit(row + larger(x.first, 0), row + smaller(x.last, n - 1));
      if (x.first < 0) visit(row + n + x.first, row + n - 1);
      if (x.last >= n) visit(row, row + x.last - n);
    });
  }

  // Calls visit(cell) for the cells up to `range` away from cell (x, y, z), itself included, each once.
  template <class Visit>
  HOST_DEVICE void for_cells_around(int cx, int cy, int cz, int range, Visit visit) const {
    const Around x = around(0, cx, range);
    for_rows_around(cy, cz, range, [&](Index row) {
      for (int c = x.first; c <= x.last; ++c) visit(row + wrapped(0, c));
    });
  }

 private:
  struct Around {
    int first, last;  // beyond the ends on a periodic axis only
  };

  HOST_DEVICE Around around(int axis, int c, int range) const {
    const int n = count[axis];
    if (!periodic[axis]) return {larger(c - range, 0), smaller(c + range, n - 1)};
    if (2 * range + 1 >= n) return {0, n - 1};
    return {c - range, c + range};
  }

  HOST_DEVICE int wrapped(int axis, int c) const {
    const int n = count[axis];
    return c < 0 ? c + n : (c >= n ? c - n : c);
  }

  // Calls visit(row) with the first cell of each row in x.
  template <class Visit>
  HOST_DEVICE void for_rows_around(int cy, int cz, int range, Visit visit) const {
    const Around y = around(1, cy, range), z = around(2, cz, range);
    for (int k = z.first; k <= z.last; ++k)
      for (int j = y.first; j <= y.last; ++j) visit((wrapped(2, k) * count[1] + wrapped(1, j)) * count[0]);
  }
};

// First particle of each cell in an array sorted by cell: particles [start[c], start[c+1]) are in cell c.
struct CellRanges {
  explicit CellRanges(Context& c) : start(c, "cell starts") {}
  Buffer<Index> start;

  // `keys`: sorted, the cell in the upper 32 bits; `count` of them are in cells.
  void find(Context&, const CellGrid&, Span<const std::uint64_t> keys, Index count);
};

// The sources, sorted by cell.
struct SourceView {
  CellGrid grid;
  Span<const Index> cell_start;
  Span<const Quad> place;
};

}  // namespace slagflow
