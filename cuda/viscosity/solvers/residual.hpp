// What all solvers share: the residual and its norm.
#pragma once

#include <cmath>
#include <limits>

#include "backend/reduce.hpp"
#include "viscosity/linear_system.hpp"
#include "viscosity/solvers/solver.hpp"

namespace slagflow {

// z = D^-1 r, D the point diagonal.
HOST_DEVICE inline Vec3 over_diagonal(Vec3 r, Quad diagonal) {
  return {r.x / diagonal.x, r.y / diagonal.y, r.z / diagonal.z};
}

// |D_i u_i|^2, D the point diagonal.
HOST_DEVICE inline double scaled_squared(Quad diagonal, Quad u) {
  const Vec3d d = to_double(xyz(diagonal)), value = to_double(xyz(u));
  const Vec3d scaled{d.x * value.x, d.y * value.y, d.z * value.z};
  return dot(scaled, scaled);
}

// Rounding keeps the residual above about epsilon ||D u||, whose square is `scaled`, and a millionth of its
// start.
HOST_DEVICE inline double rounding_residual(double scaled, double start) {
  constexpr auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
  return larger(epsilon * std::sqrt(scaled), 8 * epsilon * start);
}

// r_i = b_i - (A u)_i, its squared length and r.z.
struct Residual {
  static constexpr int terms = 2;
  LinearSystem system;
  Span<const Quad> u;
  Span<Quad> r;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const Vec3 value = xyz(system.right_hand_side[i]) - system.apply(i, u);
    r[i] = quad(value, 0);
    return {{dot(to_double(value), to_double(value)),
             dot(to_double(value), to_double(over_diagonal(value, system.diagonal[i])))}};
  }
};

struct KeepResidual {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<2>& sums) const { state->residual = std::sqrt(sums.value[0]); }
};

// A p and p.A p
struct Multiply {
  static constexpr int terms = 1;
  LinearSystem system;
  Span<const Quad> p;
  Span<Quad> product;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    const Vec3 value = system.apply(i, p);
    product[i] = quad(value, 0);
    return {{dot(to_double(xyz(p[i])), to_double(value))}};
  }
};

struct JudgeDirection {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<1>& curvature) const {
    state->direction_curves(curvature.value[0]);
  }
};

}  // namespace slagflow
