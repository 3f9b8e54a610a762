#include "backend/launch.hpp"
#include "fluid/lane_math.hpp"
#include "pressure/pair_pressure.hpp"
#include "viscosity/pair_viscosity.hpp"
#include "viscosity/predictor.hpp"
#include "walls/wall_tension.hpp"

namespace slagflow {

namespace {

template <class Box>
struct PredictAndAssemble {
  PairContext c;
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
    const Real factor = implicit_dt * c.flow.operator_factor;
    LaneVec3 pressure, pairing, diagonal;
    const ListRow row = c.fluid_list.entries(i);
    const Index entries = c.fluid_list.length[i];
    for (Index k = 0; k < entries; k += lane_count) {
      const Offset at = row.at(k);
      const Entries j = row[k];
      row.foresee(k);
      const LaneVec3 d = box.separation(in_lanes(x), xyz(gather(c.fluid.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(entries - k);
      Lanes weight = 0;
      if (bits(near)) {
        const QuadLanes other = gather(c.fluid.state, j);
        const Lanes volume = select(near, other.z, Lanes(0)), share = volume * c.flow.smoothing.gradient(r2);
        pressure -= (volume * pressure_slope(c.flow, Lanes(own.x), other.x, r2)) * d;
        pairing -= (share * pairing_pressure(c.flow, Lanes(own.x), other.x, r2)) * d;
        // The same bits for j and i.
        const Lanes mean = pair_viscosity(c, i, Lanes(own.y), other.y, j);
        weight = factor * (own.z * volume) * mean * c.flow.smoothing.viscous(r2);
        diagonal += pair_diagonal(weight, d);  // a preconditioner: half a step away it serves as well
      }
      out.weight.store(at, weight);
    }
    Push push{own.z * total(pressure), own.z * total(pairing)};
    WallPart part = walls(i, x, own, push);
    finish(i, own, push, part, total(diagonal));
  }

  // Forces by pressure [N]: what the elastic energy of the fluid balances, and the rest, by pairing and by
  // the pressure of walls.
  struct Push {
    Vec3 elastic, given;
  };
  struct WallPart {
    Symmetric3 block;
    Vec3 drag;
  };

  HOST_DEVICE WallPart walls(Index i, Vec3 x, Quad own, Push& push) const {
    const Real factor = implicit_dt * c.flow.operator_factor * own.z * own.y * c.flow.wall_volume;
    LaneVec3 elastic, given, drag;
    SymmetricMatrix3<Lanes> coupled;
    const ListRow row = c.wall_list.entries(i);
    const Index entries = c.wall_list.length[i];
    for (Index k = 0; k < entries; k += lane_count) {
      const Entries j = row[k];
      const LaneVec3 d = box.separation(in_lanes(x), xyz(gather(c.wall.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(entries - k);
      if (!bits(near)) continue;
      const WallPressures<Lanes> p = towards_walls(c, i, own.x, wall_tension_limits(c, j));
      const Lanes own_slope = pressure_slope(c.flow, p.elastic, Lanes(0), r2);
      const Lanes all = pair_pressure_slope(c.flow, p.fluid, gather(c.wall.pressure, j), r2);
      elastic -= select(near, own_slope, Lanes(0)) * d;
      given -= select(near, all - own_slope, Lanes(0)) * d;
      const QuadLanes motion = gather(c.wall.velocity, j);
      const WallPairGeometry<Lanes, QuadLanes> pair{d, gather(c.wall.normal, j), gather(c.wall.back, j)};
      const Lanes stick = no_slip_factor(pair, c.flow.spacing, motion.w);
      const Lanes weight = factor * stick * c.flow.smoothing.viscous(r2);
      const Lanes sticking = select(near, select(motion.w < Lanes(0), Lanes(0), weight), Lanes(0));
      add_coupling(c.flow.coupling, sticking, d, coupled);
      drag += couple(c.flow.coupling, sticking, d, xyz(motion));
    }
    const Real volumes = own.z * c.flow.wall_volume;
    push.elastic += volumes * total(elastic), push.given += volumes * total(given);
    return {total(coupled), total(drag)};
  }

  HOST_DEVICE void finish(Index i, Quad own, const Push& push, const WallPart& wall, Vec3 diagonal) const {
    const Vec3 by_pressure = (1 / own.w) * (push.elastic + push.given);
    Vec3 acceleration = by_pressure + c.flow.gravity + c.flow.body_acceleration;
    if (c.capillary.size > 0) acceleration += xyz(c.capillary[i]);
    const Vec3 old = xyz(c.fluid.motion[i]), predicted = old + dt * acceleration;
    const Real rest_density = c.fluids[c.fluid.fluid[i]].rest_density;
    out.by_pressure[i] = quad(rest_density * by_pressure, 0);
    out.given[i] = quad(dt * push.given, 0);
    out.predicted[i] = quad(predicted, 0);
    out.wall[i] = wall.block;
    out.diagonal[i] =
        quad(Vec3{own.w, own.w, own.w} + diagonal + Vec3{wall.block.xx, wall.block.yy, wall.block.zz}, own.w);
    out.right_hand_side[i] = quad(own.w * predicted + wall.drag, 0);
  }
};

}  // namespace

void predict_and_assemble(Context& context, const PairContext& c, const PredictorOutput& out, Real dt,
                          Real theta) {
  auto sweep = [&](auto box) {
    launch(context, "predictor and assembly", c.fluid.count,
           PredictAndAssemble<decltype(box)>{c, box, dt, theta * dt, out});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
