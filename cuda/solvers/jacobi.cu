#include "solvers/residual.hpp"
#include "solvers/solver.hpp"

namespace slagflow {

namespace {

// r and the correction D^-1 r, D the 3x3 diagonal block. A <= 2 D, hence it converges for any pair system.
struct Sweep {
  LinearSystem system;
  Span<const Quad> u;
  Span<Quad> correction;
  Span<double> squared;
  HOST_DEVICE void operator()(Index i) const {
    const RelaxationRow row(system, i, u);
    correction[i] = quad(row.block.solve(row.residual), 0);
    squared[i] = dot(to_double(row.residual), to_double(row.residual));
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
  work.direction.resize(system.size), work.squared.resize(system.size);
  for (;;) {
    launch(context, "sweep", system.size,
           Sweep{system, u.span(), work.direction.span(), work.squared.span()});
    result.residual = std::sqrt(sum(context, work.squared.span()));
    result.converged = result.residual <= limits.residual;
    if (result.converged || result.iterations == limits.max_iterations || !std::isfinite(result.residual))
      return result;
    launch(context, "correct", system.size, Correct{work.direction.span(), u.span()});
    ++result.iterations;
  }
}

}  // namespace slagflow
