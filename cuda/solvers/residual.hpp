// What all solvers share: the residual and its norm.
#pragma once

#include <cmath>

#include "backend/buffer.hpp"
#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "linear_system.hpp"

namespace slagflow {

// r_i = b_i - (A u)_i, and its squared length.
struct Residual {
  LinearSystem system;
  Span<const Quad> u;
  Span<Quad> r;
  Span<double> squared;
  HOST_DEVICE void operator()(Index i) const {
    const Vec3 value = xyz(system.right_hand_side[i]) - system.apply(i, u);
    r[i] = quad(value, 0);
    squared[i] = dot(to_double(value), to_double(value));
  }
};

// ||b - A u||; leaves the residual in r.
inline double residual_norm(Context& context, const LinearSystem& system, Span<const Quad> u, Buffer<Quad>& r,
                            Buffer<double>& squared) {
  r.resize(system.size);
  squared.resize(system.size);
  launch(context, "residual", system.size, Residual{system, u, r.span(), squared.span()});
  return std::sqrt(sum(context, squared.span()));
}

// The same for the first guess, which may come with its residual.
inline double start_residual(Context& context, const LinearSystem& system, const SolveLimits& limits,
                             Span<const Quad> u, Buffer<Quad>& r, Buffer<double>& squared) {
  return limits.start_residual >= 0 ? limits.start_residual : residual_norm(context, system, u, r, squared);
}

}  // namespace slagflow
