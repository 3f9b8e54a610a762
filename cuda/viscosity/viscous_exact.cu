// The implicit step with an exact yield stress: the iteration of exact_yield.hpp around the linear solver.
#include <limits>

#include "backend/reduce.hpp"
#include "viscosity/solvers/residual.hpp"
#include "viscosity/viscous.hpp"

namespace slagflow {

namespace {

// What the iteration lacks at its end acts like more viscosity, always against the flow, where the errors of
// a linear solve go either way: of the tolerance only this share is allowed. (With all of it a discharge was
// slower by 3 %.)
constexpr double tolerance_share = 0.1;

// base = b - A u*
struct StartExact {
  static constexpr int terms = 2;  // |b_i|^2, |u*_i|^2
  LinearSystem system;
  Span<const Quad> predicted;
  Chords chords;
  Span<Quad> base;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const Vec3 b = xyz(system.right_hand_side[i]);
    base[i] = quad(b - system.apply(i, predicted) - system.along_chords(i, chords), 0);
    const Vec3d speed = to_double(xyz(predicted[i]));
    return {{dot(to_double(b), to_double(b)), dot(speed, speed)}};
  }
};

struct KeepStart {
  SolveState* state;
  Index size;
  HOST_DEVICE void operator()(const Terms<2>& squared) const {
    state->right_hand_side = std::sqrt(squared.value[0]);
    state->speed = size > 0 ? std::sqrt(squared.value[1] / size) : 0;
  }
};

struct StartResidual {
  // |r_i|^2, r_i.z_i, |D_i delta_i|^2 with the diagonal D, and the squared size of the forces of the stresses
  static constexpr int terms = 4;
  Residual residual;
  HOST_DEVICE Terms<4> operator()(Index i) const {
    const Terms<2> own = residual(i);
    const LinearSystem& system = residual.system;
    return {{own.value[0], own.value[1], scaled_squared(system.diagonal[i], residual.u[i]),
             square(static_cast<double>(system.right_hand_side[i].w))}};
  }
};

constexpr auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

// The rms velocity error that is allowed, not below the rounding of velocities of this rms speed.
HOST_DEVICE inline double allowed_error(double velocity, double speed) {
  return larger(velocity, 2 * epsilon * speed);
}

// A tenth of the start's residual, however small: a plug must come to rest, not stop within a tolerance.
// Where the iteration has converged, nothing is solved.
struct BeginInnerSolve {
  SolveState* state;
  double allowed;   // [m/s]
  double scale;     // [kg] residual over the velocity error that it bounds
  double of_rates;  // [m/s] rounding of strain rates, as a velocity error
  bool first, rates_agree;
  int most_iterations;
  HOST_DEVICE void operator()(const Terms<4>& sums) const {
    const double start = std::sqrt(sums.value[0]);
    const double of_stresses = larger(epsilon * std::sqrt(sums.value[3]), scale * of_rates);
    const double wanted = scale * allowed_error(allowed, state->speed);
    const auto rounding = [&](double from) {
      return larger(of_stresses, rounding_residual(sums.value[2], from));
    };
    if (first) state->first_residual = start;
    state->enough = rates_agree ? larger(wanted, rounding(state->first_residual)) : -1;
    state->limit = start <= state->enough ? start : larger(smaller(0.1 * start, wanted), rounding(start));
    state->rz = sums.value[1];
    state->begin(start, most_iterations);
  }
};

}  // namespace

void ViscousStep::start_exact(const LinearSystem& matrix, const Chords& chords) {
  launch_reduction<AddUp>(context_, "start", matrix.size,
                          StartExact{matrix, predicted_.span(), chords, base_.span()},
                          KeepStart{work_.state(), matrix.size});
}

// The first iterations of a solve with the stresses as they are.
SolveState ViscousStep::start_inner(const LinearSystem& matrix, const PairContext& c, const Step& step,
                                    const ExactProgress& progress, Buffer<Quad>& increment) {
  // Many solves with one matrix, each of few iterations: the coarse levels pay later than in a single solve.
  constexpr int patience = 30, at_once = 8;
  const int most = progress.iterations < numerics_.yield_iterations ? most_by_diagonal(patience) : 0;
  yield_.add_force(c, static_cast<Real>(step.dt), base_.span(), right_hand_side_.span());
  launch_reduction<AddUp>(context_, "residual", matrix.size,
                          StartResidual{{matrix, increment.span(), work_.residual.span()}},
                          BeginInnerSolve{work_.state(), progress.allowed, progress.scale, progress.rounding,
                                          progress.iterations == 0, progress.rates_agree, most});
  if (most > 0) launch_conjugate_gradient(context_, matrix, smaller(at_once, most), increment, work_);
  return work_.read(context_).solve;
}

// A gap below a thousandth of the shear rate changes nothing. Where much of a plug is close to yielding its
// stresses go on to shift for long, which velocities hardly feel: from half of the iterations on a thousandth
// of them is enough.
void ViscousStep::judge(const ExactYield::Misfit& misfit, double speed, ExactProgress& progress) const {
  constexpr double share = 1e-3;
  ++progress.iterations;
  progress.rounding = misfit.rounding;
  progress.rates_agree =
      misfit.gap <= allowed_error(progress.allowed, speed) + share * misfit.shear + misfit.rounding;
  progress.settled =
      2 * progress.iterations >= numerics_.yield_iterations && misfit.gap <= share * misfit.stress;
}

SolveResult ViscousStep::solve_exact(const LinearSystem& matrix, const PairContext& c, const RowCells& rows,
                                     const Step& step, FluidArrays& fluid) {
  int balanced_after = 10;  // and after ever more: augmentations that change for ever need not converge
  constexpr double largest_factor = 3;
  Buffer<Quad>& increment = fluid.increment;
  const Chords along = chords(step, fluid);
  base_.resize(matrix.size);
  start_exact(matrix, along);
  // The residual against the stresses of the last iteration bounds the velocity error as in other solves
  // (A >= m).
  ExactProgress progress;
  progress.allowed = tolerance_share * numerics_.tolerance * step.kick;
  progress.scale = step.mass * std::sqrt(static_cast<double>(matrix.size));
  SolveResult result;
  while (!result.converged) {
    const SolveState now = start_inner(matrix, c, step, progress, increment);
    result.residual = now.residual, result.right_hand_side = now.right_hand_side;
    result.converged = now.iterations == 0 && now.residual <= now.enough;
    if (result.converged || progress.iterations == numerics_.yield_iterations) break;
    const SolveResult inner = go_on(matrix, rows, now, square(now.limit) / step.mass, increment);
    result.iterations += inner.iterations, result.residual = inner.residual;
    if (!inner.converged && !(inner.residual <= progress.scale * allowed_error(progress.allowed, now.speed)))
      break;
    judge(yield_.update(c, predicted_.span(), increment.span(), along), now.speed, progress);
    result.converged = progress.settled;
    if (result.converged || numerics_.yield_augmentation > 0 || progress.iterations < balanced_after)
      continue;
    balanced_after *= 2;
    yield_.begin(c, fluid, augmentation(c, step, largest_factor));
    assemble(c, step, fluid);
    start_exact(matrix, along);
  }
  result.yield_iterations = progress.iterations;
  return result;
}

Span<const double> ViscousStep::yield_work(const PairContext& c, const Step& step) {
  if (!exact_yield_stress()) return {};
  return yield_.measure_work(c, static_cast<Real>(step.dt), predicted_.span(), velocity_.span(),
                             &record()->solve);
}

}  // namespace slagflow
