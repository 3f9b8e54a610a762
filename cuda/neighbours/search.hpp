// The search for the neighbours of one particle.
#pragma once

#include "fluid/lane_math.hpp"
#include "fluid/params.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

// Cells that hold all that comes within reach of particles that were sorted some time ago, and since then
// moved no farther than the lists allow (list_age.hpp), around their own.
inline constexpr int cells_moved = 2;

// Calls found(j, lanes) for sources j, j + 1, ... of which those whose bit is set in `lanes` are within reach
// of target i, in ascending order.
template <class Box>
struct Search {
  SourceView sources;
  Span<const Quad> targets;
  Box box;
  Real reach;
  bool self;
  Span<const std::uint8_t> occupied;  // of each cell, 0: no source near; empty: not known
  Span<const Index> cell{};           // of each target when they were sorted; empty: they are now

  template <class Found>
  HOST_DEVICE void operator()(Index i, Found found) const {
    const Vec3 here = xyz(targets[i]);
    const bool moved = cell.size > 0;
    if (occupied.size > 0 && !occupied[moved ? cell[i] : sources.grid.cell_of(here)]) return;
    const LaneVec3 centre = in_lanes(here);
    const auto visit = [&](Index first, Index last) { find_in(first, last, i, centre, found); };
    if (moved)
      sources.grid.for_runs_around(cell[i], cells_moved, visit);
    else
      sources.grid.for_cells_within(here, reach, visit);
  }

  template <class Found>
  HOST_DEVICE void find_in(Index first, Index last, Index i, LaneVec3 centre, Found found) const {
    const Index end = sources.cell_start[last + 1];
    for (Index j = sources.cell_start[first]; j < end; j += lane_count) {
      const LaneVec3 d = box.separation(centre, xyz(load_lanes(sources.place, j)));
      unsigned lanes = bits(dot(d, d) < Lanes(square(reach)));
      if (end - j < lane_count) lanes &= (1u << (end - j)) - 1;
      if (self && i >= j && i < j + lane_count) lanes &= ~(1u << (i - j));
      found(j, lanes);
    }
  }
};

}  // namespace slagflow
