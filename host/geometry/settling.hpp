// What particles that start off their lattice lose as they settle.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {

// Whether some fluid has neither fluid nor wall beside it at the start.
bool has_free_surface(const Case&, const Filling&);

// (rho - rho0)/rho0 that fluid loses as particles which start `jitter` spacings off their sites, along each
// axis, come to rest evenly spaced: the pair sums of the start have counted them as denser. Particle shifting
// brings them there by itself, and takes most of the loss. Measured in closed boxes, 2-D and 3-D, at
// jitter 0.05, 0.1, 0.2, 0.3, 0.4: 0.0017, 0.006, 0.022, 0.041, 0.053 with level, of that with shifting = 1
// 0.0008, 0.0022, 0.010, 0.024, 0.042, with 0.3 in 2-D 0.0033, 0.010, 0.022 at 0.1 to 0.3; with Lucy's
// function 0.16 to 0.28 jitter^2, with shifting = 1 0.11. numerics: with its shifting.
double settling_loss(const NumericsSetup& numerics, double jitter);

// [Pa] that fluid should start with if it is closed, without a free surface, and starts with none; 0 for what
// bears tension everywhere, and for Lucy's function, whose lattice resists shear under pressure. resolved:
// with its sound speed.
double automatic_background(const Case& resolved, const Filling&, bool closed);

// Warns of each region with jitter whose fluid has no free surface and loses more than a tenth of its
// pressure by that, and says with which pressure to start: under a free surface the fluid sinks by that share
// instead. resolved: with its sound speed.
void warn_of_settling(const Case& resolved, const Filling& filling, std::vector<std::string>& warnings);

}  // namespace slagflow
