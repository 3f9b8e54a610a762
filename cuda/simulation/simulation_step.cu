// A step of the simulation.
#include "backend/reduce.hpp"
#include "pressure/shifting.hpp"
#include "simulation/advance.hpp"
#include "simulation/simulation_state.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow {

void Simulation::step() {
  State& s = *state_;
  if (s.flow_is_over()) return s.cool();
  s.place_walls();
  if (!s.lists_hold()) {
    s.rebuild();
    s.full_dt = smaller(s.longest_step(), s.step_across(largest_speed(s.context, s.fluid, s.diagnostics)));
  }
  s.choose_time_step();
  s.place_walls();                         // with the velocities of this step
  constexpr std::int64_t most_steps = 20;  // without conduction
  if (s.heat.due(s.time + s.dt, s.dt, s.steps % most_steps == 0))
    s.heat.conduct(s.pairs(), s.wall_to_fluid.view(), s.time + s.dt, s.fluid);
  if (s.fluid.count.of_all() > 0) {
    s.last = s.solve_and_move();
    s.taken += s.last->taken, s.given += s.last->given;
    s.displacement = std::sqrt(s.last->displacement_squared);
    s.lists_worn = s.last->worn;
    s.rectangles.follow(s.context, s.fluid, std::sqrt(s.last->speed_squared) * s.dt, s.reach.fluid_skin,
                        s.diagnostics);
    // Between builds in a few steps down: a graph is recorded anew for each.
    const double across = s.step_across(std::sqrt(s.last->speed_squared));
    if (across < s.full_dt) s.full_dt = 0.9 * across;
    s.capillary_work += s.solve_step.dt * s.last->capillary_power;
    if (s.last->compression > s.largest_compression.value)
      s.largest_compression = {s.last->compression, s.time};
    if (!std::isfinite(s.displacement)) s.check_finite();
  }
  s.time = s.time_after_step();
  s.last_dt = s.dt;
  s.follow_moving_walls();
  ++s.steps;
  const bool too_dense = s.last && s.last->compression > s.setup.limits.max_compression;
  if (too_dense || s.steps % s.setup.limits.interval == 0) s.look();
}

// A particle may not cross a quarter of the support in one step.
double Simulation::State::step_across(double fluid_speed) const {
  const double speed = larger(fluid_speed, larger(walls.largest_speed(), inlets.largest_speed()));
  return 0.25 * reach.support / larger(speed, 1e-30);
}

void Simulation::State::place_walls() {
  walls.place({time, dt, last_dt}, wall), inlets.place({time, dt, last_dt}, wall);
}

// The device goes on to the end of the step before the host looks, once; mostly the solve has converged.
StepRecord Simulation::State::solve_and_move() {
  solve_step = viscous_step();
  reserve_step();
  if (exact_yield())  // most of whose launches come after the first look
    launch_step();
  else
    step_graph.run({dt, last_dt, solve_step.kick, levels_recorded()}, [this] { launch_step(); });
  const StepRecord begun = viscous.read_posted();
  solve(begun);
  if (begun.solve.converged) return begun;
  launch_move();
  return viscous.read();
}

// What tells the levels of multigrid that are part of the step's recording from others; 0: none are.
double Simulation::State::levels_recorded() const {
  return viscous.goes_on_with_levels(row_cells()) ? static_cast<double>(arrangement) : 0;
}

// What is recorded may not take memory.
void Simulation::State::reserve_step() {
  constexpr int most_terms = 5;
  const CellGrid& grid = ordering.fluid_sources(fluid).grid;
  reserve_reductions(context, fluid.count, most_terms);
  reserve_reductions(context, larger(wall.count.room, grid.cells()), most_terms);
  surface_tension.reserve(fluid.local());
  scratch.resize(fluid.count);
  viscous.reserve(fluid.local(), fluid_list.capacity(), row_cells());
  if (setup.thermal.viscous_heating) heat.reserve(fluid.count);
}

