#include "host/geometry/sound_speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "host/geometry/falls.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/squeeze.hpp"

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

// The point of a wall's surface that one of its particles lies below.
Vec3d surface_of(const WallParticles& walls, std::size_t i) {
  return walls.position[i] + walls.depth[i] * walls.normal[i];
}

std::vector<double> surface_speeds(const Case& c, const WallParticles& walls) {
  std::vector<double> speeds(c.walls.size(), 0);
  for (std::size_t i = 0; i < walls.position.size(); ++i) {
    double& speed = speeds[walls.body[i]];
    speed = std::max(speed, norm(c.walls[walls.body[i]].surface.at(surface_of(walls, i))));
  }
  return speeds;
}

// Direction of the axis that a wall turns about, of length 1; 0 without any.
Vec3d turning_axis(const WallMotion& motion) {
  Vec3d axis = motion.kind == MotionKind::table ? motion.axis : motion.angular_velocity;
  if (motion.kind == MotionKind::sine) axis = motion.angular_amplitude;
  return norm(axis) > 0 ? (1 / norm(axis)) * axis : Vec3d{};
}

std::string rounded(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", length);
  return text;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

SoundSpeedTerm impact_term(const ImpactSpeeds& impact) {
  const SoundSpeedTerm body{"impact", 10, impact.body, "of a body on a wall or fluid that it falls on"};
  const SoundSpeedTerm stream{"impact", 5, impact.stream, "on a wall or fluid that it falls on"};
  return body.sound_speed() > stream.sound_speed() ? body : stream;
}

// [m^2/s^2] of gravity, at the lowest place that fluid can come to: of a wall, or else of the domain.
double lowest_potential(const Case& c, const WallParticles& walls) {
  double domain = 0;
  for (int k = 0; k < 3; ++k)
    domain += std::min(-c.gravity[k] * c.domain.lower[k], -c.gravity[k] * c.domain.upper[k]);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < walls.position.size(); ++i)
    lowest = std::min(lowest, -dot(c.gravity, surface_of(walls, i)));
  return walls.position.empty() ? domain : std::max(domain, lowest);
}

// Of what inlets feed [m/s]: the fastest, and where it falls to the lowest wall: in a jet downwards, whose
// head strikes with a whole face, or off the lip of one to the side.
struct InletSpeeds {
  double fastest = 0, jet = 0, stream = 0;
};

InletSpeeds inlet_speeds(const Case& c, const Filling& filling) {
  constexpr double downwards = 0.7;  // cosine
  InletSpeeds speeds;
  const double lowest = lowest_potential(c, filling.walls);
  for (std::size_t k = 0; k < filling.inlets.size(); ++k) {
    const InletColumns& in = filling.inlets[k];
    const double fastest = feed_rate(c, c.inlets[k], in.area).fastest() * largest(in.share);
    speeds.fastest = std::max(speeds.fastest, fastest);
    double& striking = dot(in.normal, c.gravity) > downwards * norm(c.gravity) ? speeds.jet : speeds.stream;
    for (const Vec3d& p : in.origin) {
      const double fall = std::max(0.0, -dot(c.gravity, p) - lowest);
      striking = std::max(striking, std::sqrt(square(fastest) + 2 * fall));
    }
  }
  return speeds;
}

// Jets of slag down on a floor: 15 % of compression at five times their speed.
SoundSpeedTerm pour_term(const InletSpeeds& speeds) {
  const SoundSpeedTerm jet{"pour", 9, speeds.jet, "of a jet from an inlet that falls to the lowest wall"};
  const SoundSpeedTerm stream{"pour", 5, speeds.stream,
                              "of fluid from an inlet that falls to the lowest wall"};
  return jet.sound_speed() > stream.sound_speed() ? jet : stream;
}

double pressure_speed(const Case& c) {
  double speed = 0;
  for (const RegionSpec& region : c.regions)
    if (region.pressure == InitialPressure::uniform)
      speed = std::max(speed, std::sqrt(2 * region.uniform_pressure /
                                        c.fluids[static_cast<std::size_t>(region.fluid)].density));
  return speed;
}

double tension_speed(const Case& c) {
  double speed = 0;
  for (const FluidSpec& fluid : c.fluids)
    speed = std::max(speed, std::sqrt(fluid.surface_tension / (fluid.density * c.spacing)));
  return speed;
}

}  // namespace

std::vector<double> motion_speeds(const Case& c, const WallParticles& walls) {
  std::vector<double> reach(c.walls.size(), 0), speeds(c.walls.size(), 0);
  for (std::size_t i = 0; i < walls.position.size(); ++i) {
    const WallMotion& motion = c.walls[walls.body[i]].motion;
    double& r = reach[walls.body[i]];
    r = std::max(r, norm(cross(turning_axis(motion), surface_of(walls, i) - motion.center)));
  }
  for (std::size_t b = 0; b < speeds.size(); ++b) {
    const WallMotion::Speeds fastest = c.walls[b].motion.fastest();
    speeds[b] = fastest.linear + reach[b] * fastest.angular;
  }
  return speeds;
}

std::vector<SoundSpeedTerm> sound_speed_terms(const Case& c, const Filling& filling) {
  const FluidBodies& bodies = filling.bodies;
  const double depth = deepest(c, filling.fluid, bodies), g = norm(c.gravity);
  const Squeeze squeezed = squeeze(c, *filling.sites, filling.fluid.fluid);
  const InletSpeeds fed = inlet_speeds(c, filling);
  double start = 0;
  for (const Vec3d& v : filling.fluid.velocity) start = std::max(start, norm(v));
  return {{"depth", 11, std::sqrt(2 * depth), "sqrt(2 g H), H " + rounded(g > 0 ? depth / g : 0) + " m"},
          impact_term(impact_speeds(c, *filling.sites, filling.fluid, bodies)),
          {"walls", 10,
           std::max(largest(motion_speeds(c, filling.walls)), largest(surface_speeds(c, filling.walls))),
           "of the fastest wall"},
          {"start", 10, start, "of the fastest fluid at the start"},
          {"inlet", 10, fed.fastest, "of the fastest fluid from an inlet"},
          pour_term(fed),
          {"squeeze", 10, squeezed.speed, "of fluid pressed out before a moving wall"},
          {"film", 11, squeezed.film, "sqrt(2 p / rho) of what viscosity takes to press it out"},
          {"pressure", 11, pressure_speed(c), "sqrt(2 p / rho) of a region's pressure"},
          {"tension", 10, tension_speed(c), "sqrt(sigma / (rho spacing))"}};
}

const SoundSpeedTerm& ruling(const std::vector<SoundSpeedTerm>& terms) {
  return *std::max_element(terms.begin(), terms.end(), [](const SoundSpeedTerm& a, const SoundSpeedTerm& b) {
    return a.sound_speed() < b.sound_speed();
  });
}

}  // namespace slagflow
