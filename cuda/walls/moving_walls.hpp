// Places the particles of walls that move, and tells them their velocity.
#pragma once

#include "fluid/particles.hpp"
#include "fluid/setup.hpp"

namespace slagflow {

// A wall's pose and its motion during a step and the one before, as the device uses it. Places are relative
// to the domain's lower corner.
struct WallPose {
  bool moves = false, removed = false;
  Rotation turn, turn_gain, turn_gained;     // now, and what this step adds and the last one added
  Vec3d center, target;                      // [m] center of rotation, at the start and now
  Vec3d shift_gain, shift_gained;            // [m] in this step and in the last
  Vec3d velocity, angular_velocity;          // [m/s], [rad/s]
  Vec3d acceleration, angular_acceleration;  // [m/s^2], [rad/s^2]
};

// A step from `now` on, and the time that the step before took [s].
struct WallStep {
  double now, dt, last_dt;
};

class MovingWalls {
 public:
  explicit MovingWalls(Context&);

  // Puts the walls of a setup where they are at the start, in the order of ids.
  void upload(const SimulationSetup&, WallArrays&);

  // Whether any wall ever moves or vanishes, those of inlets included.
  bool any() const { return any_; }
  // Whether a wall vanishes between two times, the first excluded.
  bool vanishes(double after, double until) const;

  // Puts the walls where they are now, with the velocity that takes them along a straight line to where they
  // are at the end of the step, the displacement of the last step, and the acceleration of the middle of this
  // one. Particles of walls that have vanished are marked in place.w; the next sort drops them.
  void place(const WallStep&, WallArrays&);

  // Where a particle that starts at `position` [m] is at `time`; the body's index.
  Vec3d position_at(Vec3d position, std::size_t body, double time) const;
  bool removed(std::size_t body, double time) const;

  // Bounds, over all wall particles: of the distance moved from one time to another [m], and of the speed of
  // surfaces [m/s] as of the last place().
  double largest_displacement(double from, double to) const;
  double largest_speed() const { return larger(surface_speed_, speed_); }

 private:
  std::vector<WallPose> poses(const WallStep&) const;

  Context& context_;
  std::vector<WallMotion> motion_;  // of each body
  std::vector<double> radius_;      // [m] of each body, largest distance of a particle from the center
  Vec3d origin_;                    // [m] lower corner of the domain
  bool any_ = false;
  double surface_speed_ = 0, speed_ = 0;
  // In the order of ids, at the start:
  Buffer<Vec3d> position_;
  Buffer<Quad> normal_, back_, velocity_;
  Buffer<std::uint8_t> body_;
  Buffer<WallPose> pose_;
};

}  // namespace slagflow
