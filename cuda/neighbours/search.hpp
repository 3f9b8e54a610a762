// The search for the neighbours of one particle.
#pragma once

#include "fluid/lane_math.hpp"
#include "fluid/params.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

// Calls found(j, lanes) for sources j, j + 1, ... of which those whose bit is set in `lanes` are within reach
// of target i, in ascending order within each run of cells.
template <class Box>
struct Search {
  SourceView sources;
  Span<const Quad> targets;
  Box box;
  Real reach;
  int range;  // the same in cells
  bool self;
  Span<const std::uint8_t> occupied;  // 0: no source within reach of any place in the cell; empty: not known

  template <class Found>
  HOST_DEVICE void operator()(Index i, Found found) const {
    const Vec3 here = xyz(targets[i]);
    if (occupied.size > 0 && !occupied[sources.grid.cell_of(here)]) return;
    const LaneVec3 centre = in_lanes(here);
    sources.grid.for_cells_within(here, reach, [&](Index first, Index last) {
      const Index end = sources.cell_start[last + 1];
      for (Index j = sources.cell_start[first]; j < end; j += lane_count) {
        const LaneVec3 d = box.separation(centre, xyz(load_lanes(sources.place, j)));
        unsigned lanes = bits(dot(d, d) < Lanes(square(reach)));
        if (end - j < lane_count) lanes &= (1u << (end - j)) - 1;
        if (self && i >= j && i < j + lane_count) lanes &= ~(1u << (i - j));
        found(j, lanes);
      }
    });
  }
};

}  // namespace slagflow
