#include "backend/launch.hpp"
#include "lane_math.hpp"
#include "pair_pressure.hpp"
#include "pair_viscosity.hpp"
#include "predictor.hpp"
#include "smoothing/lucy.hpp"
#include "walls/wall_tension.hpp"

namespace slagflow {

namespace {

template <class Smoothing, class Box>
struct PredictAndAssemble {
  PairContext c;
  Smoothing smoothing;
  Box box;
  Real dt, implicit_dt;  // implicit_dt = theta dt
  PredictorOutput out;

  // w d_k^2 along axis k, or w |d|^2.
  template <class T>
  HOST_DEVICE Vector3<T> pair_diagonal(T weight, Vector3<T> d) const {
    if (c.flow.coupling == PairCoupling::radial)
      return {weight * square(d.x), weight * square(d.y), weight * square(d.z)};
    const T sum = weight * dot(d, d);
    return {sum, sum, sum};
  }

  HOST_DEVICE void operator()(Index i) const {
    const Vec3 x = xyz(c.fluid.place[i]);
    const Quad own = c.fluid.state[i];
    const Real factor = -implicit_dt * c.flow.operator_factor;
    LaneVec3 acceleration, diagonal;
    const Offset first = c.fluid_list.row(i);
    const Index entries = c.fluid_list.length[i];
    for (Index k = 0; k < entries; k += lane_count) {
      const Offset at = first + k * ListView::stride();
      const Index* j = &c.fluid_list.entry[at];
      const LaneVec3 d = box.separation(in_lanes(x), xyz(gather(c.fluid.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(entries - k);
      Lanes weight = 0;
      if (bits(near)) {
        const QuadLanes other = gather(c.fluid.state, j);
        const Lanes r = root(r2), f = select(near, smoothing.gradient(r), Lanes(0));
        acceleration -= (other.w * f * pair_pressure(c.flow, smoothing, Lanes(own.x), other.x, r)) * d;
        // The same bits for j and i.
        const Lanes mean = pair_viscosity(c, i, Lanes(own.y), other.y, j);
        weight = (factor * (own.z * other.z) * f) * (mean + c.flow.augmentation) / (r2 + c.flow.softening);
        diagonal += pair_diagonal(weight, d);
      }
      store_lanes(&out.weight[at], weight);
    }
    walls(i, x, own, total(acceleration), Vec3{own.w, own.w, own.w} + total(diagonal));
  }

  HOST_DEVICE Lanes own_share(Index i, Real towards_fluid, const Index* walls) const {
    if (!walls_have_tension_limits(c)) return towards_fluid;
    return share_towards_walls(c, i, wall_tension_limits(c, walls));
  }

  // `acceleration`: by the pressure of the fluid.
  HOST_DEVICE void walls(Index i, Vec3 x, Quad own, Vec3 acceleration, Vec3 diagonal) const {
    const Real rest_density = c.fluids[c.fluid.fluid[i]].rest_density;
    const Real factor =
        implicit_dt * c.flow.operator_factor * own.z * (own.y + c.flow.augmentation) * c.flow.wall_volume;
    LaneVec3 push, drag;
    SymmetricMatrix3<Lanes> coupled;
    const Offset first = c.wall_list.row(i);
    const Index entries = c.wall_list.length[i];
    for (Index k = 0; k < entries; k += lane_count) {
      const Index* j = &c.wall_list.entry[first + k * ListView::stride()];
      const LaneVec3 d = box.separation(in_lanes(x), xyz(gather(c.wall.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(entries - k);
      if (!bits(near)) continue;
      const Lanes r = root(r2), f = select(near, smoothing.gradient(r), Lanes(0));
      const Lanes pressure = gather(c.wall.pressure, j);
      const Lanes density = rest_density + pressure / c.flow.sound_speed_squared;
      push +=
          (f * pair_pressure(c.flow, smoothing, own_share(i, own.x, j), pressure / square(density), r)) * d;
      const QuadLanes motion = gather(c.wall.velocity, j);
      const WallPairGeometry<Lanes, QuadLanes> pair{d, gather(c.wall.normal, j), gather(c.wall.back, j)};
      const Lanes stick = no_slip_factor(pair, c.flow.spacing, motion.w);
      const Lanes weight = -factor * stick * f / (r2 + c.flow.softening);
      const Lanes sticking = select(motion.w < Lanes(0), Lanes(0), weight);
      add_coupling(c.flow.coupling, sticking, d, coupled);
      drag += couple(c.flow.coupling, sticking, d, xyz(motion));
    }
    acceleration -= own.w * total(push);
    out.by_pressure[i] = quad(acceleration, 0);
    acceleration += c.flow.gravity + c.flow.body_acceleration;
    if (c.capillary.size > 0) acceleration += xyz(c.capillary[i]);
    const Symmetric3 block = total(coupled);
    const Vec3 predicted = xyz(c.fluid.motion[i]) + dt * acceleration;
    diagonal += Vec3{block.xx, block.yy, block.zz};
    out.predicted[i] = quad(predicted, 0);
    out.wall[i] = block;
    out.diagonal[i] = quad(diagonal, own.w);
    out.right_hand_side[i] = quad(own.w * predicted + total(drag), 0);
  }
};

}  // namespace

void predict_and_assemble(Context& context, const PairContext& c, const PredictorOutput& out, Real dt,
                          Real theta) {
  const Lucy smoothing(c.flow.support, c.flow.dimensions);
  auto sweep = [&](auto box) {
    launch(context, "predictor and assembly", c.fluid.count,
           PredictAndAssemble<Lucy, decltype(box)>{c, smoothing, box, dt, theta * dt, out});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
