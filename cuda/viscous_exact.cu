// The implicit step with an exact yield stress: the iteration of exact_yield.hpp around the linear solver.
#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "solvers/residual.hpp"
#include "viscous.hpp"

namespace slagflow {

namespace {

// What the iteration lacks at its end acts like more viscosity, always against the flow, where the errors of
// a linear solve go either way: of the tolerance only this share is allowed. (With all of it a discharge was
// slower by 3 %.)
constexpr double tolerance_share = 0.1;

// base = b - A u*
struct StartExact {
  LinearSystem system;
  Span<const Quad> predicted;
  Span<Quad> base;
  HOST_DEVICE void operator()(Index i) const {
    base[i] = quad(xyz(system.right_hand_side[i]) - system.apply(i, predicted), 0);
  }
};

struct NewVelocity {
  Span<const Quad> predicted, increment;
  Span<Quad> velocity;
  HOST_DEVICE void operator()(Index i) const { velocity[i] = quad(xyz(predicted[i]) + xyz(increment[i]), 0); }
};

}  // namespace

SolveResult ViscousStep::solve_exact(const LinearSystem& matrix, const PairContext& c, const RowCells& rows,
                                     const Step& step, Buffer<Quad>& increment) {
  const Index n = matrix.size;
  base_.resize(n), work_.residual.resize(n), work_.squared.resize(n);
  const double b = norm_of(right_hand_side_.span(), Weighted::no);
  launch(context_, "start", n, StartExact{matrix, predicted_.span(), base_.span()});
  // The residual against the stresses of the last iteration bounds the velocity error as in other solves
  // (A >= m). The gap times the augmentation is a stress; a gap below a thousandth of the shear rate is
  // rounding.
  const double wanted = tolerance_share * wanted_residual(step, n);
  const double spacing = static_cast<double>(c.flow.spacing);
  const double wanted_gap =
      tolerance_share * numerics_.tolerance * step.kick / (relative_augmentation() * spacing);
  SolveResult result;
  bool rates_agree = false;
  double gap = 0, change = 0, start = 0;
  for (;;) {
    yield_.add_force(c, static_cast<Real>(step.dt), base_.span(), right_hand_side_.span());
    launch(context_, "residual", n,
           Residual{matrix, increment.span(), work_.residual.span(), work_.squared.span()});
    result.residual = std::sqrt(sum(context_, work_.squared.span()));
    if (result.yield_iterations == 0) start = result.residual;
    result.converged =
        rates_agree && result.residual <= larger(wanted, rounding_residual(increment.span(), start));
    if (result.converged || result.yield_iterations == numerics_.yield_iterations) break;
    const SolveResult inner = solve(matrix, rows, exact_limits(step, result.residual, increment), increment);
    result.iterations += inner.iterations;
    if (!inner.converged && !(inner.residual <= wanted)) break;
    launch(context_, "velocity", n, NewVelocity{predicted_.span(), increment.span(), velocity_.span()});
    const ExactYield::Rates rates = yield_.update(c, velocity_.span());
    gap += rates.gap, change += rates.change;
    rates_agree = rates.gap <= wanted_gap + 1e-3 * rates.shear;
    ++result.yield_iterations;
  }
  yield_.balance(gap, change);
  result.right_hand_side = b;
  return result;
}

// A tenth of the start's residual, however small: a plug must come to rest, not stop within a tolerance.
SolveLimits ViscousStep::exact_limits(const Step& step, double start, Buffer<Quad>& increment) {
  const double wanted =
      smaller(0.1 * start, tolerance_share * wanted_residual(step, static_cast<Index>(increment.size())));
  const double residual = larger(wanted, rounding_residual(increment.span(), start));
  return {residual, residual * residual / step.mass, numerics_.max_iterations, numerics_.relaxation, start};
}

}  // namespace slagflow
