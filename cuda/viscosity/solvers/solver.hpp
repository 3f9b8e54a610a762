// Solvers of the linear system, each in its own file, and their common workspace.
#pragma once

#include "backend/buffer.hpp"
#include "fluid/step_record.hpp"
#include "viscosity/linear_system.hpp"

namespace slagflow {

struct SolverWorkspace {
  explicit SolverWorkspace(Context& c)
      : residual(c, "solver residual"),
        direction(c, "solver direction"),
        product(c, "solver product"),
        record(c, "step record") {
    record.upload({StepRecord{}});
  }
  void resize(Index n) { residual.resize(n), direction.resize(n), product.resize(n); }
  SolveState* state() { return &record.span().data->solve; }
  // What the device has found up to now; waits for it.
  StepRecord read(Context& context) {
    StepRecord now;
    context.copy_to_host(&now, record.span().data, sizeof now);
    return now;
  }
  // The same in two parts.
  void post(Context& context) { context.post_to_host(record.span().data, sizeof(StepRecord)); }
  StepRecord read_posted(Context& context) {
    static_assert(sizeof(StepRecord) <= Context::posted_bytes);
    StepRecord now;
    context.read_posted(&now, sizeof now);
    return now;
  }

  Buffer<Quad> residual, direction, product;
  Buffer<StepRecord> record;
};

// Each starts from u (warm start) with its residual in the workspace and its state begun, leaves the solution
// in u and reports the true residual.

// Conjugate gradients with the point diagonal as preconditioner. M. R. Hestenes, E. Stiefel (1952). The first
// iterations are launched without waiting for them; the rest, where the state says that there is one, by and
// by.
void launch_conjugate_gradient(Context&, const LinearSystem&, int iterations, Buffer<Quad>& u,
                               SolverWorkspace&);
SolveResult conjugate_gradient(Context&, const LinearSystem&, SolveState now, Buffer<Quad>& u,
                               SolverWorkspace&);

// Jacobi with the 3x3 diagonal blocks.
SolveResult jacobi(Context&, const LinearSystem&, const SolveLimits&, Buffer<Quad>& u, SolverWorkspace&);

// Successive over-relaxation, 0 < omega < 2, coloured by cell: rows of one colour are in cells that do not
// touch, so the sweep is the same whatever the number of threads. Within a cell rows go in order.
SolveResult sor(Context&, const LinearSystem&, const RowCells&, const SolveLimits&, Buffer<Quad>& u,
                SolverWorkspace&);

}  // namespace slagflow
