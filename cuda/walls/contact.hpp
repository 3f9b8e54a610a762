// What keeps fluid out of walls whatever its density says.
#pragma once

#include "fluid/lane_math.hpp"
#include "neighbours/pairs.hpp"

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

// Whether the fluid particle at d from the wall particle stands above it, as seen along a face of the wall.
// What a wall particle carries reaches half a spacing aside along each axis.
HOST_DEVICE inline bool stands_above(Vec3 d, Vec3 normal, Real spacing) {
  constexpr Real width = Real(0.51);
  const Real height = dot(d, normal);
  const Vec3 aside = d - height * normal;
  const Real most = larger(larger(magnitude(aside.x), magnitude(aside.y)), magnitude(aside.z));
  return most < width * spacing && height > 0;
}

// What a fluid particle must be nearer to a wall particle than, to be below its surface: one at the surface,
// in the middle between four wall particles half a spacing deep, has them 0.88 spacings away. (Fluid at rest
// has 1.)
constexpr Real contact_reach = Real(0.95);  // [spacings]

// Distance of fluid particle i from the nearest face of a wall that it stands before or is below of; a large
// number where there is none. A wall particle has the normal of one face, at a convex edge it belongs to
// more: those of other wall particles, when the part of the surface above each of the two lies below the
// plane of the other by a quarter of a spacing or more. They bound one body, and only what is below all of
// them is inside of it. (In a concave corner what is deep in the wall has planes of its own, which all pass
// through the corner.) `separation`: of two places.
template <class Separation>
HOST_DEVICE Real contact_distance(const PairContext& c, Index i, Separation separation) {
  const Vec3 x = xyz(c.fluid.place[i]);
  const ListRow row = c.wall_list.entries(i);
  const Index count = c.wall_list.length[i];
  const auto below = [&](Vec3 from, Quad face) {
    return !(face.w > 0) || dot(from, xyz(face)) < face.w - Real(0.25) * c.flow.spacing;
  };
  Real nearest = Real(1e30);
  for (Index k = 0; k < count; ++k) {
    const Index w = row.one(k);
    const Vec3 d = separation(x, xyz(c.wall.place[w]));
    if (dot(d, d) >= square(c.flow.support)) continue;
    const Quad face = c.wall.normal[w], back = c.wall.back[w];
    bool above = stands_above(d, xyz(face), c.flow.spacing);
    Real distance = dot(d, xyz(face)) - face.w;
    if (back.w > 0) distance = larger(distance, dot(d, xyz(back)) - back.w);
    for (Index l = 0; l < count && distance < smaller(nearest, Real(0)); ++l) {
      const Index other = row.one(l);
      const Vec3 e = separation(x, xyz(c.wall.place[other]));
      const Vec3 own_foot = face.w * xyz(face) + (e - d);  // seen from the other wall particle
      const Quad planes[] = {c.wall.normal[other], c.wall.back[other]};
      for (const Quad plane : planes) {
        const Vec3 foot = plane.w * xyz(plane) + (d - e);  // seen from this one
        if (!(plane.w > 0) || !below(foot, face) || !below(foot, back) || !below(own_foot, plane)) continue;
        distance = larger(distance, dot(e, xyz(plane)) - plane.w);
        above = above || stands_above(d, xyz(plane), c.flow.spacing);
      }
    }
    if (above) nearest = smaller(nearest, distance);
  }
  return nearest;
}

}  // namespace slagflow
