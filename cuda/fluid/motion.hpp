// How a wall moves as a rigid body: its pose as a function of time alone, so that nothing accumulates.
#pragma once

#include <vector>

#include "fluid/math.hpp"

namespace slagflow {

// constant, ramp: s = clock, or with the velocity growing evenly over ramp_time; sine: s = sin(2 pi f clock +
// phase) - sin(phase), the clock running from `start` to `stop`:
//   shift = velocity s (sine: amplitude s),  turn = angular_velocity s (sine: angular_amplitude s).
// table: shift, and the angle about `axis`, interpolated between rows, the clock of the first row before it
// and of the last row after it.
enum class MotionKind { rest, constant, ramp, table, sine };

// smooth: cubic between rows, with a continuous velocity that is zero at the ends, and without overshoot
// (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300).
enum class Interpolation { linear, smooth };

// A point x of the body at the start is at center + shift + R (x - center), R the rotation by |turn| about
// turn.
struct BodyPose {
  Vec3d shift;  // [m]
  Vec3d turn;   // [rad]
};

struct WallMotion {
  static constexpr double never = 1e30;

  MotionKind kind = MotionKind::rest;
  double start = 0, stop = never;          // [s]
  Vec3d center{};                          // [m] of rotation, at the start
  Vec3d velocity{}, angular_velocity{};    // [m/s], [rad/s]
  double ramp_time = 0;                    // [s]
  Vec3d amplitude{}, angular_amplitude{};  // [m], [rad]
  double frequency = 0, phase = 0;         // [Hz], [rad]
  std::vector<double> time{};              // [s] ascending
  std::vector<Vec3d> displacement{};       // [m] one a time, the first zero
  std::vector<double> angle{};             // [rad] one a time, the first zero
  Vec3d axis{};                            // of the angle, any length but zero
  Interpolation interpolation = Interpolation::linear;
  double remove_at = never;  // [s] the body vanishes

  // Whether the body is ever anywhere else than at the start.
  bool moves() const { return kind != MotionKind::rest || remove_at < never; }
  BodyPose pose(double now) const;

  // d2 shift/dt2 [m/s^2] and d2 turn/dt2 [rad/s^2]; jumps of the velocity, at `start`, `stop` and the rows of
  // a linear table, are left out.
  BodyPose acceleration(double now) const;

  // Bounds of |d shift/dt| [m/s] and |d turn/dt| [rad/s].
  struct Speeds {
    double linear = 0, angular = 0;
  };
  Speeds fastest() const;
};

// Rotation by |turn| about turn, as three rows.
struct Rotation {
  Vec3d row[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  HOST_DEVICE Vec3d operator*(Vec3d v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  // Not a rotation, but what one does less what another does.
  Rotation operator-(const Rotation& b) const {
    return {{row[0] - b.row[0], row[1] - b.row[1], row[2] - b.row[2]}};
  }
};
Rotation rotation(Vec3d turn);

}  // namespace slagflow
