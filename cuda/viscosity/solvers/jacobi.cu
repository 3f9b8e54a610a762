#include "viscosity/solvers/residual.hpp"
#include "viscosity/solvers/solver.hpp"

namespace slagflow {

namespace {

// r and the correction D^-1 r, D the 3x3 diagonal block. A <= 2 D, hence it converges for any pair system.
struct Sweep {
  static constexpr int terms = 2;  // as those of Residual
  LinearSystem system;
  Span<const Quad> u;
  Span<Quad> correction;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const RelaxationRow row(system, i, u);
    correction[i] = quad(row.block.solve(row.residual), 0);
    return {{dot(to_double(row.residual), to_double(row.residual)), 0}};
  }
};

struct Correct {
  Span<const Quad> correction;
  Span<Quad> u;
  HOST_DEVICE void operator()(Index i) const { u[i] = quad(xyz(u[i]) + xyz(correction[i]), 0); }
};

}  // namespace

SolveResult jacobi(Context& context, const LinearSystem& system, const SolveLimits& limits, Buffer<Quad>& u,
                   SolverWorkspace& work) {
  SolveResult result;
  for (;;) {
    exchange(context, system.size, u);
    launch_reduction<AddUp>(context, "sweep", system.size, Sweep{system, u.span(), work.direction.span()},
                            KeepResidual{work.state()});
    result.residual = work.read(context).solve.residual;
    result.converged = result.residual <= limits.residual;
    if (result.converged || result.iterations == limits.max_iterations || !std::isfinite(result.residual))
      return result;
    launch(context, "correct", system.size, Correct{work.direction.span(), u.span()});
    ++result.iterations;
  }
}

}  // namespace slagflow
