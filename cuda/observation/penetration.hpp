// Fluid particles that may be inside walls.
#pragma once

#include <vector>

#include "neighbours/pairs.hpp"

namespace slagflow {

// Looks for the fluid particles that are below the face of a wall particle less than 1.3 spacings away, or of
// the nearest one where none is as near; in a thin plate, below both its faces. All particles half a spacing
// or more inside of a wall are among them, up to the reach of the lists. Beside a convex edge it is no more
// than a suspicion, since the plane of a face goes on where the wall does not: who knows the shapes decides.
// Walls are where they were in the last step.
class BelowFaces {
 public:
  explicit BelowFaces(Context&);

  // Their positions [m], relative to the domain's lower corner as `position` is.
  std::vector<Vec3d> find(const PairContext&, Span<const Vec3d> position);

 private:
  Context& context_;
  Buffer<Offset> flag_, rank_;  // kept from look to look, so that a step's arrays stay where they are
  Buffer<Vec3d> kept_;
};

}  // namespace slagflow
