// A grid of cells over the domain, and where each cell's particles stand in a sorted array.
#pragma once

#include <array>

#include "backend/buffer.hpp"
#include "backend/slabs.hpp"
#include "fluid/math.hpp"
#include "fluid/params.hpp"

namespace slagflow {

// How cells are numbered: along one axis after the other, the fastest first. The axis with the most cells is
// the slowest, so that the particles of a slab across it stand in one piece; that with the most of the others
// is the fastest, for long runs.
struct AxisOrder {
  int axis[3] = {0, 1, 2};  // from the fastest to the slowest
  static AxisOrder of(const int (&count)[3]);
};

// The steps in the number of a cell to the next along each axis.
struct Strides {
  Index along[3] = {1, 1, 1};
  Strides() = default;
  Strides(const int (&count)[3], const AxisOrder& order) {
    Index next = 1;
    for (const int axis : order.axis) along[axis] = next, next *= count[axis];
  }
  HOST_DEVICE Index operator[](int axis) const { return along[axis]; }
};

// Places outside of the grid belong to its border cells: two places are never fewer cells apart than their
// distance asks for. A rank among several has a slab of it: counts and widths are those of the whole grid,
// numbers of cells those of the slab, whose cells follow each other as its planes do (slabs.hpp).
struct CellGrid {
  int count[3] = {1, 1, 1};
  Vec3 inverse_width;    // [1/m]
  double narrowest = 0;  // width of a cell along its narrowest axis [m]
  bool periodic[3] = {false, false, false};
  AxisOrder order;
  Strides stride;
  Slab slab;

  // Cells at least `width` wide over a domain of the given extent [m]; wider, where there were more than
  // `most` of them.
  static constexpr double usual_most = 1 << 24;
  static CellGrid cover(Vec3d extent, const std::array<bool, 3>& periodic, double width,
                        double most = usual_most);

  // Planes of one cell's width across the slowest axis, and the cells of each, which follow each other.
  Index planes() const { return slab.own; }
  HOST_DEVICE Index cells_of_plane() const { return lines[2].stride; }

  HOST_DEVICE Index cells() const { return slab.planes() * lines[2].stride; }
  HOST_DEVICE Index own_cells() const { return slab.own * lines[2].stride; }
  // In the slab with its halo.
  HOST_DEVICE Index cell_of(Vec3 place) const {
    return local_plane(plane_at(place)) * lines[2].stride + in_plane(place);
  }
  // In the whole grid.
  HOST_DEVICE int plane_at(Vec3 place) const { return along(lines[2], place[order.axis[2]]); }
  // As the slab numbers the plane, -1: it is neither in it nor in its halo.
  HOST_DEVICE int local_plane(int plane) const {
    int up = plane - slab.first;
    if (up < 0) up += lines[2].count;
    if (up < slab.own + slab.above) return up;
    const int down = lines[2].count - up;
    return down <= slab.below ? slab.planes() - down : -1;
  }
  // In the whole grid, of a cell of the slab.
  HOST_DEVICE int plane_of(Index cell) const {
    const int local = cell / lines[2].stride;
    const int plane = slab.first + local - (local < slab.own + slab.above ? 0 : slab.planes());
    return plane < 0 ? plane + lines[2].count : (plane >= lines[2].count ? plane - lines[2].count : plane);
  }

  // Calls visit(first_cell, last_cell) for runs of cells that follow each other in memory and together hold
  // every place closer than `reach` [m] to `place`, each cell once, in ascending order.
  template <class Visit>
  HOST_DEVICE void for_cells_within(Vec3 place, Real reach, Visit visit) const {
    const Real wide = reach * Real(1.001);  // rounding must not lose a place
    const Vec3 at{place[order.axis[0]], place[order.axis[1]], place[order.axis[2]]};
    const Around rows = around(lines[1], at.y, wide), planes = around(lines[2], at.z, wide);
    for_line(lines[2], planes, [&](int k, int global) {
      const int plane = local_plane(global);
      if (plane < 0) return;
      const Real beyond_plane = square(wide) - square(gap(lines[2], k, at.z, planes));
      for_line(lines[1], rows, [&](int j, int row) {
        const Real beyond = beyond_plane - square(gap(lines[1], j, at.y, rows));
        if (beyond <= 0) return;
        visit_run(plane * lines[2].stride + row * lines[1].stride, around(lines[0], at.x, std::sqrt(beyond)),
                  visit);
      });
    });
  }

  // Calls visit(other) for the cells up to `range` away along one axis, in the order of speed, `cell`
  // included.
  template <class Visit>
  HOST_DEVICE void for_line_around(Index cell, int speed, int range, Visit visit) const {
    const Line& line = lines[speed];
    const int local = speed == 2 ? cell / line.stride : cell / line.stride % line.count;
    const Around all = around(line, speed == 2 ? plane_of(cell) : local, range);
    for (int k = all.first; k <= all.last; ++k) {
      const int other = speed == 2 ? local_plane(wrapped(line, k)) : wrapped(line, k);
      if (other >= 0) visit(cell + (other - local) * line.stride);
    }
  }

