// The numerical sound speed that a case asks for: a multiple of each speed that it will see.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {

struct SoundSpeedTerm {
  std::string name;
  double factor = 0;
  double speed = 0;  // [m/s]
  std::string what;  // where the speed comes from

  double sound_speed() const { return factor * speed; }
};

// depth: 11 sqrt(2 g H), H the depth of the deepest body of fluid that hangs together: ten times the speed of
// a fall through it, and a tenth to spare, keeps the density within 1 %. impact: 5 times the speed at which
// streams will meet walls and fluid at rest in the domain, 10 times that of bodies, whose flat blow
// compresses by some 2.2 Mach numbers. walls, start, squeeze: 10 times the fastest wall, the fastest fluid at
// the start, the fluid that walls press out of gaps. film, pressure, tension: so that the pressure that this
// takes, or a region's own, compresses the fluid as little as its depth may, and the pull of a surface no
// more. In this order.
std::vector<SoundSpeedTerm> sound_speed_terms(const Case& c, const Filling& filling);

// Of the largest; of none when there is none.
const SoundSpeedTerm& ruling(const std::vector<SoundSpeedTerm>& terms);

// Bounds of the speed of each wall's surface by its motion, the wall's shape and axis as at the start [m/s].
std::vector<double> motion_speeds(const Case& c, const WallParticles& walls);

}  // namespace slagflow
