// What the oracle says of particles below the surface of a wall.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference.hpp"

namespace reference {

// Pressure of particle i towards walls for being below a surface: of the nearest face of one, seen from the
// wall particles that stand behind it; all faces of a convex body count at its edges.
struct WallFace {
  Vec normal;
  double depth = 0;
};
inline std::vector<WallFace> faces_of(const Wall& w) {
  std::vector<WallFace> faces{{w.normal, w.depth}};
  if (w.back_depth > 0) faces.push_back({w.back_normal, w.back_depth});
  return faces;
}
inline bool stands_above(const World& w, Vec d, Vec normal) {
  const Vec aside = d - dot(d, normal) * normal;
  const double most = std::max({std::fabs(aside.x), std::fabs(aside.y), std::fabs(aside.z)});
  return dot(d, normal) > 0 && most < 0.51 * w.spacing;
}
inline double contact_pressure(const World& w, std::size_t i) {
  double nearest = 1e30, closest = 1e30;
  for_wall_pairs(w, i, [&](const Wall&, Vec d) { closest = std::min(closest, length(d)); });
  if (closest >= 0.95 * w.spacing) return -1e30;
  const auto below = [&](Vec from, const WallFace& f) {
    return dot(from, f.normal) < f.depth - 0.25 * w.spacing;
  };
  for_wall_pairs(w, i, [&](const Wall& j, Vec d) {
    const std::vector<WallFace> own = faces_of(j);
    bool above = stands_above(w, d, j.normal);
    double distance = -1e30;
    for (const WallFace& f : own) distance = std::max(distance, dot(d, f.normal) - f.depth);
    const auto partner = [&](const Wall& k, Vec e) {
      const Vec own_foot = j.depth * j.normal + (e - d);  // seen from the other wall particle
      for (const WallFace& f : faces_of(k)) {
        bool one_body = below(own_foot, f);
        for (const WallFace& own_face : own)
          one_body = one_body && below(d - e + f.depth * f.normal, own_face);
        if (!one_body) continue;
        distance = std::max(distance, dot(e, f.normal) - f.depth);
        above = above || stands_above(w, d, f.normal);
      }
    };
    for_wall_pairs(w, i, partner, 1.1);
    if (above) nearest = std::min(nearest, distance);
  });
  const Particle& p = w.particles[i];
  const double stiffness = w.kind(p).rest_density * w.sound_speed * w.sound_speed;
  return nearest < 0 ? -stiffness * nearest / w.spacing : -1e30;
}

}  // namespace reference
