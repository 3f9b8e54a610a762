#include "host/geometry/wall_depth.hpp"

#include <algorithm>
#include <cmath>

namespace slagflow {
namespace {

constexpr double reach = 6;      // [spacings]
constexpr double nudge = 1e-3;   // [spacings] from a face into the open
constexpr double stride = 0.05;  // [spacings] of the search where no face tells

}  // namespace

WallDepth::WallDepth(const Case& c)
    : solids_(c), domain_(c.domain), spacing_(c.spacing), flat_(c.dimensions == 2) {
  for (const WallSpec& wall : c.walls) motion_.push_back(wall.motion);
  pose_.resize(motion_.size());
  move_to(0);
}

void WallDepth::move_to(double time) {
  for (std::size_t b = 0; b < motion_.size(); ++b) {
    const WallMotion& m = motion_[b];
    if (!m.moves()) continue;
    const BodyPose pose = m.pose(time);
    pose_[b] = {time < m.remove_at, rotation(pose.turn), rotation(-1 * pose.turn), m.center,
                m.center + pose.shift};
  }
}

// Where a point of a wall was at the start; one that has gone round a periodic axis started in the domain.
Vec3d WallDepth::at_start(Vec3d p, std::size_t wall) const {
  if (!motion_[wall].moves()) return p;
  const Pose& pose = pose_[wall];
  return wrapped(pose.center + pose.back * (p - pose.target));
}

Vec3d WallDepth::wrapped(Vec3d p) const {
  for (int k = 0; k < 3; ++k) {
    const double lower = domain_.lower[k], extent = domain_.upper[k] - lower;
    if (domain_.periodic[static_cast<std::size_t>(k)]) p[k] -= extent * std::floor((p[k] - lower) / extent);
  }
  return p;
}

bool WallDepth::in_wall(Vec3d p) const {
  for (std::size_t b = 0; b < pose_.size(); ++b)
    if (pose_[b].there && solids_[b].distance(at_start(p, b)) < 0) return true;
  return false;
}

// A point just outside of a face. What lies beyond the domain does not count, and a wall cut off by a
// periodic face goes on behind it.
bool WallDepth::borders_open(Vec3d p) const {
  p = wrapped(p);
  for (int k = 0; k < 3; ++k)
    if (!domain_.periodic[static_cast<std::size_t>(k)])
      p[k] = std::clamp(p[k], domain_.lower[k] + nudge * spacing_, domain_.upper[k] - nudge * spacing_);
  if (flat_) p.y = 0;
  return !in_wall(p);
}

// Of all walls that p is in, as they stand now.
std::vector<Foot> WallDepth::feet(Vec3d p) const {
  std::vector<Foot> all, own;
  for (std::size_t b = 0; b < pose_.size(); ++b) {
    const Vec3d start = at_start(p, b);
    if (!pose_[b].there || solids_[b].distance(start) >= 0) continue;
    own.clear();
    solids_[b].feet(start, reach * spacing_, own);
    const Rotation& turn = pose_[b].turn;
    for (const Foot& foot : own) all.push_back({p + turn * (foot.point - start), turn * foot.normal});
  }
  return all;
}

// Behind a concave corner the nearest point of the open is at its edge, which is on several faces: goes from
// face to face.
double WallDepth::over_faces(Vec3d p) const {
  constexpr int most_faces = 6;
  Vec3d q = p;
  for (int k = 0; k < most_faces; ++k) {
    double least = reach * spacing_;
    Vec3d next = q;
    for (const Foot& foot : feet(q)) {
      const double depth = dot(foot.point - q, foot.normal);
      if ((flat_ && std::abs(foot.normal.y) > 0.5) || depth < 0 || depth >= least) continue;
      least = depth;
      next = foot.point + (nudge * spacing_) * foot.normal;
    }
    if (borders_open(next)) return norm(next - p);
    q = next;
  }
  return reach * spacing_;
}

// Where faces lead nowhere, along the axes and the diagonals.
double WallDepth::to_the_open(Vec3d p) const {
  double nearest = std::min(reach * spacing_, over_faces(p));
  for (int x = -1; x <= 1; ++x)
    for (int y = flat_ ? 0 : -1; y <= (flat_ ? 0 : 1); ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vec3d way{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        if (norm(way) == 0) continue;
        for (double t = stride * spacing_; t < nearest; t += stride * spacing_)
          if (borders_open(p + (t / norm(way)) * way)) nearest = t;
      }
  return nearest;
}

double WallDepth::of(Vec3d p) const {
  if (flat_) p.y = 0;
  if (!in_wall(p)) return 0;
  double nearest = reach * spacing_;
  bool found = false;
  for (const Foot& foot : feet(p)) {
    const double depth = dot(foot.point - p, foot.normal);
    if ((flat_ && std::abs(foot.normal.y) > 0.5) || depth < 0 || depth >= nearest ||
        !borders_open(foot.point + (nudge * spacing_) * foot.normal))
      continue;
    nearest = depth;
    found = true;
  }
  // The open behind the nearest corner may be nearer than that behind any face.
  return found ? std::min(nearest, over_faces(p)) : to_the_open(p);
}

}  // namespace slagflow