void Simulation::State::launch_step() {
  viscous.poison_halos(fluid);
  surface_tension.update(pairs(), wall.id.span());
  {
    Section timer(context, "density and shear rate");
    update_density(context, pairs(), fluid, scratch, static_cast<Real>(last_dt));
  }
  {
    Section timer(context, "wall pressure");
    extrapolate_wall_pressure(context, pairs(), wall_to_fluid.view(), wall);
  }
  viscous.begin(pairs(), row_cells(), solve_step, fluid);
  launch_move();
  viscous.post();
}

// All of it is idle unless the solve has converged.
void Simulation::State::launch_move() {
  add_wall_forces();
  add_friction();
  shift();
  StepRecord* record = viscous.record();
  surface_tension.launch_power(fluid, viscous.velocity(), record);
  viscous.launch_energy(fluid);
  {
    Section timer(context, "advance");
    advance_particles(context, fluid, {viscous.velocity(), dt, list_places.span(), fluids.span()}, record);
    exchange(context, fluid.count, fluid.place, fluid.motion, fluid.by_pressure);
  }
  Section timer(context, "neighbours");
  if (walls.any()) return;
  list_age.launch_look(fluid_for_age(), walls_for_age(), reach, record);
  renew_lists(list_age.gate(reach, record));
}

bool Simulation::State::knows_wall_forces() const {
  return setup.measure_walls || walls.any() || walls.largest_speed() > 0;
}

void Simulation::State::add_wall_forces() {
  if (!knows_wall_forces()) return;
  Section timer(context, "wall forces");
  viscous.exchange_velocity(fluid.count);
  wall_forces.add(
      viscous.as_solved(pairs()), wall_to_fluid.view(), wall,
      {solve_step.dt, viscous.implicit_share(), viscous.velocity(), viscous.explicit_velocity(fluid),
       viscous.wall_yield(), surface_tension.view(), &viscous.record()->solve});
}

void Simulation::State::add_friction() {
  if (!setup.thermal.viscous_heating) return;
  Section timer(context, "heat");
  const PairContext c = viscous.as_solved(pairs());
  heat.launch_friction(c,
                       {viscous.weights(), viscous.predicted(), viscous.velocity(), &viscous.record()->solve,
                        static_cast<Real>(solve_step.dt), viscous.yield_work(c, solve_step)},
                       fluid);
}

void Simulation::State::shift() {
  if (setup.numerics.shifting <= 0) return;
  Section timer(context, "shifting");
  shift_particles(context, pairs(),
                  {static_cast<Real>(setup.numerics.shifting), static_cast<Real>(dt), fluid.shear_rate.span(),
                   &viscous.record()->solve},
                  fluid.position.span());
}

// The longest stable step; that of an explicit viscous step changes with the viscosities, equation (5). The
// last two before the end share what is left, so that none is much shorter than the others.
void Simulation::State::choose_time_step() {
  dt = full_dt;
  if (setup.numerics.viscous_step == ViscousStepping::explicit_step) {
    const double diffusivity = largest_diffusivity(context, fluid, diagnostics);
    if (diffusivity > 0)
      dt = smaller(dt, setup.numerics.diffusion_number * square(setup.spacing) / diffusivity);
  }
  const double left = flow_end() - time;
  if (left > 0 && left < 2 * dt) dt = left <= dt ? left : 0.5 * left;
}

// Velocities are half a step behind the places, as in the leapfrog scheme: from the middle of the last step
// to that of this one. So a fall is g t^2/2 to round-off, and steps of any length follow each other.
double Simulation::State::velocity_step() const { return 0.5 * (last_dt + dt); }

// A step that takes all that was left ends at the end itself: the sum may miss it by its rounding.
double Simulation::State::time_after_step() const { return dt == flow_end() - time ? flow_end() : time + dt; }

}  // namespace slagflow
