// The linear system of the implicit viscous step, as the solvers see it: no smoothing functions, no rheology.
//   (A u)_i = m_i u_i + B_i u_i + sum_j s_ij (s_ij . (u_i - u_j))    or, isotropic, |s_ij|^2 (u_i - u_j)
// with s_ij = -s_ji, hence A symmetric and positive definite: A >= m.
#pragma once

#include "backend/buffer.hpp"
#include "cells.hpp"
#include "math.hpp"

namespace slagflow {

// One off-diagonal entry: the outer product of `s` couples particle i to `other`.
struct alignas(4 * sizeof(Real)) Link {
  Vec3 s;  // [sqrt(kg)]
  Index other;
};

struct LinearSystem {
  Index size = 0;
  Offset stride = 1;
  Span<const Offset> slice;  // where the links of each slice of rows begin
  int slice_width = 1;
  Span<const Index> length;  // links of each row
  Span<const Link> link;
  Span<const Quad> diagonal;         // xyz: diagonal of A [kg], w: mass [kg]
  Span<const Symmetric3> wall;       // B_i [kg]
  Span<const Quad> right_hand_side;  // [kg m/s]
  PairCoupling coupling = PairCoupling::radial;

  HOST_DEVICE Offset row(Index i) const { return slice[i / slice_width] + i % slice_width; }

  // (A u)_i
  HOST_DEVICE Vec3 apply(Index i, Span<const Quad> u) const {
    const Vec3 here = xyz(u[i]);
    Vec3 sum = diagonal[i].w * here + wall[i] * here;
    const Offset first = row(i);
    const Index n = length[i];
    for (Index k = 0; k < n; ++k) {
      const Link l = link[first + k * stride];
      sum += couple(coupling, l.s, here - xyz(u[l.other]));
    }
    return sum;
  }
};

// What a stationary solver needs of row i: b - A u and the 3x3 diagonal block of A. The point diagonal would
// not do: the outer product of an oblique link is up to three times as large as its diagonal.
struct RelaxationRow {
  Vec3 residual;
  Symmetric3 block;

  HOST_DEVICE RelaxationRow(const LinearSystem& system, Index i, Span<const Quad> u) : block(system.wall[i]) {
    const Vec3 here = xyz(u[i]);
    const Real mass = system.diagonal[i].w;
    residual = xyz(system.right_hand_side[i]) - mass * here - block * here;
    const Offset first = system.row(i);
    for (Index k = 0; k < system.length[i]; ++k) {
      const Link l = system.link[first + k * system.stride];
      residual -= couple(system.coupling, l.s, here - xyz(u[l.other]));
      add_coupling(system.coupling, l.s, block);
    }
    block.add_diagonal(mass);
  }
};

// Rows in the order of cells, for solvers that need independent sets of rows: rows of two cells that do not
// touch are not linked.
struct RowCells {
  CellGrid grid;
  Span<const Index> cell_start;
};

struct SolveLimits {
  double residual = 0;  // stop when ||b - A u|| is at most this [kg m/s]
  int max_iterations = 200;
  double relaxation = 1.2;  // of SOR
  double start_residual =
      -1;  // ||b - A u|| of the first guess when the workspace holds that residual already
};

struct SolveResult {
  int iterations = 0;
  double residual = 0;         // ||b - A u|| at the end, evaluated from u
  double right_hand_side = 0;  // ||b||
  bool converged = false;
};

}  // namespace slagflow
