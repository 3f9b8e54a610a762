// Conjugate gradients whose preconditioner is the point diagonal plus a W cycle over rigid motions of
// aggregates (cells, then 2x2x2 of them, ...). A plug that is stiff but unyielded moves nearly as a rigid
// body; what the diagonal alone would pass on from particle to particle, one iteration each, the coarse
// levels carry across the body at once. Additive on the rows, with damped block Jacobi on the coarser levels:
// linear and symmetric, so that the iteration is plain conjugate gradients. Aggregation with rigid-body
// modes: P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179 (without their smoothing of the modes).
#pragma once

#include <memory>
#include <vector>

#include "viscosity/solvers/dense_inverse.hpp"
#include "viscosity/solvers/solver.hpp"

namespace slagflow {

class Multigrid {
 public:
  explicit Multigrid(Context&);

  struct Problem {
    Buffer<Quad>& u;
    SolverWorkspace& work;  // with the residual of u, and the state of a solve that ended without success
  };
  // Goes on from `now`, that state, until the residual is small enough. Returns the state at the end, with
  // the true residual.
  SolveState solve(const LinearSystem&, const RowCells&, const SolveLimits&, SolveState now, Problem);
  // The same on the device alone, where the state says that it is needed then, up to its first end; may be
  // recorded. prepared() for these rows only.
  void launch_solve(const LinearSystem&, const RowCells&, const SolveLimits&, Problem);

  // Finds the aggregates of all levels and takes their memory, which waits; nothing where prepared() already.
  void prepare(const RowCells&, Index row_count);
  bool prepared(const RowCells&) const;
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

  void launch_start(const LinearSystem&, const RowCells&, const SolveLimits&, Problem);
  // A few, which the state may end.
  void launch_iterations(const LinearSystem&, const RowCells&, const SolveLimits&, Problem);
  // The true residual, once they have ended.
  void launch_end(const LinearSystem&, Problem);
  template <class Finish>
  void precondition(const LinearSystem&, const RowCells&, Span<const Quad> r, Span<Quad> z, Finish);
  // While iterations go on.
  template <class Body>
  void launch_level(const char* label, Index n, const Body&);
  void cycle(std::size_t number);
  void residual(Level&, Span<double> rest);
  bool coarsest(std::size_t number) const { return number + 1 == used_; }

  Context& context_;
  std::vector<std::unique_ptr<Level>> levels_;  // all that were ever needed
  std::size_t used_ = 0;
  std::uint64_t arrangement_ = 0;  // of the rows whose aggregates they are
  DenseInverse dense_;             // of the coarsest
  Buffer<Quad> preconditioned_;
  const SolveState* state_ = nullptr;  // of the solve under way
};

}  // namespace slagflow
