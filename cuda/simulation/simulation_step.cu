// A step of the simulation.
#include <sstream>

#include "backend/error.hpp"
#include "backend/reduce.hpp"
#include "pressure/shifting.hpp"
#include "simulation/advance.hpp"
#include "simulation/simulation_state.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow {

// The velocity that gravity adds in a step, against which the error of the solve is measured. Without gravity
// a ten-thousandth of the largest speed, of the fluid or a wall, stands for it.
double Simulation::State::kick() {
  const double g = norm(setup.gravity + setup.body_acceleration);
  return g > 0 ? g * dt : 1e-4 * larger(walls.largest_speed(), largest_speed(context, fluid, diagnostics));
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
  const double left = setup.end_time - time;
  if (left > 0 && left < 2 * dt) dt = left <= dt ? left : 0.5 * left;
}

// Velocities are half a step behind the places, as in the leapfrog scheme: from the middle of the last step
// to that of this one. So a fall is g t^2/2 to round-off, and steps of any length follow each other.
double Simulation::State::velocity_step() const { return 0.5 * (last_dt + dt); }

// A step that takes all that was left ends at the end itself: the sum may miss it by its rounding.
double Simulation::State::time_after_step() const {
  return dt == setup.end_time - time ? setup.end_time : time + dt;
}

ViscousStep::Step Simulation::State::viscous_step() {
  double lightest = 1e300;
  for (const auto& f : fluid_constants(setup)) lightest = smaller(lightest, static_cast<double>(f.mass));
  return {velocity_step(), kick(), lightest};
}

RowCells Simulation::State::row_cells() const {
  const auto sources = ordering.fluid_sources(fluid);
  return {sources.grid, sources.cell_start, arrangement};
}

SolveResult Simulation::State::finish_solve(const StepRecord& now) {
  const SolveResult result = viscous.finish(now, pairs(), row_cells(), solve_step, fluid);
  report.iterations = result.iterations;
  report.residual = result.right_hand_side > 0 ? result.residual / result.right_hand_side : 0;
  report.velocity_error = result.residual / (solve_step.mass * std::sqrt(static_cast<double>(fluid.count)));
  report.converged = result.converged;
  solver.iterations += result.iterations;
  solver.max_iterations = larger(solver.max_iterations, result.iterations);
  solver.yield_iterations += result.yield_iterations;
  if (ended_at_yield_iterations(result)) ++solver.yield_unconverged;
  if (!std::isfinite(result.residual)) check_finite();
  return result;
}

bool Simulation::State::ended_at_yield_iterations(const SolveResult& result) const {
  return exact_yield() && !result.converged && result.yield_iterations == setup.numerics.yield_iterations;
}

// A solve that does not converge is tried again with half the time step, and from a first guess of nothing.
void Simulation::State::solve(const StepRecord& begun) {
  constexpr int most_halvings = 4;
  SolveResult result = finish_solve(begun);
  for (int halving = 0; !result.converged; ++halving) {
    if (halving == most_halvings) give_up(result);
    ++solver.retried;
    dt /= 2;
    walls.place({time, dt, last_dt}, wall);
    viscous.forget(fluid);
    solve_step = viscous_step();
    viscous.begin(pairs(), row_cells(), solve_step, fluid);
    result = finish_solve(viscous.read());
  }
  solver.steps += 1;
  solver.worst_residual = larger(solver.worst_residual, report.residual);
}

// All of it is idle unless the solve has converged.
void Simulation::State::launch_move() {
  add_wall_forces();
  shift();
  StepRecord* record = viscous.record();
  surface_tension.launch_power(fluid, viscous.velocity(), record);
  viscous.launch_energy(fluid);
  Section timer(context, "advance");
  advance_particles(context, fluid, {viscous.velocity(), dt}, list_places, record);
  if (!walls.any())
    list_age.launch_approach(ordering.fluid_sources(fluid), list_places.span(),
                             ordering.wall_sources(wall).cell_start, reach, record);
}

// What is recorded may not take memory.
void Simulation::State::reserve_step() {
  constexpr int most_terms = 5;
  const CellGrid& grid = ordering.fluid_sources(fluid).grid;
  reserve_reductions(context, larger(fluid.count, grid.cells()), most_terms);
  surface_tension.reserve(fluid.count);
  scratch.resize(fluid.count);
  viscous.reserve(fluid.count, fluid_list.capacity(), row_cells());
  list_age.reserve(grid);
}

void Simulation::State::launch_step() {
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

// The device goes on to the end of the step before the host looks, once; mostly the solve has converged.
StepRecord Simulation::State::solve_and_move() {
  solve_step = viscous_step();
  reserve_step();
  if (exact_yield())  // most of whose launches come after the first look
    launch_step();
  else
    step_graph.run({dt, last_dt, solve_step.kick}, [this] { launch_step(); });
  const StepRecord begun = viscous.read_posted();
  solve(begun);
  if (begun.solve.converged) return begun;
  launch_move();
  return viscous.read();
}

void Simulation::State::give_up(const SolveResult& result) {
  std::ostringstream message;
  message << "the viscous solve did not converge in step " << steps + 1 << " at " << time
          << " s, nor with a time step down to " << dt << " s: residual " << report.residual << " after "
          << result.iterations << " iterations";
  if (ended_at_yield_iterations(result))
    message << ", the exact yield stress after numerics.yield_iterations = " << result.yield_iterations
            << "; try more yield_iterations";
  else
    message << "; try more numerics.max_iterations, solver \"multigrid\" or a smaller courant";
  throw Error(message.str());
}

bool Simulation::State::knows_wall_forces() const {
  return setup.measure_walls || walls.any() || walls.largest_speed() > 0;
}

void Simulation::State::add_wall_forces() {
  if (!knows_wall_forces()) return;
  Section timer(context, "wall forces");
  wall_forces.add(
      viscous.as_solved(pairs()), wall_to_fluid.view(), wall,
      {solve_step.dt, viscous.implicit_share(), viscous.velocity(), viscous.explicit_velocity(fluid),
       viscous.wall_yield(), surface_tension.view(), &viscous.record()->solve});
}

void Simulation::State::shift() {
  if (setup.numerics.shifting <= 0) return;
  Section timer(context, "shifting");
  shift_particles(context, pairs(),
                  {static_cast<Real>(setup.numerics.shifting), static_cast<Real>(dt), fluid.shear_rate.span(),
                   &viscous.record()->solve},
                  fluid.position.span());
}

void Simulation::step() {
  State& s = *state_;
  s.walls.place({s.time, s.dt, s.last_dt}, s.wall);
  if (!s.lists_hold()) {
    s.rebuild();
    // A particle may not cross a quarter of the support in one step.
    const double speed = larger(largest_speed(s.context, s.fluid, s.diagnostics), s.walls.largest_speed());
    s.full_dt =
        smaller(stable_time_step(s.setup), 0.25 * static_cast<double>(s.flow.support) / larger(speed, 1e-30));
  }
  s.choose_time_step();
  s.walls.place({s.time, s.dt, s.last_dt}, s.wall);  // with the velocities of this step
  if (s.fluid.count > 0) {
    s.last = s.solve_and_move();
    s.taken += s.last->taken, s.given += s.last->given;
    s.displacement = std::sqrt(s.last->displacement_squared);
    s.capillary_work += s.solve_step.dt * s.last->capillary_power;
    if (!std::isfinite(s.displacement)) s.check_finite();
  }
  s.time = s.time_after_step();
  s.last_dt = s.dt;
  ++s.steps;
  if (s.steps % s.setup.limits.interval == 0) s.look();
}

}  // namespace slagflow
