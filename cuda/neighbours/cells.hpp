// A grid of cells over the domain, and where each cell's particles stand in a sorted array.
#pragma once

#include <array>

#include "backend/buffer.hpp"
#include "fluid/math.hpp"
#include "fluid/params.hpp"

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
    Real scaled = std::floor(coordinate * inverse_width[axis]);
    if (periodic[axis]) scaled -= Real(n) * std::floor(scaled / Real(n));
    return scaled > 0 ? (scaled < Real(n) ? smaller(static_cast<int>(scaled), n - 1) : n - 1) : 0;
  }
  HOST_DEVICE Index cell_of(Vec3 place) const {
    return (along(2, place.z) * count[1] + along(1, place.y)) * count[0] + along(0, place.x);
  }

  // Calls visit(first_cell, last_cell) for runs of cells that follow each other in memory and together hold
  // every place closer than `reach` [m] to `place`, each cell once, in ascending order.
  template <class Visit>
  HOST_DEVICE void for_cells_within(Vec3 place, Real reach, Visit visit) const {
    const Real wide = reach * Real(1.001);  // rounding must not lose a place
    const Around y = around(1, place.y, wide), z = around(2, place.z, wide);
    for_line(2, z, [&](int k, int cell_z) {
      const Real beyond_z = square(wide) - square(gap(2, k, place.z, z));
      for_line(1, y, [&](int j, int cell_y) {
        const Real beyond = beyond_z - square(gap(1, j, place.y, y));
        if (beyond <= 0) return;
        visit_run((cell_z * count[1] + cell_y) * count[0], around(0, place.x, std::sqrt(beyond)), visit);
      });
    });
  }

  // Calls visit(other) for the cells up to `range` away along one axis, `cell` included.
  template <class Visit>
  HOST_DEVICE void for_line_around(Index cell, int axis, int range, Visit visit) const {
    const Index step = axis == 0 ? 1 : (axis == 1 ? count[0] : count[0] * count[1]);
    const int c = cell / step % count[axis];
    const Around line = around(axis, c, range);
    for (int k = line.first; k <= line.last; ++k) visit(cell + (wrapped(axis, k) - c) * step);
  }

  // Calls visit(first_cell, last_cell) for the cells up to `range` away from `cell` along each axis, itself
  // included, each once, in runs that follow each other in memory, in ascending order.
  template <class Visit>
  HOST_DEVICE void for_runs_around(Index cell, int range, Visit visit) const {
    const Around x = around(0, cell % count[0], range);
    for_rows_around(cell / count[0] % count[1], cell / count[0] / count[1], range,
                    [&](Index row) { visit_run(row, x, visit); });
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

  // The cells along an axis that hold places closer than `reach` to a coordinate. On a periodic axis they go
  // on beyond the ends, from the coordinate as it is.
  HOST_DEVICE Around around(int axis, Real coordinate, Real reach) const {
    if (!periodic[axis]) return {along(axis, coordinate - reach), along(axis, coordinate + reach)};
    const int first = static_cast<int>(std::floor((coordinate - reach) * inverse_width[axis]));
    const int last = static_cast<int>(std::floor((coordinate + reach) * inverse_width[axis]));
    if (last - first + 1 >= count[axis]) return {0, count[axis] - 1};
    return {first, last};
  }

  // Least distance of a coordinate from the places in cell c along an axis [m]; 0 where the cells of `all`
  // come once around a periodic axis. Border cells have no outer end.
  HOST_DEVICE Real gap(int axis, int c, Real coordinate, Around all) const {
    const bool ring = periodic[axis];
    if (ring && all.last - all.first + 1 == count[axis]) return 0;
    const Real scaled = coordinate * inverse_width[axis];
    const Real below = ring || c > 0 ? static_cast<Real>(c) - scaled : Real(0);
    const Real above = ring || c < count[axis] - 1 ? scaled - static_cast<Real>(c + 1) : Real(0);
    return larger(Real(0), larger(below, above)) / inverse_width[axis];
  }

  HOST_DEVICE int wrapped(int axis, int c) const {
    const int n = count[axis];
    return c < 0 ? (c % n + n) % n : (c >= n ? c % n : c);
  }

  // Calls visit(c, cell) for the cells along an axis, in ascending order: c goes on beyond the ends of a
  // periodic axis, `cell` is the one it comes round to.
  template <class Visit>
  HOST_DEVICE void for_line(int axis, Around line, Visit visit) const {
    const int n = count[axis];
    const int below = smaller(line.last, -1), above = larger(line.first, n);  // what comes round
    for (int c = above; c <= line.last; ++c) visit(c, wrapped(axis, c));
    for (int c = larger(line.first, 0); c <= smaller(line.last, n - 1); ++c) visit(c, c);
    for (int c = line.first; c <= below; ++c) visit(c, wrapped(axis, c));
  }

  // Calls visit(row) with the first cell of each row in x.
  template <class Visit>
  HOST_DEVICE void for_rows_around(int cy, int cz, int range, Visit visit) const {
    const Around y = around(1, cy, range), z = around(2, cz, range);
    for_line(2, z, [&](int, int cell_z) {
      for_line(1, y, [&](int, int cell_y) { visit((cell_z * count[1] + cell_y) * count[0]); });
    });
  }

  template <class Visit>
  HOST_DEVICE void visit_run(Index row, Around x, Visit visit) const {
    const int n = count[0], first = wrapped(0, x.first), last = first + x.last - x.first;
    if (last >= n) visit(row, row + last - n);
    visit(row + first, row + smaller(last, n - 1));
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
