// What particles are sorted by. A header for .cu files.
#pragma once

#include <cstdint>

#include "neighbours/cells.hpp"

namespace slagflow {

// Behind every cell, and those behind what goes to another rank.
constexpr std::uint64_t leaving_key = std::uint64_t(1) << 63, departed_key = leaving_key | leaving_key >> 1;

// Sort key: cell in the upper, id in the lower 32 bits; of a particle in another slab its rank in place of
// the cell.
struct CellKey {
  CellGrid grid;
  Span<const int> cuts;  // the first planes of the ranks; empty: there is one rank

  HOST_DEVICE std::uint64_t operator()(Vec3 place, Index id) const {
    const auto low = static_cast<std::uint32_t>(id);
    if (cuts.size > 0) {
      const int plane = grid.plane_at(place), local = grid.local_plane(plane);
      if (local < 0 || local >= grid.slab.own) {
        int rank = 0;
        while (plane >= cuts[rank + 1]) ++rank;
        return leaving_key | static_cast<std::uint64_t>(rank) << 32 | low;
      }
    }
    return static_cast<std::uint64_t>(grid.cell_of(place)) << 32 | low;
  }
};

struct PlaceKey {
  CellKey of_cell;
  Span<const Quad> place;
  Span<const Index> id;
  Span<std::uint64_t> key;
  Span<Index> order;
  HOST_DEVICE void operator()(Index i) const {
    order[i] = i;
    key[i] = of_cell(xyz(place[i]), id[i]);
  }
};

}  // namespace slagflow
