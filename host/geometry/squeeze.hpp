// Fluid between a wall that moves and another that it moves towards.
#pragma once

#include "host/case/case.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {

// What moving walls do to the fluid in the gaps before them, as they are at the start; the largest of all
// gaps. 0 where no gap is closed in by another wall, or none has a way out.
struct Squeeze {
  // [m/s] at which fluid is pressed out: U A/S, A the area of the gap across the motion and S that of its
  // sides that are open; U L/(2 gap) before a plate.
  double speed = 0;
  // [m/s] sqrt(2 p/rho) of the pressure that this takes, p = 2 tau l/gap, tau the stress of a flow between
  // plates at that speed on its walls and l = V/S the mean way out: 3 eta U R^2/gap^3 below a disc, twice
  // what it is below a long plate, and what a yield stress alone holds.
  double film = 0;
};
Squeeze squeeze(const Case& c, const StartSites& sites, const std::vector<std::uint8_t>& fluid);

// The fastest that a wall moves along an axis, one way [m/s]; rotation left out.
double speed_along(const WallMotion& motion, int axis, int way);

}  // namespace slagflow
