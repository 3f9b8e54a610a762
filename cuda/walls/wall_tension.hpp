// Adhesion: walls that bear another tension than the fluid does.
#pragma once

#include "density.hpp"
#include "lane_math.hpp"

namespace slagflow {

// Whether some wall has a limit of its own. Its pairs then cut off both their pressures there, not at the
// fluid's p_t.
HOST_DEVICE inline bool walls_have_tension_limits(const PairContext& c) {
  return c.wall.tension_limit.size > 0;
}

// Of wall particle w [Pa].
HOST_DEVICE inline Real wall_tension_limit(const PairContext& c, Index w) {
  return walls_have_tension_limits(c) ? c.wall.tension_limit[c.wall.id[w]] : c.flow.tension_limit;
}

// Of wall particles w[0], w[1], ..., one a lane [Pa].
HOST_DEVICE inline Lanes wall_tension_limits(const PairContext& c, const Index* w) {
  if (!walls_have_tension_limits(c)) return c.flow.tension_limit;
  Real limit[lane_count];
  for (int k = 0; k < lane_count; ++k) limit[k] = wall_tension_limit(c, w[k]);
  return load_lanes(limit);
}

// p/rho^2 of fluid particle i towards walls that bear so much [Pa]. T: Real or Lanes.
template <class T>
HOST_DEVICE T share_towards_walls(const PairContext& c, Index i, T limit) {
  const Real excess = c.fluid.motion[i].w;
  const Real density = c.fluids[c.fluid.fluid[i]].rest_density + excess;
  return larger(T(c.flow.sound_speed_squared * excess), -limit) / T(square(density));
}

}  // namespace slagflow
