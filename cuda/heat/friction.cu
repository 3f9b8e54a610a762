#include "backend/reduce.hpp"
#include "fluid/solve_state.hpp"
#include "heat/heat.hpp"
#include "heat/heat_sums.hpp"

namespace slagflow {

namespace {

// What viscosity takes from the motion of a step, by pairs: w_ij (x_ij.u_ij)(x_ij.(u + u*)_ij/2) is the
// kinetic energy that is lost, exactly; each of two particles gets half, fluid at a wall all.
template <class Box>
struct FrictionOfStep {
  PairContext c;
  Box box;
  Heat::Friction step;
  Span<double> gained, enthalpy;

  HOST_DEVICE void operator()(Index i) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i])), u = in_lanes(xyz(step.solved[i])),
                   predicted = in_lanes(xyz(step.predicted[i]));
    const double power = static_cast<double>(total(of_fluid(i, x, u, predicted))) +
                         static_cast<double>(total(of_walls(i, x, u, predicted))) +
                         (step.by_yield.size > 0 ? step.by_yield[i] : 0.0);
    gained[i] = power;
    enthalpy[i] += power / static_cast<double>(c.fluids[c.fluid.fluid[i]].mass);
  }

  HOST_DEVICE static Lanes lost(Lanes weight, LaneVec3 d, LaneVec3 slip, LaneVec3 predicted_slip,
                                PairCoupling coupling) {
    return dot(couple(coupling, weight, d, slip), Lanes(Real(0.5)) * (slip + predicted_slip));
  }

  HOST_DEVICE Lanes of_fluid(Index i, LaneVec3 x, LaneVec3 u, LaneVec3 predicted) const {
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    Lanes sum = 0;
    for (Index k = 0; k < pairs; k += lane_count) {
      const Offset at = row.at(k);
      const Entries j = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.fluid.place, j)));
      sum += Real(0.5) * lost(step.weight.load(at), d, u - xyz(gather(step.solved, j)),
                              predicted - xyz(gather(step.predicted, j)), c.flow.coupling);
    }
    return sum;
  }

  HOST_DEVICE Lanes of_walls(Index i, LaneVec3 x, LaneVec3 u, LaneVec3 predicted) const {
    const Quad own = c.fluid.state[i];
    const Real factor = step.implicit_dt * c.flow.operator_factor * own.z * own.y * c.flow.wall_volume;
    const ListRow row = c.wall_list.entries(i);
    const Index pairs = c.wall_list.length[i];
    Lanes sum = 0;
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.wall.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const QuadLanes motion = gather(c.wall.velocity, j);
      const WallPairGeometry<Lanes, QuadLanes> pair{d, gather(c.wall.normal, j), gather(c.wall.back, j)};
      const Lanes stick = no_slip_factor(pair, c.flow.spacing, motion.w);
      const Lanes weight = factor * stick * c.flow.smoothing.viscous(r2);
      const Lanes sticking = select(near, select(motion.w < Lanes(0), Lanes(0), weight), Lanes(0));
      sum += lost(sticking, d, u - xyz(motion), predicted - xyz(motion), c.flow.coupling);
    }
    return sum;
  }
};

}  // namespace

void Heat::launch_friction(const PairContext& c, const Friction& step, FluidArrays& fluid) {
  if (!friction_) return;
  lost_.resize(fluid.count);
  auto sweep = [&](auto box) {
    launch(context_, "viscous heat", fluid.count,
           if_converged(step.solve,
                        FrictionOfStep<decltype(box)>{c, box, step, lost_.span(), fluid.enthalpy.span()}));
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
  launch_reduction<AddUp>(context_, "viscous heat of the step", fluid.count,
                          if_converged(step.solve, HeatTerm{lost_.span()}),
                          AddHeat{sums_.span().data + heat_by_friction});
  launch_update(fluid, step.solve);
}

}  // namespace slagflow
