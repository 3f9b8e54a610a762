#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "viscosity/solvers/residual.hpp"
#include "viscosity/viscous.hpp"

namespace slagflow {

namespace {

// The unknown is what viscosity adds, delta = u^{k+1} - u*, not u^{k+1} itself: in a stiff plug that moves
// fast the rounding of u alone would leave a residual far above the tolerance. Turns the right hand side b
// into b - A u* and starts from the last delta, as the pressure gradient and gravity that it balanced then it
// balances now.
struct StartFromPredicted {
  // |b_i|^2, |r_i|^2, r_i.z_i, |D_i delta_i|^2 with the diagonal D, |b_i - (A u*)_i|^2
  static constexpr int terms = 5;
  LinearSystem system;
  Span<const Quad> predicted, increment;
  Chords chords;
  Span<Quad> right_hand_side, residual;
  HOST_DEVICE Terms<5> operator()(Index i) const {
    const LinearSystem::Two product = system.apply(i, predicted, increment, chords);
    const Vec3d force = to_double(xyz(right_hand_side[i]));
    const Vec3 b = xyz(right_hand_side[i]) - product.u, r = b - product.v;
    right_hand_side[i] = quad(b, 0);
    residual[i] = quad(r, 0);
    return {{dot(force, force), dot(to_double(r), to_double(r)),
             dot(to_double(r), to_double(over_diagonal(r, system.diagonal[i]))),
             scaled_squared(system.diagonal[i], increment[i]), dot(to_double(b), to_double(b))}};
  }
};

// A >= m, so ||u - u_exact|| <= ||r|| / m: the residual bounds the rms velocity error. Thin fluid would meet
// that without a solve, and neither its viscosity nor a wall would act: the viscous impulse itself, b - A u*,
// must be known to a share.
struct BeginSolve {
  SolveState* state;
  double wanted_each;  // of one row
  Rows rows;
  int most_iterations;
  HOST_DEVICE void operator()(const Terms<5>& sums) const {
    constexpr double share = 0.03;
    const double start = std::sqrt(sums.value[1]), impulse = std::sqrt(sums.value[4]);
    const double wanted = wanted_each * std::sqrt(static_cast<double>(rows.on_device()));
    state->limit = larger(smaller(wanted, share * impulse), rounding_residual(sums.value[3], start));
    state->right_hand_side = std::sqrt(sums.value[0]);
    state->rz = sums.value[2];
    state->begin(start, most_iterations);
  }
};

struct Declare {
  SolveState* state;
  bool solved;
  HOST_DEVICE void operator()(Index) const { state->converged = solved ? 1 : 0, state->running = 0; }
};

struct AddIncrement {
  Span<const Quad> predicted, increment;
  Span<Quad> velocity;
  HOST_DEVICE void operator()(Index i) const { velocity[i] = quad(xyz(predicted[i]) + xyz(increment[i]), 0); }
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

// An impulse changes the kinetic energy by its product with the mean of the velocities before and after.
// (With u* for the last, what viscosity takes back at once would count as given, step by step.)
struct StepEnergy {
  static constexpr int terms = 2;
  Span<const Quad> state, increment, before, velocity, given;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const Vec3d delta = to_double(xyz(increment[i])), u = to_double(xyz(velocity[i]));
    const Vec3d mean = 0.5 * (to_double(xyz(before[i])) + u);
    return {{-static_cast<double>(state[i].w) * dot(delta, mean), dot(to_double(xyz(given[i])), mean)}};
  }
};

struct KeepEnergy {
  StepRecord* record;
  HOST_DEVICE void operator()(const Terms<2>& sums) const {
    record->taken = sums.value[0], record->given = sums.value[1];
  }
};

struct Forget {
  Span<Quad> increment, last;
  HOST_DEVICE void operator()(Index i) const { increment[i] = last[i] = {}; }
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

// The first guess of the next step with it: a pressure gradient that grew goes on to grow. Nothing is known
// of a change before the second step, and after a guess was forgotten.
struct AddAndGuess {
  Span<const Quad> predicted;
  Span<Quad> increment, last;
  Span<Quad> velocity;
  HOST_DEVICE void operator()(Index i) const {
    const Vec3 now = xyz(increment[i]), before = xyz(last[i]);
    const Real share = dot(before, before) > 0 ? Real(0.5) : Real(0);
    velocity[i] = quad(xyz(predicted[i]) + now, 0);
    last[i] = quad(now, 0);
    increment[i] = quad(now + share * (now - before), 0);
  }
};

ViscousStep::ViscousStep(Context& c, const NumericsSetup& numerics)
    : context_(c),
      numerics_(numerics),
      given_(c, "impulses of pairing and walls"),
      base_(c, "base of the right hand side"),
      predicted_(c, "predicted velocities"),
      velocity_(c, "solved velocities"),
      diagonal_(c, "matrix diagonal"),
      right_hand_side_(c, "right hand side"),
      wall_(c, "wall blocks"),
      weight_(c, "link weights"),
      short_weight_(c, "link weights"),
      work_(c),
      multigrid_(c),
      yield_(c) {}

void ViscousStep::reserve(Index count, Offset pair_capacity, const RowCells& rows) {
  constexpr Offset margin_percent = 1;
  predicted_.resize(count), velocity_.resize(count), diagonal_.resize(count);
  given_.resize(count), right_hand_side_.resize(count), wall_.resize(count);
  unit_ > 0 ? short_weight_.resize(pair_capacity, margin_percent)
            : weight_.resize(pair_capacity, margin_percent);
  work_.resize(count);
  if (device_loop() && needs_levels_) multigrid_.prepare(rows, count);
}

PairWeights ViscousStep::weights() const {
  if (unit_ > 0) return {short_weight_.span(), unit_};
  return {weight_.span()};
}

LinearSystem ViscousStep::system(const PairContext& c) const {
  return {
      c.fluid.count,           c.fluid_list, weights(),      c.fluid.place, diagonal_.span(), wall_.span(),
      right_hand_side_.span(), c.box,        c.flow.coupling};
}

SolveResult ViscousStep::advance(const PairContext& c, const RowCells& rows, const Step& step,
                                 Offset pair_capacity, FluidArrays& fluid) {
  reserve(fluid.local(), pair_capacity, rows);
  begin(c, rows, step, fluid);
  return finish(read(), c, rows, step, fluid);
}

void ViscousStep::begin(const PairContext& whole, const RowCells& rows, const Step& step,
                        FluidArrays& fluid) {
  const Rows n = fluid.count;
  constexpr double largest_factor = 1.5;  // of the augmentations, between steps
  if (exact_yield_stress()) yield_.begin(whole, fluid, augmentation(whole, step, largest_factor));
  const PairContext c = as_solved(whole);
  const auto theta = static_cast<Real>(assembled_share());
  assemble(c, step, fluid);
  exchange(context_, n, predicted_, fluid.increment);
  Section timer(context_, "viscous solve");
  const LinearSystem matrix = system(c);
  if (theta < 1)
    launch(context_, "explicit half", n,
           ExplicitHalf{matrix, predicted_.span(), explicit_velocity(fluid), (1 - theta) / theta,
                        right_hand_side_.span()});
  if (is_explicit()) {
    launch(context_, "explicit step", n,
           ExplicitStep{matrix, predicted_.span(), fluid.motion.span(), fluid.increment.span()});
    launch(context_, "solved", 1, Declare{work_.state(), true});
  } else if (exact_yield_stress()) {
    launch(context_, "not solved", 1, Declare{work_.state(), false});
  } else {
    begin_solve(matrix, rows, step, fluid);
  }
  launch(context_, "add increment", n, if_converged(work_.state(), end_solve(fluid)));
}

Chords ViscousStep::chords(const Step& step, const FluidArrays& fluid) const {
  const bool radial = numerics_.viscous_operator == ViscousOperator::radial;
  const double share = (2 * numerics_.theta - 1) / numerics_.theta;  // an explicit part sees the other half
  return {fluid.motion.span(), radial ? static_cast<Real>(0.5 * step.way * share) : Real(0)};
}

void ViscousStep::assemble(const PairContext& c, const Step& step, FluidArrays& fluid) {
  Section timer(context_, "predictor and assembly");
  PairWeightsToWrite weights(weight_.span());
  if (unit_ > 0) weights = {short_weight_.span(), unit_};
  const PredictorOutput out{
      predicted_.span(), fluid.by_pressure.span(), given_.span(), weights, diagonal_.span(),
      wall_.span(),      right_hand_side_.span()};
  predict_and_assemble(context_, c, out, static_cast<Real>(step.dt), static_cast<Real>(assembled_share()));
}

SolveResult ViscousStep::finish(const StepRecord& now, const PairContext& whole, const RowCells& rows,
                                const Step& step, FluidArrays& fluid) {
  const SolveState& s = now.solve;
  if (is_explicit()) return {0, 0, 0, true};
  needs_levels_ = s.level_starts > 0;
  if (s.converged) return {s.iterations, s.residual, s.right_hand_side, true};
  Section timer(context_, "viscous solve");
  const PairContext c = as_solved(whole);
  const double wanted = wanted_residual(step, fluid.count.of_all());
  SolveResult result = exact_yield_stress()
                           ? solve_exact(system(c), c, rows, step, fluid)
                           : go_on(system(c), rows, s, wanted * wanted / step.mass, fluid.increment);
  // Rounding may keep a solve from the share of the viscous impulse that it should know.
  if (!exact_yield_stress() && result.residual <= wanted) result.converged = true;
  if (result.converged) launch(context_, "solved", 1, Declare{work_.state(), true});
  if (exact_yield_stress())
    add_increment(fluid.increment);
  else
    launch(context_, "add increment", fluid.count, end_solve(fluid));
  return result;
}

AddAndGuess ViscousStep::end_solve(FluidArrays& fluid) {
  return {predicted_.span(), fluid.increment.span(), fluid.last_increment.span(), velocity_.span()};
}

void ViscousStep::add_increment(const Buffer<Quad>& increment) {
  launch(context_, "add increment", static_cast<Index>(increment.size()),
         AddIncrement{predicted_.span(), increment.span(), velocity_.span()});
}

void ViscousStep::launch_energy(const FluidArrays& fluid) {
  const Buffer<Quad>& increment = exact_yield_stress() ? fluid.increment : fluid.last_increment;
  const StepEnergy body{fluid.state.span(), increment.span(), fluid.motion.span(), velocity_.span(),
                        given_.span()};
  launch_reduction<AddUp>(context_, "energy of the step", fluid.count, if_converged(work_.state(), body),
                          KeepEnergy{record()});
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
  PairContext solved = exact_yield_stress() ? yield_.augmented(c) : c;
  return solved;
}

WallYield ViscousStep::wall_yield() const { return exact_yield_stress() ? yield_.walls() : WallYield{}; }

Augmentation ViscousStep::augmentation(const PairContext& c, const Step& step, double largest_factor) const {
  const double spacing = static_cast<double>(c.flow.spacing);
  const double density = step.mass / (c.flow.dimensions == 2 ? square(spacing) : spacing * square(spacing));
  return {static_cast<Real>(density * square(spacing) / step.dt),
          static_cast<Real>(numerics_.yield_augmentation), static_cast<Real>(largest_factor)};
}

// Of conjugate gradients with the diagonal as preconditioner, from which multigrid takes over.
int ViscousStep::most_by_diagonal(int patience) const {
  if (numerics_.solver == ViscousSolver::multigrid) return smaller(patience, numerics_.max_iterations);
  return numerics_.solver == ViscousSolver::conjugate_gradient ? numerics_.max_iterations : 0;
}

// The diagonal alone serves while a few iterations are enough: the coarse levels cost as much as some ten.
void ViscousStep::begin_solve(const LinearSystem& matrix, const RowCells& rows, const Step& step,
                              FluidArrays& fluid) {
  constexpr int patience = 4;
  Buffer<Quad>& increment = fluid.increment;
  const int most = most_by_diagonal(patience);
  const Rows all = matrix.size.halo ? Rows(matrix.size.of_all()) : matrix.size;
  launch_reduction<AddUp>(context_, "start", matrix.size,
                          StartFromPredicted{matrix, predicted_.span(), increment.span(), chords(step, fluid),
                                             right_hand_side_.span(), work_.residual.span()},
                          BeginSolve{work_.state(), wanted_residual(step, 1), all, most});
  if (most <= 0) return;
  const auto launch_batch = [&] {
    launch_conjugate_gradient(context_, matrix, smaller(patience, most), increment, work_);
  };
  if (!device_loop()) return launch_batch();
  context_.repeat_while(&work_.state()->running, launch_batch);
  if (!goes_on_with_levels(rows)) return;
  SolveLimits limits;
  limits.energy = square(wanted_residual(step, matrix.size.of_all())) / step.mass,
  limits.max_iterations = numerics_.max_iterations;
  multigrid_.launch_solve(matrix, rows, limits, {increment, work_});
}

// The rms velocity error that is allowed, as a residual.
double ViscousStep::wanted_residual(const Step& step, Index count) const {
  return numerics_.tolerance * step.mass * step.kick * std::sqrt(static_cast<double>(count));
}

void ViscousStep::forget(FluidArrays& fluid) {
  launch(context_, "forget", fluid.count, Forget{fluid.increment.span(), fluid.last_increment.span()});
}

SolveResult ViscousStep::go_on(const LinearSystem& matrix, const RowCells& rows, const SolveState& now,
                               double energy, Buffer<Quad>& increment) {
  if (now.converged) return {now.iterations, now.residual, now.right_hand_side, true};
  const SolveLimits limits{now.limit, energy, numerics_.max_iterations, numerics_.relaxation, now.residual};
  SolveResult result{now.iterations, now.residual, now.right_hand_side, false};
  switch (numerics_.solver) {
    case ViscousSolver::jacobi:
      result = jacobi(context_, matrix, limits, increment, work_);
      break;
    case ViscousSolver::sor:
      result = sor(context_, matrix, rows, limits, increment, work_);
      break;
    case ViscousSolver::conjugate_gradient:
      result = conjugate_gradient(context_, matrix, now, increment, work_);
      break;
    case ViscousSolver::multigrid:
      result = by_multigrid(matrix, rows, limits, now, increment);
      break;
  }
  result.right_hand_side = now.right_hand_side;
  return result;
}

SolveResult ViscousStep::by_multigrid(const LinearSystem& matrix, const RowCells& rows,
                                      const SolveLimits& limits, const SolveState& begun,
                                      Buffer<Quad>& increment) {
  const SolveResult result = conjugate_gradient(context_, matrix, begun, increment, work_);
  if (result.converged) return result;
  SolveState now = begun;
  now.iterations = result.iterations, now.residual = result.residual;
  now = multigrid_.solve(matrix, rows, limits, now, {increment, work_});
  needs_levels_ = true;
  return {now.iterations, now.residual, now.right_hand_side, now.converged != 0};
}

}  // namespace slagflow
