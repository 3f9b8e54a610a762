// Fluid between a wall that moves and another that it moves towards.
#pragma once

#include "host/case/case.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {

// The mean speed at which moving walls press fluid out of the gaps before them, as they are at the start
// [m/s]: U A/S, A the area of the gap across the motion and S that of its sides that are open; U L/(2 gap)
// before a plate. 0 where no gap is closed in by another wall, or none has a way out.
double squeeze_speed(const Case& c, const StartSites& sites);

// The fastest that a wall moves along an axis, one way [m/s]; rotation left out.
double speed_along(const WallMotion& motion, int axis, int way);

}  // namespace slagflow
