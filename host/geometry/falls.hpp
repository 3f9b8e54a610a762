// How fast fluid will meet walls and other fluid, from where it is at the start.
#pragma once

#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {

// Fluid that touches at the start, or has at most two open sites between it and fluid below.
FluidBodies fluid_bodies(const Case& c, const StartSites& sites, const FluidBodies& touching);

// The largest speeds at which fluid will meet a wall or fluid at rest inside of the domain [m/s]: of bodies
// that fly, which strike with a whole face, and of streams off edges. 0 where nothing falls by more than two
// spacings. Walls that move or vanish count on the way but hold nothing: fluid goes on from them. What leaves
// the domain on its way does not count. A body that rests on nothing flies along its parabola. One that
// rests, by any part, may spread over the floors that it can reach downhill, and what falls or leaps off
// their edges has the speed of a fall from its surface; after a fall, from its depth above where it lands.
struct ImpactSpeeds {
  double body = 0, stream = 0;
};
ImpactSpeeds impact_speeds(const Case& c, const StartSites& sites, const FluidParticles& fluid,
                           const FluidBodies& bodies);

}  // namespace slagflow
