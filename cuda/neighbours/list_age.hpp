// Decides whether neighbour lists still hold all pairs. Falling fluid takes its neighbours along, so what
// counts is not how far a particle moved since the lists were built but how far it moved against those around
// it.
#pragma once

#include "backend/buffer.hpp"
#include "fluid/step_record.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

struct ListReach {
  double support = 0;     // h [m]
  double fluid_skin = 0;  // a pair of fluid particles not listed is at least h + skin apart when listed
  double wall_skin = 0;   // the same for a fluid and a wall particle
  double width = 0;       // narrowest width of a cell [m]
};

// Particles as they were sorted when the lists were built, their places then and now.
struct MovedParticles {
  SourceView now;
  Span<const Quad> start;           // places when the lists were built; not needed of particles at rest
  double largest_displacement = 0;  // of any of them since [m]; 0: all are at rest
};

// With D_C the mean displacement in a cell C and e_C the largest deviation from it, two particles in cells C,
// C' approached each other by at most |D_C - D_C'| + e_C + e_C'. The lists hold while this is at most the
// skin for all cells that are at most two apart, the walls having a D and e of their own, and while no
// particle moved farther than width - h/2, which keeps particles in cells further apart out of reach.
class ListAge {
 public:
  explicit ListAge(Context&);

  bool lists_hold(const MovedParticles& fluid, const MovedParticles& walls, const ListReach&);

  // The same without waiting or, after reserve(), taking memory, with walls at rest: leaves the approach in
  // the record, and is idle where the record's displacement alone decides. Then the record decides.
  void reserve(const CellGrid&);
  void launch_approach(SourceView fluid, Span<const Quad> start, Span<const Index> wall_start,
                       const ListReach&, StepRecord*);
  static bool lists_hold(const StepRecord&, const ListReach&);

 private:
  struct Moves;
  void launch_approach(const Moves&, const MovedParticles& fluid, const MovedParticles& walls,
                       const ListReach&);

  Context& context_;
  // Of each cell: xyz mean, w largest deviation, negative in an empty cell.
  Buffer<Quad> displacement_, wall_displacement_;
  Buffer<double> approach_;
};

}  // namespace slagflow
