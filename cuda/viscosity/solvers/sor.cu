#include "viscosity/solvers/residual.hpp"
#include "viscosity/solvers/solver.hpp"

namespace slagflow {

namespace {

// Colours of the cells along one axis: alternating; an odd periodic axis needs a third one for its last cell.
struct Colours {
  int number[3];

  explicit Colours(const CellGrid& grid) {
    for (int k = 0; k < 3; ++k) {
      const bool odd_ring = grid.periodic[k] && grid.count[k] % 2 == 1;
      number[k] = grid.count[k] == 1 ? 1 : (odd_ring ? 3 : 2);
    }
  }
  int total() const { return number[0] * number[1] * number[2]; }
};

// One thread relaxes all rows of one cell, in order, in place.
struct RelaxCell {
  LinearSystem system;
  RowCells rows;
  int colour[3];
  int cells[3];  // of this colour along each axis
  Real omega;
  Span<Quad> u;

  HOST_DEVICE void operator()(Index n) const {
    const int part[3] = {n % cells[0], n / cells[0] % cells[1], n / cells[0] / cells[1]};
    Index cell = 0;
    for (int k = 0; k < 3; ++k) {
      const int c = colour[k] == 2 ? rows.grid.count[k] - 1 : 2 * part[k] + colour[k];
      cell += c * rows.grid.stride[k];
    }
    for (Index i = rows.cell_start[cell]; i < rows.cell_start[cell + 1]; ++i) relax(i);
  }

  // Gauss-Seidel over the three components, over-relaxed.
  HOST_DEVICE void relax(Index i) const {
    const RelaxationRow row(system, i, u);
    const Symmetric3& block = row.block;
    const Vec3 r = row.residual;
    Vec3 step;
    step.x = omega * r.x / block.xx;
    step.y = omega * (r.y - block.xy * step.x) / block.yy;
    step.z = omega * (r.z - block.xz * step.x - block.yz * step.y) / block.zz;
    u[i] = quad(xyz(u[i]) + step, 0);
  }
};

void sweep(Context& context, const LinearSystem& system, const RowCells& rows, Real omega, Span<Quad> u) {
  const Colours colours(rows.grid);
  for (int c = 0; c < colours.total(); ++c) {
    RelaxCell body{system, rows, {}, {}, omega, u};
    int rest = c;
    for (int k = 0; k < 3; ++k) {
      const int count = rows.grid.count[k];
      body.colour[k] = rest % colours.number[k];
      rest /= colours.number[k];
      const int paired = colours.number[k] == 3 ? count - 1 : count;
      body.cells[k] = body.colour[k] == 2 ? 1 : (paired - body.colour[k] + 1) / 2;
    }
    launch(context, "relax", body.cells[0] * body.cells[1] * body.cells[2], body);
  }
}

// ||b - A u||; waits for it.
double residual_norm(Context& context, const LinearSystem& system, Span<const Quad> u,
                     SolverWorkspace& work) {
  launch_reduction<AddUp>(context, "residual", system.size, Residual{system, u, work.residual.span()},
                          KeepResidual{work.state()});
  return work.read(context).solve.residual;
}

}  // namespace

SolveResult sor(Context& context, const LinearSystem& system, const RowCells& rows, const SolveLimits& limits,
                Buffer<Quad>& u, SolverWorkspace& work) {
  constexpr int sweeps_per_check = 2;  // a check costs as much as a sweep
  SolveResult result;
  result.residual = limits.start_residual;
  for (;;) {
    result.converged = result.residual <= limits.residual;
    if (result.converged || result.iterations >= limits.max_iterations || !std::isfinite(result.residual))
      return result;
    for (int s = 0; s < sweeps_per_check; ++s)
      sweep(context, system, rows, static_cast<Real>(limits.relaxation), u.span());
    result.iterations += sweeps_per_check;
    result.residual = residual_norm(context, system, u.span(), work);
  }
}

}  // namespace slagflow
