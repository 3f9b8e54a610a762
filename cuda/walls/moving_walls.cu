#include <algorithm>

#include "backend/launch.hpp"
#include "fluid/constants.hpp"
#include "walls/moving_walls.hpp"

namespace slagflow {

namespace {

HOST_DEVICE Quad turned(const Rotation& r, Quad q) { return quad(to_real(r * to_double(xyz(q))), q.w); }

struct PlaceWall {
  double inverse_dt;
  Real last_dt;
  Span<const WallPose> poses;
  Span<const std::uint8_t> body;
  Span<const Vec3d> start;
  Span<const Quad> start_normal, start_back, start_velocity;
  Span<const Index> id;
  Span<Quad> place, normal, back, velocity, acceleration, moved;

  HOST_DEVICE void operator()(Index i) const {
    const Index k = id[i];
    const WallPose& pose = poses[body[k]];
    // A surface that moves while its shape stays takes the fluid along as if its material had come with it.
    if (!pose.moves) {
      moved[i] = quad(last_dt * xyz(velocity[i]), 0);
      return;
    }
    const Vec3d arm = start[k] - pose.center, x = pose.target + pose.turn * arm;
    const Quad n = start_normal[k], along = turned(pose.turn, start_velocity[k]);
    const Vec3d v = inverse_dt * (pose.shift_gain + pose.turn_gain * arm);
    place[i] = quad(to_real(x), pose.removed ? Real(1) : Real(0));
    moved[i] = quad(to_real(pose.shift_gained + pose.turn_gained * arm) + last_dt * xyz(along), 0);
    normal[i] = turned(pose.turn, n);
    back[i] = turned(pose.turn, start_back[k]);
    velocity[i] = quad(to_real(v) + xyz(along), along.w);
    const Vec3d r = x - pose.target, w = pose.angular_velocity;
    const Vec3d a = pose.acceleration + cross(pose.angular_acceleration, r) + cross(w, cross(w, r));
    acceleration[i] = quad(to_real(a), 0);
  }
};

// What WallArrays::velocity holds of a surface that moves while the wall keeps its shape: the velocity of the
// material where the wall particle is, and only what lies along the surface, so that the wall does not move
// the fluid out of its way. (That of the point of the surface above would turn a ring of fluid on a roll of
// radius R faster than the roll, by a spacing/2R: in a rigid motion x_iw.u_iw is nought between the places.)
Quad surface_velocity(const WallBody& body, Vec3d position, Vec3d normal) {
  Vec3d v = body.surface.at(position);
  v -= dot(v, normal) * normal;
  const double slip = body.slip == WallSlip::free_slip ? -1 : body.slip_length;
  return quad(to_real(v), static_cast<Real>(slip));
}

// Of each wall particle [Pa]; empty where all have the same.
std::vector<Real> tension_limits(const SimulationSetup& setup) {
  if (common_wall_tension_limit(setup) >= 0) return {};
  std::vector<Real> result;
  for (const std::uint8_t body : setup.walls.body)
    result.push_back(static_cast<Real>(wall_tension_limit(setup.bodies[body], setup.numerics)));
  return result;
}

}  // namespace

MovingWalls::MovingWalls(Context& c)
    : context_(c),
      position_(c, "walls at the start"),
      normal_(c, "wall normals at the start"),
      back_(c, "wall back faces at the start"),
      velocity_(c, "wall velocities at the start"),
      body_(c, "walls of wall particles"),
      pose_(c, "wall poses") {}

void MovingWalls::upload(const SimulationSetup& setup, WallArrays& wall) {
  const WallParticles& w = setup.walls;
  const std::size_t n = w.position.size();
  origin_ = setup.domain.lower;
  motion_.clear();
  for (const WallBody& body : setup.bodies) motion_.push_back(body.motion);
  any_ = std::any_of(motion_.begin(), motion_.end(), [](const WallMotion& m) { return m.moves(); }) ||
         !setup.inlets.empty();
  radius_.assign(setup.bodies.size(), 0);
  std::vector<Vec3d> position(n);
  std::vector<Quad> place(n), normal(n), back(n), velocity(n);
  std::vector<Index> id(n);
  for (std::size_t i = 0; i < n; ++i) {
    const WallBody& body = setup.bodies[w.body[i]];
    position[i] = w.position[i] - origin_;
    place[i] = quad(to_real(position[i]), 0);
    normal[i] = quad(to_real(w.normal[i]), static_cast<Real>(w.depth[i]));
    if (!w.back_depth.empty()) back[i] = quad(to_real(w.back_normal[i]), static_cast<Real>(w.back_depth[i]));
    velocity[i] = surface_velocity(body, w.position[i], w.normal[i]);
    id[i] = static_cast<Index>(i);
    surface_speed_ = larger(surface_speed_, static_cast<double>(norm(xyz(velocity[i]))));
    radius_[w.body[i]] = larger(radius_[w.body[i]], norm(w.position[i] - body.motion.center));
  }
  wall.resize(static_cast<Index>(n));
  wall.place.upload(place), wall.normal.upload(normal), wall.back.upload(back);
  wall.velocity.upload(velocity), wall.id.upload(id);
  wall.pressure.upload(std::vector<Real>(n));
  wall.tension_limit.upload(tension_limits(setup));
  body_.upload(w.body);
  if (!any_) return;
  wall.acceleration.use(), wall.moved.use();  // by all ranks, those without walls too
  wall.acceleration.upload(std::vector<Quad>(n)), wall.moved.upload(std::vector<Quad>(n));
  position_.upload(position), normal_.upload(normal), back_.upload(back), velocity_.upload(velocity);
}

bool MovingWalls::vanishes(double after, double until) const {
  return std::any_of(motion_.begin(), motion_.end(),
                     [&](const WallMotion& m) { return m.remove_at > after && m.remove_at <= until; });
}

std::vector<WallPose> MovingWalls::poses(const WallStep& step) const {
  std::vector<WallPose> result(motion_.size());
  for (std::size_t b = 0; b < motion_.size(); ++b) {
    if (!motion_[b].moves()) continue;
    const double time = step.now, dt = step.dt;
    const BodyPose before = motion_[b].pose(time - step.last_dt), now = motion_[b].pose(time),
                   then = motion_[b].pose(time + dt), gain = motion_[b].acceleration(time + dt / 2);
    WallPose& pose = result[b];
    pose.moves = true;
    pose.removed = removed(b, time);
    pose.turn = rotation(now.turn);
    pose.turn_gain = rotation(then.turn) - pose.turn, pose.turn_gained = pose.turn - rotation(before.turn);
    pose.center = motion_[b].center - origin_;
    pose.target = pose.center + now.shift;
    pose.shift_gain = then.shift - now.shift, pose.shift_gained = now.shift - before.shift;
    pose.velocity = pose.shift_gain * (1 / dt);
    pose.angular_velocity = (then.turn - now.turn) * (1 / dt);
    pose.acceleration = gain.shift, pose.angular_acceleration = gain.turn;
  }
  return result;
}

void MovingWalls::place(const WallStep& step, WallArrays& wall) {
  if (!any_) return;
  const std::vector<WallPose> now = poses(step);
  speed_ = 0;
  for (std::size_t b = 0; b < now.size(); ++b)
    if (now[b].moves && !now[b].removed)
      speed_ = larger(speed_, norm(now[b].velocity) + radius_[b] * norm(now[b].angular_velocity));
  pose_.upload(now);
  launch(context_, "place walls", wall.local(),
         PlaceWall{1 / step.dt, static_cast<Real>(step.last_dt), pose_.span(), body_.span(), position_.span(),
                   normal_.span(), back_.span(), velocity_.span(), wall.id.span(), wall.place.span(),
                   wall.normal.span(), wall.back.span(), wall.velocity.span(), wall.acceleration.span(),
                   wall.moved.span()});
}

Vec3d MovingWalls::position_at(Vec3d position, std::size_t body, double time) const {
  const WallMotion& m = motion_[body];
  if (!m.moves()) return position;
  const BodyPose pose = m.pose(time);
  return m.center + pose.shift + rotation(pose.turn) * (position - m.center);
}

bool MovingWalls::removed(std::size_t body, double time) const { return time >= motion_[body].remove_at; }

double MovingWalls::largest_displacement(double from, double to) const {
  double largest = 0;
  for (std::size_t b = 0; b < motion_.size(); ++b) {
    if (!motion_[b].moves() || removed(b, from)) continue;
    const BodyPose a = motion_[b].pose(from), c = motion_[b].pose(to);
    largest = larger(largest, norm(c.shift - a.shift) + radius_[b] * norm(c.turn - a.turn));
  }
  return largest;
}

}  // namespace slagflow
