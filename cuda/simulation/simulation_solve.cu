// The viscous solve of a step, as the simulation asks for it and judges it.
#include <sstream>

#include "backend/error.hpp"
#include "simulation/advance.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

// The velocity that gravity adds in a step, against which the error of the solve is measured. Without gravity
// a ten-thousandth of the largest speed, of the fluid or a wall, stands for it.
double Simulation::State::kick() {
  const double g = norm(setup.gravity + setup.body_acceleration);
  return g > 0 ? g * dt : 1e-4 * larger(walls.largest_speed(), largest_speed(context, fluid, diagnostics));
}

ViscousStep::Step Simulation::State::viscous_step() {
  double lightest = 1e300;
  for (const auto& f : fluid_constants(setup)) lightest = smaller(lightest, static_cast<double>(f.mass));
  return {velocity_step(), kick(), lightest, dt};
}

RowCells Simulation::State::row_cells() const {
  const auto sources = ordering.fluid_sources(fluid);
  return {sources.grid, sources.cell_start, arrangement, fluid.count.halo};
}

SolveResult Simulation::State::finish_solve(const StepRecord& now) {
  const SolveResult result = viscous.finish(now, pairs(), row_cells(), solve_step, fluid);
  report.iterations = result.iterations;
  report.residual = result.right_hand_side > 0 ? result.residual / result.right_hand_side : 0;
  report.velocity_error =
      result.residual / (solve_step.mass * std::sqrt(static_cast<double>(fluid.count.of_all())));
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

}  // namespace slagflow
