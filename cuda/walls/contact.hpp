// What keeps fluid out of walls whatever its density says.
#pragma once

#include "fluid/lane_math.hpp"
#include "fluid/params.hpp"

namespace slagflow {

// Wall particles push by pressure alone, and fluid that has none, a jet or spray, would drift through them:
// what it loses in fluid around it, it gains in wall, and its density stays at rest. So a particle that is
// below a surface presses on the wall with at least
//   p = rho0 c0^2 depth/dx.
// That depends on the place alone: what it takes on impact it gives back. (Begun a quarter of a spacing above
// the surface it hastens thin films, by 5 % in a discharge.)
// Above the surface there is none: the wall may pull.
constexpr Real no_contact = Real(-1e30);

HOST_DEVICE inline Real contact_pressure(const FlowConstants& flow, Real rest_density, Real distance) {
  return distance < 0 ? -rest_density * flow.sound_speed_squared * distance / flow.spacing : no_contact;
}

// Distance of the fluid particle from the part of the surface above the wall particle, or a large number
// where it does not stand between the two or above. Inside a thin plate the face that is nearer counts.
template <class T, class Face>  // Real and Quad, or Lanes and QuadLanes
HOST_DEVICE T distance_before(const WallPairGeometry<T, Face>& pair, Real spacing) {
  // What a wall particle carries reaches half a spacing aside along each axis. Any further, and a surface
  // would go on beyond its edge and throw out what falls past it.
  constexpr Real width = Real(0.51), none = Real(1e30);
  const Vector3<T> d = pair.fluid_minus_wall;
  const T height = dot(d, xyz(pair.normal)), front = height - pair.normal.w;
  const T distance = select(pair.back.w > T(0), larger(front, dot(d, xyz(pair.back)) - pair.back.w), front);
  const Vector3<T> aside = d - height * xyz(pair.normal);
  const T most = larger(larger(magnitude(aside.x), magnitude(aside.y)), magnitude(aside.z));
  return select((most < T(width * spacing)) & (height > T(0)), distance, T(none));
}

}  // namespace slagflow
