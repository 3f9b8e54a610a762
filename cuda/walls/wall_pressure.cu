#include "backend/launch.hpp"
#include "fluid/lane_math.hpp"
#include "walls/wall_pressure.hpp"
#include "walls/wall_tension.hpp"

namespace slagflow {

namespace {

template <class Box>
struct WallPressure {
  PairContext c;
  ListView list;
  Box box;
  Span<Real> pressure;

  HOST_DEVICE void operator()(Index w) const {
    const LaneVec3 x = in_lanes(xyz(c.wall.place[w])), gravity = in_lanes(felt_gravity(w));
    const ListRow row = list.entries(w);
    const Index entries = list.length[w];
    const Real limit = wall_tension_limit(c, w);
    Lanes weights = 0, sum = 0;
    for (Index k = 0; k < entries; k += lane_count) {
      const Entries f = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.fluid.place, f)));
      const Lanes weight = select(first_lanes(entries - k), c.flow.smoothing.value(dot(d, d)), Lanes(0));
      weights += weight;
      sum += weight * (fluid_pressure(f, limit) + density(f) * dot(gravity, d));
    }
    const Real all = total(weights);
    pressure[w] = all > 0 ? larger(total(sum) / all, -limit) : Real(0);
  }

  HOST_DEVICE Vec3 felt_gravity(Index w) const {
    return c.wall.acceleration.size > 0 ? c.flow.gravity - xyz(c.wall.acceleration[w]) : c.flow.gravity;
  }

  HOST_DEVICE Lanes fluid_pressure(const Entries& f, Real limit) const {
    if (!walls_have_tension_limits(c)) return gather(c.fluid.pressure, f);
    return larger(c.flow.sound_speed_squared * gather(c.fluid.motion, f).w, Lanes(-limit));
  }

  HOST_DEVICE Lanes density(const Entries& f) const {
    Real rest[lane_count];
    for (int k = 0; k < lane_count; ++k) rest[k] = c.fluids[c.fluid.fluid[f[k]]].rest_density;
    return load_lanes(rest) + gather(c.fluid.motion, f).w;
  }
};

}  // namespace

void extrapolate_wall_pressure(Context& context, const PairContext& c, const ListView& list,
                               WallArrays& wall) {
  auto sweep = [&](auto box) {
    launch(context, "wall pressure", wall.count,
           WallPressure<decltype(box)>{c, list, box, wall.pressure.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
  exchange(context, wall.count, wall.pressure);
}

}  // namespace slagflow
