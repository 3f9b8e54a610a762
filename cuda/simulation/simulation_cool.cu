// Steps of heat alone, once the flow is over.
#include "backend/launch.hpp"
#include "fluid/melt.hpp"
#include "fluid/yield_rheology.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

namespace {

// Velocities and shear rates are nought, and viscosities those of fluid at rest.
struct ComeToRest {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<Quad> motion, state, melt;
  Span<Real> shear_rate;
  HOST_DEVICE void operator()(Index i) const {
    const FluidConstants& f = fluids[fluid[i]];
    const Rheology now = Melt(melt[i]).of(f.rheology);
    motion[i] = {0, 0, 0, motion[i].w}, shear_rate[i] = 0;
    state[i].y = smaller(viscosity(now, Real(0)), f.max_viscosity);
    melt[i].w = smaller(viscous_part_of(now, Real(0)), state[i].y);
  }
};

}  // namespace

bool Simulation::State::flow_is_over() const { return time >= setup.thermal.flow_until && setup.thermal.on; }

double Simulation::State::flow_end() const {
  return setup.thermal.on ? smaller(setup.end_time, setup.thermal.flow_until) : setup.end_time;
}

// The last two steps share what is left. The clock of the flow stands, by which walls and inlets go.
void Simulation::State::cool() {
  if (heat_time < time) {
    heat_time = time;
    if (!lists_hold()) rebuild();
  }
  const double left = setup.end_time - heat_time;
  heat_dt = cooling_time_step(heat.longest_step(), heat_time - time);
  if (setup.numerics.max_time_step > 0) heat_dt = smaller(heat_dt, setup.numerics.max_time_step);
  if (left > 0 && left < 2 * heat_dt) heat_dt = left <= heat_dt ? left : 0.5 * left;
  heat_time = heat_dt == left ? setup.end_time : heat_time + heat_dt;
  heat.conduct_twice(pairs(), wall_to_fluid.view(), heat_time, fluid);
  launch(context, "come to rest", fluid.count,
         ComeToRest{fluids.span(), fluid.fluid.span(), fluid.motion.span(), fluid.state.span(),
                    fluid.melt.span(), fluid.shear_rate.span()});
  ++steps;
  if (steps % setup.limits.interval == 0) look();
}

}  // namespace slagflow
