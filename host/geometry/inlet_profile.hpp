// The developed flow of any fluid through a slot, a pipe or an annulus.
#pragma once

#include <functional>

#include "fluid/models.hpp"

namespace slagflow {

// Velocity over its mean, of a place across the section [m]: of a slot of height `height` the distance from
// its middle, else that from the axis. Steady and without slip: the stress follows from the balance of forces
// (linear in a slot and a pipe; G/2 (r - a^2/r) in an annulus, with the radius a of no stress where both
// walls hold), the shear rate from the flow curve, the velocity from its integral; by bisection until the
// mean is `mean` [m/s] > 0. R. B. Bird, W. E. Stewart, E. N. Lightfoot, Transport Phenomena, 2nd ed. (2002),
// chapters 2 and 8.
using SpeedShare = std::function<double(double)>;
SpeedShare developed_slot(const Rheology&, double height, double mean);
SpeedShare developed_pipe(const Rheology&, double radius, double mean);
SpeedShare developed_annulus(const Rheology&, double inner_radius, double radius, double mean);

}  // namespace slagflow
