// The fluid particles around a point. A header for .cu files.
#pragma once

#include "fluid/smoothing/smoothing.hpp"
#include "neighbours/ordering.hpp"

namespace slagflow {

struct AroundPoint {
  CellGrid grid;
  Span<const Index> cell_start;
  Span<const Quad> place;
  PeriodicBox box;
  Smoothing W;
  Real reach;  // of the support, from where the particles were sorted

  // Calls visit(j, d, r2) for the particles within the support of a place, d from them to it.
  template <class Visit>
  HOST_DEVICE void for_particles(Vec3 at, Visit visit) const {
    grid.for_cells_within(at, reach, [&](Index first, Index last) {
      for (Index j = cell_start[first]; j < cell_start[last + 1]; ++j) {
        const Vec3 d = box.separation(xyz(place[j]), at);
        const Real r2 = dot(d, d);
        if (r2 < square(W.support)) visit(j, d, r2);
      }
    });
  }
};

// The surface on a line and the length in fluid, from fills at points along it: they end where the fill
// passes a half, linear between two points.
struct LevelSearch {
  double surface = -1, thickness = 0;  // [m] from the start of the line; < 0: none yet
  double last_distance = 0, last_fill = 0;
  bool begun = false;

  HOST_DEVICE void add(double distance, double fill) {
    constexpr double half = 0.5;
    const bool from = last_fill >= half, to = fill >= half;
    if (begun && (from || to)) {
      const double length = distance - last_distance;
      const double crossing = from == to ? 0 : (half - last_fill) / (fill - last_fill) * length;
      thickness += from && to ? length : from ? crossing : length - crossing;
      surface = to ? distance : last_distance + crossing;
    }
    last_distance = distance, last_fill = fill, begun = true;
  }
};

}  // namespace slagflow
