#include "host/sound_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/falls.hpp"
#include "host/squeeze.hpp"
#include "host/toml_reader.hpp"

namespace slagflow {
namespace {

// Extent of the deepest body of fluid in potential, half a spacing at either end included [m^2/s^2].
double deepest(const Case& c, const FluidParticles& fluid, const FluidBodies& bodies) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::size_t>(bodies.count);
  std::vector<double> low(count, infinity), high(count, -infinity);
  for (std::size_t i = 0; i < fluid.position.size(); ++i) {
    const double potential = -dot(c.gravity, fluid.position[i]);
    const auto b = static_cast<std::size_t>(bodies.of[i]);
    low[b] = std::min(low[b], potential), high[b] = std::max(high[b], potential);
  }
  double depth = 0;
  for (std::size_t b = 0; b < count; ++b)
    depth = std::max(depth, high[b] - low[b] + norm(c.gravity) * c.spacing);
  return depth;
}

std::vector<double> surface_speeds(const Case& c, const WallParticles& walls) {
  std::vector<double> speeds(c.walls.size(), 0);
  for (std::size_t i = 0; i < walls.position.size(); ++i) {
    double& speed = speeds[walls.body[i]];
    speed = std::max(speed, norm(c.walls[walls.body[i]].surface.at(walls.position[i])));
  }
  return speeds;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

std::vector<double> motion_speeds(const Case& c, const WallParticles& walls) {
  std::vector<double> reach(c.walls.size(), 0), speeds(c.walls.size(), 0);
  for (std::size_t i = 0; i < walls.position.size(); ++i) {
    double& r = reach[walls.body[i]];
    r = std::max(r, norm(walls.position[i] - c.walls[walls.body[i]].motion.center));
  }
  for (std::size_t b = 0; b < speeds.size(); ++b) {
    const WallMotion::Speeds fastest = c.walls[b].motion.fastest();
    speeds[b] = fastest.linear + reach[b] * fastest.angular;
  }
  return speeds;
}

std::vector<SoundSpeedTerm> sound_speed_terms(const Case& c, const Filling& filling) {
  const FluidBodies bodies = fluid_bodies(c, *filling.sites);
  const double depth = deepest(c, filling.fluid, bodies), g = norm(c.gravity);
  double start = 0;
  for (const Vec3d& v : filling.fluid.velocity) start = std::max(start, norm(v));
  return {{"depth", 11, std::sqrt(2 * depth),
           "sqrt(2 g H), H " + (g > 0 ? show(std::round(1e6 * depth / g) / 1e6) : "0") + " m"},
          {"impact", 5, impact_speed(c, *filling.sites, filling.fluid, bodies, depth),
           "on a wall or fluid that it falls on"},
          {"walls", 10,
           std::max(largest(motion_speeds(c, filling.walls)), largest(surface_speeds(c, filling.walls))),
           "of the fastest wall"},
          {"start", 10, start, "of the fastest fluid at the start"},
          {"squeeze", 10, squeeze_speed(c, *filling.sites), "of fluid pressed out before a moving wall"}};
}

const SoundSpeedTerm& ruling(const std::vector<SoundSpeedTerm>& terms) {
  return *std::max_element(terms.begin(), terms.end(), [](const SoundSpeedTerm& a, const SoundSpeedTerm& b) {
    return a.sound_speed() < b.sound_speed();
  });
}

}  // namespace slagflow