  // Calls visit(first_cell, last_cell) for the cells up to `range` away from `cell` along each axis, itself
  // included, each once, in runs that follow each other in memory, in ascending order.
  template <class Visit>
  HOST_DEVICE void for_runs_around(Index cell, int range, Visit visit) const {
    const int c[3] = {cell % lines[0].count, cell / lines[1].stride % lines[1].count, plane_of(cell)};
    const Around run = around(lines[0], c[0], range), rows = around(lines[1], c[1], range);
    for_line(lines[2], around(lines[2], c[2], range), [&](int, int global) {
      const int plane = local_plane(global);
      if (plane < 0) return;
      for_line(lines[1], rows,
               [&](int, int row) { visit_run(plane * lines[2].stride + row * lines[1].stride, run, visit); });
    });
  }

  HOST_DEVICE int step_along(Index cell, int axis) const {
    return axis == order.axis[2] ? plane_of(cell) : cell / stride[axis] % count[axis];
  }

 private:
  HOST_DEVICE Index in_plane(Vec3 place) const {
    return along(lines[1], place[order.axis[1]]) * lines[1].stride + along(lines[0], place[order.axis[0]]);
  }
  // The cells along an axis.
  struct Line {
    int count = 1;
    Index stride = 1;
    Real inverse_width = 0;  // [1/m]
    bool periodic = false;
  };
  Line lines[3];  // from the fastest axis to the slowest

  struct Around {
    int first, last;  // beyond the ends on a periodic axis only
  };

  HOST_DEVICE static Around around(const Line& line, int c, int range) {
    if (!line.periodic) return {larger(c - range, 0), smaller(c + range, line.count - 1)};
    if (2 * range + 1 >= line.count) return {0, line.count - 1};
    return {c - range, c + range};
  }

  // The cells along an axis that hold places closer than `reach` to a coordinate. On a periodic axis they go
  // on beyond the ends, from the coordinate as it is.
  HOST_DEVICE static Around around(const Line& line, Real coordinate, Real reach) {
    if (!line.periodic) return {along(line, coordinate - reach), along(line, coordinate + reach)};
    const int first = static_cast<int>(std::floor((coordinate - reach) * line.inverse_width));
    const int last = static_cast<int>(std::floor((coordinate + reach) * line.inverse_width));
    if (last - first + 1 >= line.count) return {0, line.count - 1};
    return {first, last};
  }

  HOST_DEVICE static int along(const Line& line, Real coordinate) {
    const auto n = static_cast<Real>(line.count);
    Real scaled = std::floor(coordinate * line.inverse_width);
    if (line.periodic) scaled -= n * std::floor(scaled / n);
    return scaled > 0 ? (scaled < n ? smaller(static_cast<int>(scaled), line.count - 1) : line.count - 1) : 0;
  }

  // Least distance of a coordinate from the places in cell c along an axis [m]; 0 where the cells of `all`
  // come once around a periodic axis. Border cells have no outer end.
  HOST_DEVICE static Real gap(const Line& line, int c, Real coordinate, Around all) {
    if (line.periodic && all.last - all.first + 1 == line.count) return 0;
    const Real scaled = coordinate * line.inverse_width;
    const Real below = line.periodic || c > 0 ? static_cast<Real>(c) - scaled : Real(0);
    const Real above = line.periodic || c < line.count - 1 ? scaled - static_cast<Real>(c + 1) : Real(0);
    return larger(Real(0), larger(below, above)) / line.inverse_width;
  }

  HOST_DEVICE static int wrapped(const Line& line, int c) {
    const int n = line.count;
    return c < 0 ? (c % n + n) % n : (c >= n ? c % n : c);
  }

  // Calls visit(c, cell) for the cells along an axis, in ascending order: c goes on beyond the ends of a
  // periodic axis, `cell` is the one it comes round to.
  template <class Visit>
  HOST_DEVICE static void for_line(const Line& line, Around all, Visit visit) {
    const int n = line.count;
    const int below = smaller(all.last, -1), above = larger(all.first, n);  // what comes round
    for (int c = above; c <= all.last; ++c) visit(c, wrapped(line, c));
    for (int c = larger(all.first, 0); c <= smaller(all.last, n - 1); ++c) visit(c, c);
    for (int c = all.first; c <= below; ++c) visit(c, wrapped(line, c));
  }

  // Along the fastest axis, from the first cell of a line.
  template <class Visit>
  HOST_DEVICE void visit_run(Index line, Around run, Visit visit) const {
    const int n = lines[0].count, first = wrapped(lines[0], run.first), last = first + run.last - run.first;
    if (last >= n) visit(line, line + last - n);
    visit(line + first, line + smaller(last, n - 1));
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
