// Conjugate gradients whose preconditioner is the point diagonal plus a W cycle over rigid motions of
// aggregates (cells, then 2x2x2 of them, ...). A plug that is stiff but unyielded moves nearly as a rigid
// body; what the diagonal alone would pass on from particle to particle, one iteration each, the coarse
// levels carry across the body at once. Additive on the rows, with damped block Jacobi on the coarser levels:
// linear and symmetric, so that the iteration is plain conjugate gradients. Aggregation with rigid-body
// modes: P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179 (without their smoothing of the modes).
#pragma once

#include <memory>
#include <vector>

#include "backend/launch_graph.hpp"
#include "solvers/coarse_matrix.hpp"
#include "solvers/solver.hpp"

namespace slagflow {

class Multigrid {
 public:
  explicit Multigrid(Context&);

  struct Problem {
    Buffer<Quad>& u;
    SolverWorkspace& work;  // with the residual of u
    SolveResult& result;    // with its norm and the iterations so far
  };
  // Goes on from u until the residual is small enough, and leaves the true residual in the result.
  void solve(const LinearSystem&, const RowCells&, const SolveLimits&, Problem);

  // Launches one by one from now on.
  void launch_singly() { iterations_.launch_singly(); }

  // Sets up the coarse levels.
  void build(const LinearSystem&, const RowCells&);
  // z = M^-1 r, M the preconditioner.
  void precondition(const LinearSystem&, const RowCells&, Span<const Quad> r, Span<Quad> z);

 private:
  struct Level {
    explicit Level(Context& c)
        : matrix(c), force(c, "coarse forces"), motion(c, "coarse motions"), rest(c, "coarse residuals") {}
    CoarseMatrix matrix;
    Buffer<double> force, motion, rest;
  };

  // Iterates anew from the residual at hand; the state tells how it ended, and the true residual.
  SolveState iterate(const LinearSystem&, const RowCells&, const SolveLimits&, Problem&);
  // A few of them, which the state may end.
  void launch_iterations(const LinearSystem&, const RowCells&, double bound, Problem&);
  template <class Finish>
  void precondition(const LinearSystem&, const RowCells&, Span<const Quad> r, Span<Quad> z, Finish);
  // While iterations go on.
  template <class Body>
  void launch_level(const char* label, Index n, const Body&);
  void cycle(std::size_t number);
  void residual(Level&);

  Context& context_;
  std::vector<std::unique_ptr<Level>> levels_;  // all that were ever needed
  std::size_t used_ = 0;
  Buffer<double> dense_;  // inverse of the coarsest matrix
  Buffer<Quad> preconditioned_;
  LaunchGraph iterations_;
  const SolveState* state_ = nullptr;  // of the solve under way
};

}  // namespace slagflow
