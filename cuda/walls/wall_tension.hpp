// What a fluid particle and walls press on each other with, and adhesion: walls that bear another tension
// than the fluid does.
#pragma once

#include "fluid/lane_math.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

// Whether walls bear another tension than the fluid. Their pairs then cut off both their pressures there, not
// at the fluid's p_t.
HOST_DEVICE inline bool walls_have_tension_limits(const PairContext& c) {
  return c.wall.tension_limit.size > 0 || c.flow.wall_tension_limit != c.flow.tension_limit;
}

// Of wall particle w [Pa].
HOST_DEVICE inline Real wall_tension_limit(const PairContext& c, Index w) {
  return c.wall.tension_limit.size > 0 ? c.wall.tension_limit[c.wall.id[w]] : c.flow.wall_tension_limit;
}

// Of wall particles w[0], w[1], ..., one a lane [Pa].
HOST_DEVICE inline Lanes wall_tension_limits(const PairContext& c, const Entries& w) {
  if (c.wall.tension_limit.size == 0) return c.flow.wall_tension_limit;
  Real limit[lane_count];
  for (int k = 0; k < lane_count; ++k) limit[k] = wall_tension_limit(c, w[k]);
  return load_lanes(limit);
}

// Pressures of a fluid particle towards walls that bear `limit` [Pa]: what the equation of state gives, and
// with contact (contact.hpp). `towards_fluid`: p_i. T: Real or Lanes.
template <class T>
struct WallPressures {
  T elastic, fluid;
};
template <class T>
HOST_DEVICE WallPressures<T> towards_walls(const PairContext& c, Index i, Real towards_fluid, T limit) {
  T elastic = towards_fluid;
  if (walls_have_tension_limits(c))
    elastic = larger(T(c.flow.sound_speed_squared * c.fluid.motion[i].w), -limit);
  return {elastic, larger(elastic, T(c.fluid.contact[i]))};
}

}  // namespace slagflow
