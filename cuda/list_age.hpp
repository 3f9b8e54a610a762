// Decides whether neighbour lists still hold all pairs. Falling fluid takes its neighbours along, so what
// counts is not how far a particle moved since the lists were built but how far it moved against those around
// it.
#pragma once

#include "backend/buffer.hpp"
#include "cells.hpp"

namespace slagflow {

struct ListReach {
  double support = 0;     // h [m]
  double fluid_skin = 0;  // a pair of fluid particles not listed is at least h + skin apart when listed
  double wall_skin = 0;   // the same for a fluid and a wall particle
  double width = 0;       // narrowest width of a cell [m]
};

// `sources`: the fluid as it was sorted, with its places now; `walls`: the walls, at rest; `start`: the
// places when the lists were built.
//
// With D_C the mean displacement in a cell C and e_C the largest deviation from it, two particles in cells C,
// C' approached each other by at most |D_C - D_C'| + e_C + e_C'. The lists hold while this is at most the
// skin for all cells that are at most two apart (with D = 0 for a wall), and while no particle moved farther
// than width - h/2, which keeps particles in cells further apart out of reach.
class ListAge {
 public:
  explicit ListAge(Context&);

  // `largest_displacement`: of any fluid particle since the lists were built [m].
  bool lists_hold(const SourceView& sources, const SourceView& walls, Span<const Quad> start,
                  const ListReach&, double largest_displacement);

 private:
  Context& context_;
  Buffer<Quad> displacement_;  // of each cell: xyz mean, w largest deviation, negative in an empty cell
  Buffer<Real> excess_;        // approach beyond the skin, of each cell
};

}  // namespace slagflow
