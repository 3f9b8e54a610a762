// The implicit step with an exact yield stress: the iteration of exact_yield.hpp around the linear solver.
#include "backend/reduce.hpp"
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
  static constexpr int terms = 1;  // |b_i|^2
  LinearSystem system;
  Span<const Quad> predicted;
  Span<Quad> base;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    const Vec3 b = xyz(system.right_hand_side[i]);
    base[i] = quad(b - system.apply(i, predicted), 0);
    return {{dot(to_double(b), to_double(b))}};
  }
};

struct KeepRightHandSide {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<1>& squared) const {
    state->right_hand_side = std::sqrt(squared.value[0]);
  }
};

struct StartResidual {
  static constexpr int terms = 3;  // |r_i|^2, r_i.z_i, |D_i delta_i|^2 with the diagonal D
  Residual residual;
  HOST_DEVICE Terms<3> operator()(Index i) const {
    const Terms<2> own = residual(i);
    return {{own.value[0], own.value[1], scaled_squared(residual.system.diagonal[i], residual.u[i])}};
  }
};

// A tenth of the start's residual, however small: a plug must come to rest, not stop within a tolerance.
// Where the iteration has converged, nothing is solved.
struct BeginInnerSolve {
  SolveState* state;
  double wanted;
  bool first, rates_agree;
  int most_iterations;
  HOST_DEVICE void operator()(const Terms<3>& sums) const {
    const double start = std::sqrt(sums.value[0]);
    if (first) state->first_residual = start;
    state->enough =
        rates_agree ? larger(wanted, rounding_residual(sums.value[2], state->first_residual)) : -1;
    state->limit = start <= state->enough
                       ? start
                       : larger(smaller(0.1 * start, wanted), rounding_residual(sums.value[2], start));
    state->rz = sums.value[1];
    state->begin(start, most_iterations);
  }
};

}  // namespace

// The gap times the augmentation is a stress.
double ViscousStep::wanted_gap(const Step& step, Real spacing) const {
  return tolerance_share * numerics_.tolerance * step.kick /
         (relative_augmentation() * static_cast<double>(spacing));
}

SolveResult ViscousStep::solve_exact(const LinearSystem& matrix, const PairContext& c, const RowCells& rows,
                                     const Step& step, Buffer<Quad>& increment) {
  // Many solves with one matrix, each of few iterations: the coarse levels pay later than in a single solve.
  constexpr int patience = 30, at_once = 8;
  const Index n = matrix.size;
  base_.resize(n);
  launch_reduction<AddUp>(context_, "start", n, StartExact{matrix, predicted_.span(), base_.span()},
                          KeepRightHandSide{work_.state()});
  // The residual against the stresses of the last iteration bounds the velocity error as in other solves
  // (A >= m). A gap below a thousandth of the shear rate is rounding.
  const double wanted = tolerance_share * wanted_residual(step, n);
  const double gap_wanted = wanted_gap(step, c.flow.spacing);
  SolveResult result;
  bool rates_agree = false;
  double gap = 0, change = 0;
  for (;;) {
    const bool last = result.yield_iterations == numerics_.yield_iterations;
    const int most = last ? 0 : most_by_diagonal(patience);
    yield_.add_force(c, static_cast<Real>(step.dt), base_.span(), right_hand_side_.span());
    launch_reduction<AddUp>(
        context_, "residual", n, StartResidual{{matrix, increment.span(), work_.residual.span()}},
        BeginInnerSolve{work_.state(), wanted, result.yield_iterations == 0, rates_agree, most});
    if (most > 0) launch_conjugate_gradient(context_, matrix, smaller(at_once, most), increment, work_);
    const SolveState now = work_.read(context_).solve;
    result.residual = now.residual, result.right_hand_side = now.right_hand_side;
    result.converged = now.iterations == 0 && now.residual <= now.enough;
    if (result.converged || last) break;
    const SolveResult inner = go_on(matrix, rows, now, square(now.limit) / step.mass, increment);
    result.iterations += inner.iterations, result.residual = inner.residual;
    if (!inner.converged && !(inner.residual <= wanted)) break;
    add_increment(increment);
    const ExactYield::Rates rates = yield_.update(c, velocity_.span());
    gap += rates.gap, change += rates.change;
    rates_agree = rates.gap <= gap_wanted + 1e-3 * rates.shear;
    ++result.yield_iterations;
  }
  yield_.balance(gap, change);
  return result;
}

}  // namespace slagflow
