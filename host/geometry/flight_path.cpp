#include "host/geometry/flight_path.hpp"

#include <algorithm>
#include <cmath>

namespace slagflow {

void FlightPath::begin(Vec3d start, Vec3d velocity) {
  start_ = start, velocity_ = v_ = velocity;
  t_ = way_ = 0, ended_ = false;
  points_.clear();
}

bool FlightPath::serves(Vec3d start, Vec3d velocity, int axis) const {
  for (int k = 0; k < 3; ++k)
    if (velocity[k] != velocity_[k] || (k != axis && start[k] != start_[k])) return false;
  return !points_.empty() && velocity[axis] == 0 && a_[axis] == 0;
}

void FlightPath::grow() {
  constexpr int at_once = 32;
  const double dx = sites_.lattice().spacing();
  const auto [nx, ny, nz] = sites_.lattice().count();
  const double longest = 4 * dx * static_cast<double>(nx + ny + nz);  // round periodic axes
  const Vec3d start = start_, velocity = velocity_, a = a_;
  Vec3d v = v_;
  double t = t_, way = way_;
  ended_ = true;
  for (int k = 0; k < at_once && way < longest; ++k) {
    const double step = 0.25 * dx / std::max(norm(v), std::sqrt(norm(a) * dx));
    t += step, way += step * norm(v);
    const Vec3d x = start + t * velocity + (0.5 * t * t) * a;
    v = velocity + t * a;
    const auto here = sites_.at(x), ahead = sites_.at(x + (0.5 * dx / norm(v)) * v);
    if (!here || !ahead) return;
    const bool leaves = !sites_.in_domain(*ahead);
    points_.push_back({*here, *ahead, norm(x - start), norm(v), leaves});
    if (leaves) return;
  }
  v_ = v, t_ = t, way_ = way;
  ended_ = !(way < longest);
}

}  // namespace slagflow
