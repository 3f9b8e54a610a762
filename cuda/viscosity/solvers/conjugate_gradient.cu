#include "viscosity/solvers/residual.hpp"
#include "viscosity/solvers/solver.hpp"

namespace slagflow {

namespace {

constexpr int restarts = 3;
// Iterations from which the recursive residual may differ from the true one.
constexpr int drift_matters = 10;

// p = z + beta p
struct NewDirection {
  Span<const Quad> diagonal, r;
  Span<Quad> p;
  const SolveState* state;
  HOST_DEVICE bool idle() const { return !state->running; }
  HOST_DEVICE void operator()(Index i) const {
    const Real beta = state->beta;
    const Vec3 z = over_diagonal(xyz(r[i]), diagonal[i]);
    p[i] = quad(beta == 0 ? z : z + beta * xyz(p[i]), 0);
  }
};

// u += alpha p, r -= alpha A p; r.r and r.z of the new residual
struct Advance {
  static constexpr int terms = 2;
  Span<const Quad> diagonal, p, product;
  Span<Quad> u, r;
  SolveState* state;
  HOST_DEVICE bool idle() const { return !state->running; }
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const Real alpha = state->alpha;
    u[i] = quad(xyz(u[i]) + alpha * xyz(p[i]), 0);
    const Vec3 value = xyz(r[i]) - alpha * xyz(product[i]);
    r[i] = quad(value, 0);
    return {{dot(to_double(value), to_double(value)),
             dot(to_double(value), to_double(over_diagonal(value, diagonal[i])))}};
  }
};

struct JudgeIteration {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<2>& sums) const {
    SolveState& s = *state;
    s.residual = std::sqrt(sums.value[0]);
    ++s.iterations;
    s.beta = static_cast<Real>(sums.value[1] / s.rz);
    s.rz = sums.value[1];
    const bool met = s.residual <= s.limit;
    if (met && s.iterations - s.started_at < drift_matters) s.converged = 1;
    s.running = !met && s.iterations < s.most_iterations ? 1 : 0;
  }
};

// The true residual once iterations have ended for another reason than that few of them were enough.
struct TrueResidual : Residual {
  const SolveState* state;
  HOST_DEVICE bool idle() const { return state->running || state->converged; }
};

// Goes on from the true residual if it is still too large.
struct JudgeSolution {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<2>& sums) const {
    SolveState& s = *state;
    s.residual = std::sqrt(sums.value[0]);
    s.rz = sums.value[1];
    s.beta = 0;
    s.started_at = s.iterations;
    ++s.starts;
    s.running = s.residual > s.limit && s.iterations < s.most_iterations && s.starts < restarts ? 1 : 0;
    if (!s.running) s.converged = s.residual <= 2 * s.limit ? 1 : 0;
  }
};

}  // namespace

void launch_conjugate_gradient(Context& context, const LinearSystem& system, int iterations, Buffer<Quad>& u,
                               SolverWorkspace& work) {
  const Rows n = system.size;
  const auto r = work.residual.span(), p = work.direction.span(), product = work.product.span();
  SolveState* state = work.state();
  for (int k = 0; k < iterations; ++k) {
    launch(context, "direction", n, NewDirection{system.diagonal, r, p, state});
    exchange_while(context, n, &state->running, work.direction);
    launch_reduction<AddUp>(context, "multiply", n, while_running(state, Multiply{system, p, product}),
                            JudgeDirection{state});
    launch_reduction<AddUp>(context, "advance", n, Advance{system.diagonal, p, product, u.span(), r, state},
                            JudgeIteration{state});
  }
  exchange_unless(context, n, {&state->running, &state->converged}, u);
  launch_reduction<AddUp>(context, "residual", n, TrueResidual{{system, u.span(), r}, state},
                          JudgeSolution{state});
}

SolveResult conjugate_gradient(Context& context, const LinearSystem& system, SolveState now, Buffer<Quad>& u,
                               SolverWorkspace& work) {
  constexpr int at_a_time = 8;
  while (now.running) {
    launch_conjugate_gradient(context, system, at_a_time, u, work);
    now = work.read(context).solve;
  }
  return {now.iterations, now.residual, now.right_hand_side, now.converged != 0};
}

}  // namespace slagflow
