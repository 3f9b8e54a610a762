// Solvers of the linear system, each in its own file, and their common workspace.
#pragma once

#include "backend/buffer.hpp"
#include "linear_system.hpp"

namespace slagflow {

struct SolverWorkspace {
  explicit SolverWorkspace(Context& c)
      : residual(c, "solver residual"),
        direction(c, "solver direction"),
        product(c, "solver product"),
        squared(c, "solver sums"),
        other(c, "solver sums") {}
  Buffer<Quad> residual, direction, product;
  Buffer<double> squared, other;
};

// Each starts from u (warm start), leaves the solution there and reports the true residual.

// Conjugate gradients with the point diagonal as preconditioner. M. R. Hestenes, E. Stiefel (1952).
SolveResult conjugate_gradient(Context&, const LinearSystem&, const SolveLimits&, Buffer<Quad>& u,
                               SolverWorkspace&);

// Jacobi with the 3x3 diagonal blocks.
SolveResult jacobi(Context&, const LinearSystem&, const SolveLimits&, Buffer<Quad>& u, SolverWorkspace&);

// Successive over-relaxation, 0 < omega < 2, coloured by cell: rows of one colour are in cells that do not
// touch, so the sweep is the same whatever the number of threads. Within a cell rows go in order.
SolveResult sor(Context&, const LinearSystem&, const RowCells&, const SolveLimits&, Buffer<Quad>& u,
                SolverWorkspace&);

}  // namespace slagflow
