#include <algorithm>

#include "fluid/motion.hpp"

namespace slagflow {

namespace {

constexpr double two_pi = 6.283185307179586;

// Slope at row k of a monotone cubic.
double slope(const std::vector<double>& t, const std::vector<double>& y, std::size_t k) {
  if (k == 0 || k + 1 == t.size()) return 0;
  const double h0 = t[k] - t[k - 1], h1 = t[k + 1] - t[k];
  const double d0 = (y[k] - y[k - 1]) / h0, d1 = (y[k + 1] - y[k]) / h1;
  if (d0 * d1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

double interpolate(const std::vector<double>& t, const std::vector<double>& y, Interpolation how,
                   double now) {
  if (now <= t.front()) return y.front();
  if (now >= t.back()) return y.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), now) - t.begin()) - 1;
  const double h = t[k + 1] - t[k], s = (now - t[k]) / h;
  if (how == Interpolation::linear) return y[k] + s * (y[k + 1] - y[k]);
  const double rest = 1 - s;
  return y[k] * (1 + 2 * s) * rest * rest + y[k + 1] * s * s * (3 - 2 * s) +
         h * s * rest * (slope(t, y, k) * rest - slope(t, y, k + 1) * s);
}

// d2y/dt2 of a smooth table; outside its rows and of a linear one zero.
double curvature(const std::vector<double>& t, const std::vector<double>& y, Interpolation how, double now) {
  if (how == Interpolation::linear || now <= t.front() || now >= t.back()) return 0;
  const auto k = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), now) - t.begin()) - 1;
  const double h = t[k + 1] - t[k], s = (now - t[k]) / h;
  return (6 * (1 - 2 * s) * (y[k + 1] - y[k]) / h + (6 * s - 4) * slope(t, y, k) +
          (6 * s - 2) * slope(t, y, k + 1)) /
         h;
}

std::vector<double> component(const std::vector<Vec3d>& vectors, int axis) {
  std::vector<double> result;
  for (const Vec3d& v : vectors) result.push_back(v[axis]);
  return result;
}

Vec3d unit(Vec3d v) { return norm(v) > 0 ? v * (1 / norm(v)) : Vec3d{}; }

}  // namespace

BodyPose WallMotion::pose(double now) const {
  const double clock = smaller(larger(now, start), stop) - start;
  switch (kind) {
    case MotionKind::constant:
      return {velocity * clock, angular_velocity * clock};
    case MotionKind::ramp: {
      const double s = clock < ramp_time ? clock * clock / (2 * ramp_time) : clock - 0.5 * ramp_time;
      return {velocity * s, angular_velocity * s};
    }
    case MotionKind::sine: {
      const double s = std::sin(two_pi * frequency * clock + phase) - std::sin(phase);
      return {amplitude * s, angular_amplitude * s};
    }
    case MotionKind::table: {
      BodyPose result;
      for (int k = 0; k < 3; ++k)
        result.shift[k] = interpolate(time, component(displacement, k), interpolation, clock);
      if (!angle.empty()) result.turn = interpolate(time, angle, interpolation, clock) * unit(axis);
      return result;
    }
    case MotionKind::rest:
      break;
  }
  return {};
}

BodyPose WallMotion::acceleration(double now) const {
  BodyPose result;
  if (now <= start || now >= stop) return result;
  const double clock = now - start;
  switch (kind) {
    case MotionKind::ramp:
      if (clock < ramp_time) result = {velocity * (1 / ramp_time), angular_velocity * (1 / ramp_time)};
      break;
    case MotionKind::sine: {
      const double s = -square(two_pi * frequency) * std::sin(two_pi * frequency * clock + phase);
      result = {amplitude * s, angular_amplitude * s};
      break;
    }
    case MotionKind::table:
      for (int k = 0; k < 3; ++k)
        result.shift[k] = curvature(time, component(displacement, k), interpolation, clock);
      if (!angle.empty()) result.turn = curvature(time, angle, interpolation, clock) * unit(axis);
      break;
    case MotionKind::constant:
    case MotionKind::rest:
      break;
  }
  return result;
}

WallMotion::Speeds WallMotion::fastest() const {
  if (kind == MotionKind::sine)
    return {two_pi * frequency * norm(amplitude), two_pi * frequency * norm(angular_amplitude)};
  if (kind != MotionKind::table) return {norm(velocity), norm(angular_velocity)};
  Speeds result;
  const double peak = interpolation == Interpolation::smooth ? 1.5 : 1;  // of a cubic over its mean
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double factor = peak / (time[k] - time[k - 1]);
    result.linear = larger(result.linear, factor * norm(displacement[k] - displacement[k - 1]));
    if (!angle.empty()) result.angular = larger(result.angular, factor * std::fabs(angle[k] - angle[k - 1]));
  }
  return result;
}

// O. Rodrigues: R v = v cos a + (k x v) sin a + k (k.v) (1 - cos a)
Rotation rotation(Vec3d turn) {
  const double a = norm(turn);
  Rotation r;
  if (a == 0) return r;
  const Vec3d k = unit(turn);
  const double c = std::cos(a), s = std::sin(a);
  for (int i = 0; i < 3; ++i) {
    Vec3d e;
    e[i] = 1;
    r.row[i] = c * e - s * cross(k, e) + (1 - c) * k[i] * k;
  }
  return r;
}

}  // namespace slagflow
