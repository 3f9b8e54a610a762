#include <limits>

#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "solvers/residual.hpp"
#include "viscous.hpp"

namespace slagflow {

namespace {

// The unknown is what viscosity adds, delta = u^{k+1} - u*, not u^{k+1} itself: in a stiff plug that moves
// fast the rounding of u alone would leave a residual far above the tolerance. Turns the right hand side b
// into b - A u* and starts from the last delta, as the pressure gradient and gravity that it balanced then it
// balances now.
struct StartFromPredicted {
  LinearSystem system;
  Span<const Quad> predicted, increment;
  Span<Quad> right_hand_side, residual;
  Span<double> squared;
  HOST_DEVICE void operator()(Index i) const {
    const LinearSystem::Two product = system.apply(i, predicted, increment);
    const Vec3 b = xyz(right_hand_side[i]) - product.u, r = b - product.v;
    right_hand_side[i] = quad(b, 0);
    residual[i] = quad(r, 0);
    squared[i] = dot(to_double(r), to_double(r));
  }
};

struct AddIncrement {
  Span<const Quad> predicted, increment;
  Span<Quad> velocity;
  HOST_DEVICE void operator()(Index i) const { velocity[i] = quad(xyz(predicted[i]) + xyz(increment[i]), 0); }
};

// |v_i|^2, or |D_i v_i|^2 with the diagonal D.
struct SquaredLength {
  Span<const Quad> v, diagonal;
  Span<double> squared;
  HOST_DEVICE void operator()(Index i) const {
    Vec3d value = to_double(xyz(v[i]));
    if (diagonal.data) {
      const Vec3d d = to_double(xyz(diagonal[i]));
      value = {d.x * value.x, d.y * value.y, d.z * value.z};
    }
    squared[i] = dot(value, value);
  }
};

// delta = -dt K v / m with A = m + dt K, v the old velocity; the walls' share is in b - m u*.
struct ExplicitStep {
  LinearSystem system;
  Span<const Quad> predicted, velocity;
  Span<Quad> increment;
  HOST_DEVICE void operator()(Index i) const {
    const Real mass = system.diagonal[i].w;
    const Vec3 drag = xyz(system.right_hand_side[i]) - mass * xyz(predicted[i]);
    const Vec3 viscous = system.apply(i, velocity) - mass * xyz(velocity[i]) - drag;
    increment[i] = quad((-1 / mass) * viscous, 0);
  }
};

struct Forget {
  Span<Quad> increment;
  HOST_DEVICE void operator()(Index i) const { increment[i] = {}; }
};

// b -= (1 - theta)/theta [theta dt K v - wall part], v the old velocity or u*; theta dt K v = A v - m v.
struct ExplicitHalf {
  LinearSystem system;
  Span<const Quad> predicted, velocity;
  Real ratio;
  Span<Quad> right_hand_side;
  HOST_DEVICE void operator()(Index i) const {
    const Real mass = system.diagonal[i].w;
    const Vec3 drag = xyz(right_hand_side[i]) - mass * xyz(predicted[i]);
    const Vec3 viscous = system.apply(i, velocity) - mass * xyz(velocity[i]) - drag;
    right_hand_side[i] = quad(xyz(right_hand_side[i]) - ratio * viscous, 0);
  }
};

}  // namespace

ViscousStep::ViscousStep(Context& c, const NumericsSetup& numerics)
    : context_(c),
      numerics_(numerics),
      base_(c, "base of the right hand side"),
      predicted_(c, "predicted velocities"),
      velocity_(c, "solved velocities"),
      diagonal_(c, "matrix diagonal"),
      right_hand_side_(c, "right hand side"),
      wall_(c, "wall blocks"),
      weight_(c, "link weights"),
      work_(c),
      multigrid_(c),
      yield_(c) {}

void ViscousStep::resize(Index count, Offset pair_capacity) {
  constexpr Offset margin_percent = 1;
  predicted_.resize(count), velocity_.resize(count), diagonal_.resize(count), right_hand_side_.resize(count);
  wall_.resize(count), weight_.resize(pair_capacity, margin_percent);
}

LinearSystem ViscousStep::system(const PairContext& c) const {
  return {c.fluid.count,    c.fluid_list, weight_.span(),          c.fluid.place,
          diagonal_.span(), wall_.span(), right_hand_side_.span(), c.box,
          c.flow.coupling};
}

SolveResult ViscousStep::advance(const PairContext& whole, const RowCells& rows, const Step& step,
                                 Offset pair_capacity, FluidArrays& fluid) {
  const Index n = fluid.count;
  resize(n, pair_capacity);
  if (exact_yield_stress()) yield_.begin(whole, fluid, augmentation(whole, step));
  const PairContext c = as_solved(whole);
  const bool is_explicit = numerics_.viscous_step == ViscousStepping::explicit_step;
  const auto theta = static_cast<Real>(is_explicit ? 1 : numerics_.theta);
  {
    Section timer(context_, "predictor and assembly");
    const PredictorOutput out{predicted_.span(), weight_.span(), diagonal_.span(), wall_.span(),
                              right_hand_side_.span()};
    predict_and_assemble(context_, c, out, static_cast<Real>(step.dt), theta);
  }
  Section timer(context_, "viscous solve");
  const LinearSystem matrix = system(c);
  if (theta < 1)
    launch(context_, "explicit half", n,
           ExplicitHalf{matrix, predicted_.span(), explicit_velocity(fluid), (1 - theta) / theta,
                        right_hand_side_.span()});
  SolveResult result;
  result.converged = true;
  if (is_explicit)
    launch(context_, "explicit step", n,
           ExplicitStep{matrix, predicted_.span(), fluid.motion.span(), fluid.increment.span()});
  else if (exact_yield_stress())
    result = solve_exact(matrix, c, rows, step, fluid.increment);
  else
    result = solve_for_increment(matrix, rows, step, fluid.increment);
  launch(context_, "add increment", n,
         AddIncrement{predicted_.span(), fluid.increment.span(), velocity_.span()});
  return result;
}

double ViscousStep::implicit_share() const {
  return numerics_.viscous_step == ViscousStepping::explicit_step ? 0 : numerics_.theta;
}

Span<const Quad> ViscousStep::explicit_velocity(const FluidArrays& fluid) const {
  const bool predicted = numerics_.viscous_step == ViscousStepping::implicit_step &&
                         numerics_.explicit_part == ExplicitPart::predicted;
  return predicted ? predicted_.span() : fluid.motion.span();
}

PairContext ViscousStep::as_solved(const PairContext& c) const {
  return exact_yield_stress() ? yield_.viscous_part(c) : c;
}

WallYield ViscousStep::wall_yield() const { return exact_yield_stress() ? yield_.walls() : WallYield{}; }

double ViscousStep::relative_augmentation() const {
  return numerics_.yield_augmentation > 0 ? numerics_.yield_augmentation : yield_.balanced_augmentation();
}

Real ViscousStep::augmentation(const PairContext& c, const Step& step) const {
  const double spacing = static_cast<double>(c.flow.spacing);
  const double density = step.mass / (c.flow.dimensions == 2 ? square(spacing) : spacing * square(spacing));
  return static_cast<Real>(relative_augmentation() * density * square(spacing) / step.dt);
}

SolveResult ViscousStep::solve_for_increment(const LinearSystem& matrix, const RowCells& rows,
                                             const Step& step, Buffer<Quad>& increment) {
  const Index n = matrix.size;
  const double b = norm_of(right_hand_side_.span(), Weighted::no);
  work_.residual.resize(n), work_.squared.resize(n);
  launch(context_, "start", n,
         StartFromPredicted{matrix, predicted_.span(), increment.span(), right_hand_side_.span(),
                            work_.residual.span(), work_.squared.span()});
  const double start = std::sqrt(sum(context_, work_.squared.span()));
  // A >= m, so ||u - u_exact|| <= ||r|| / m: the residual bounds the rms velocity error.
  const double wanted = wanted_residual(step, n), rounding = rounding_residual(increment.span(), start);
  SolveResult result = solve(matrix, rows,
                             {larger(wanted, rounding), wanted * wanted / step.mass, numerics_.max_iterations,
                              numerics_.relaxation, start},
                             increment);
  result.right_hand_side = b;
  return result;
}

double ViscousStep::wanted_residual(const Step& step, Index count) const {
  return numerics_.tolerance * step.mass * step.kick * std::sqrt(static_cast<double>(count));
}

// Rounding keeps the residual above about epsilon ||D delta||, D the diagonal of A, and a millionth of its
// start.
double ViscousStep::rounding_residual(Span<const Quad> increment, double start) {
  constexpr double epsilon = std::numeric_limits<Real>::epsilon();
  return larger(epsilon * norm_of(increment, Weighted::by_diagonal), 8 * epsilon * start);
}

void ViscousStep::forget(Buffer<Quad>& increment) {
  launch(context_, "forget", static_cast<Index>(increment.size()), Forget{increment.span()});
}

double ViscousStep::norm_of(Span<const Quad> v, Weighted weighted) {
  work_.squared.resize(v.size);
  launch(context_, "norm", static_cast<Index>(v.size),
         SquaredLength{v, weighted == Weighted::no ? Span<const Quad>{} : diagonal_.span(),
                       work_.squared.span()});
  return std::sqrt(sum(context_, work_.squared.span()));
}

SolveResult ViscousStep::solve(const LinearSystem& matrix, const RowCells& rows, const SolveLimits& limits,
                               Buffer<Quad>& increment) {
  switch (numerics_.solver) {
    case ViscousSolver::jacobi:
      return jacobi(context_, matrix, limits, increment, work_);
    case ViscousSolver::sor:
      return sor(context_, matrix, rows, limits, increment, work_);
    case ViscousSolver::conjugate_gradient:
      return conjugate_gradient(context_, matrix, limits, increment, work_);
    case ViscousSolver::multigrid:
      break;
  }
  // The diagonal alone serves while a few iterations are enough: the coarse levels cost as much as some ten.
  // An exact yield stress has many solves with one matrix, each of few iterations.
  const int patience = exact_yield_stress() ? 30 : 4;
  SolveLimits first = limits;
  first.max_iterations = smaller(patience, limits.max_iterations);
  SolveResult result = conjugate_gradient(context_, matrix, first, increment, work_);
  if (!result.converged) multigrid_.solve(matrix, rows, limits, {increment, work_, result});
  return result;
}

}  // namespace slagflow
