#include "host/geometry/slips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "host/case/toml_reader.hpp"

namespace slagflow {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string rounded(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Whether the fluid has wall below it and none above.
bool on_a_floor(const SimulationSetup& setup) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3d low{infinity, infinity, infinity}, high = -1.0 * low;
  for (const Vec3d& p : setup.particles.position)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  bool below = false;
  for (const Vec3d& p : setup.walls.position) {
    if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
    if (p.z > high.z) return false;
    below = below || p.z < low.z;
  }
  return below;
}

void warn_of_gravity(const Case& c, const SimulationSetup& setup, std::vector<std::string>& warnings) {
  constexpr double least = 0.1, most = 30;  // [m/s^2]
  const double g = norm(c.gravity);
  if (g > 0 && (g < least || g > most))
    warnings.push_back("gravity.acceleration is " + rounded(g) +
                       " m/s^2; on earth it is 9.81: is it meant in m/s^2?");
  const Direction way = down(c);
  if (c.gravity.z > 0 && way.axis == 2 && on_a_floor(setup))
    warnings.push_back("gravity.acceleration points up, " + rounded(c.gravity.z) +
                       " m/s^2 along +z, and the fluid lies on a floor without anything above: is [0, 0, " +
                       rounded(-c.gravity.z) + "] meant?");
}

double diagonal(const Case& c) {
  Vec3d size = c.domain.upper - c.domain.lower;
  if (c.dimensions == 2) size.y = 0;
  return norm(size);
}

void warn_of_angle(const WallSpec& wall, std::vector<std::string>& warnings) {
  double angle = 0;
  for (const double a : wall.motion.angle) angle = std::max(angle, std::abs(a));
  if (angle > 2 * pi * 1.01)
    warnings.push_back("wall '" + wall.name + "' turns by " + rounded(angle) + " rad, " +
                       rounded(angle / (2 * pi)) + " turns, by its table: is the angle meant in degrees? " +
                       rounded(angle) + " degrees are " + rounded(angle * pi / 180) + " rad");
}

void warn_of_times(const Case& c, const WallSpec& wall, std::vector<std::string>& warnings) {
  const double end = c.flow_end();
  const WallMotion& motion = wall.motion;
  const auto late = [&](const char* key, double time) {
    if (time < WallMotion::never && time > end)
      warnings.push_back("wall '" + wall.name + "': " + key + " = " + show(time) +
                         " s is after the end of the " + c.what_ends_it() + " at " + show(end) +
                         " s: it has no effect");
  };
  late("remove_at", motion.remove_at);
  if (motion.kind == MotionKind::rest) return;
  late("motion.start", motion.start);
  if (motion.start <= end) late("motion.stop", motion.stop);
}

void warn_of_displacement(const Case& c, const WallSpec& wall, std::vector<std::string>& warnings) {
  constexpr double far = 3;  // diagonals of the domain
  const WallMotion& motion = wall.motion;
  double shift = motion.kind == MotionKind::sine ? norm(motion.amplitude) : 0;
  for (const Vec3d& d : motion.displacement) shift = std::max(shift, norm(d));
  if (shift > far * diagonal(c))
    warnings.push_back("wall '" + wall.name + "' moves by up to " + rounded(shift) + " m, the domain is " +
                       rounded(diagonal(c)) + " m from corner to corner: is it meant in m?");
}

// With two dimensions all particles are at y = 0.
void warn_of_missed_plane(const MeasureSpec& measure, std::vector<std::string>& warnings) {
  const auto warn = [&](const std::string& what) {
    warnings.push_back("measure '" + measure.name + "' " + what +
                       ": with two dimensions all fluid is at y = 0, and it measures nothing");
  };
  switch (measure.type) {
    case MeasureType::front:
    case MeasureType::flow_rate:
      if (measure.direction.axis == 1) warn("goes along y");
      return;
    case MeasureType::jet:
      if (measure.outward.axis == 1) warn("goes along y");
      return;
    case MeasureType::volume:
    case MeasureType::mixing:
    case MeasureType::solid:
      if (measure.min.y > 0 || measure.max.y < 0)
        warn("has y from " + show(measure.min.y) + " to " + show(measure.max.y) + " m");
      return;
    case MeasureType::profile:
    case MeasureType::level:
    case MeasureType::surface:
      if (measure.start.y != 0 || measure.end.y != 0)
        warn("has a line with y = " + show(measure.start.y != 0 ? measure.start.y : measure.end.y) + " m");
      return;
    case MeasureType::force:
    case MeasureType::flux:  // at y = 0 wherever its center is
    case MeasureType::contact:
    case MeasureType::residence:
    case MeasureType::heat:
      return;
  }
}

}  // namespace

void warn_of_slips(const Case& c, const SimulationSetup& setup, std::vector<std::string>& warnings) {
  warn_of_gravity(c, setup, warnings);
  for (const WallSpec& wall : c.walls) {
    warn_of_angle(wall, warnings);
    warn_of_times(c, wall, warnings);
    warn_of_displacement(c, wall, warnings);
  }
  if (c.dimensions != 2) return;
  for (const MeasureSpec& measure : c.measures) warn_of_missed_plane(measure, warnings);
}

}  // namespace slagflow
