// Where a solve stands. It is kept on the device, so that iterations follow each other without the host: the
// reductions put their results here, and launches do nothing once the iterations have ended.
#pragma once

#include <cmath>
#include <cstdint>

#include "backend/platform.hpp"

namespace slagflow {

struct SolveState {
  double limit = 0;            // of ||b - A u|| [kg m/s]
  double right_hand_side = 0;  // ||b||
  double residual = 0;         // ||b - A u||
  double rz = 0;               // r.z, z the preconditioned residual
  // Of an exact yield stress: the residual of its first iteration, and with which it has converged; the rms
  // speed |u*| [m/s].
  double first_residual = 0, enough = 0, speed = 0;
  Real alpha = 0, beta = 0;  // beta = 0: a new start, the old direction is not read
  std::int32_t iterations = 0, most_iterations = 0;
  std::int32_t starts = 0, started_at = 0;  // how often, and at which iteration the last time
  std::int32_t running = 0;                 // whether iterations go on
  std::int32_t wants_levels = 0;            // whether coarse levels are to be set up
  std::int32_t level_starts = 0;            // how often iterations with them began
  std::int32_t converged = 0;               // whether the solution is good enough to go on with

  // ||r|| of the first guess.
  HOST_DEVICE void begin(double norm, int most) {
    residual = norm;
    iterations = starts = started_at = 0;
    wants_levels = level_starts = 0;
    most_iterations = most;
    alpha = beta = 0;
    converged = residual <= limit ? 1 : 0;
    running = residual > limit && most > 0 ? 1 : 0;
  }
  HOST_DEVICE void direction_curves(double curvature) {
    alpha = static_cast<Real>(rz / curvature);
    if (!(curvature > 0)) running = 0;  // breakdown: not a number, or nothing left to gain
  }
};

// A body that is idle unless the iterations of a solve go on; without a state it never is.
template <class Body>
struct WhileRunning : Body {
  const SolveState* state;
  HOST_DEVICE bool idle() const { return state && !state->running; }
};
template <class Body>
WhileRunning<Body> while_running(const SolveState* state, const Body& body) {
  return {body, state};
}

// A body that is idle unless the solve has converged; without a state it never is.
template <class Body>
struct IfConverged : Body {
  const SolveState* state;
  HOST_DEVICE bool idle() const { return state && !state->converged; }
};
template <class Body>
IfConverged<Body> if_converged(const SolveState* state, const Body& body) {
  return {body, state};
}

}  // namespace slagflow
