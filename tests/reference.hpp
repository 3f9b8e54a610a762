// An independent slow oracle of the particle sums: loops over all pairs and all periodic images, double
// precision. It shares no code with cuda/ on purpose: only the formulas are common. Units as in setup.hpp, SI
// throughout.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference_kernels.hpp"

namespace reference {

struct Vec {
  double x = 0, y = 0, z = 0;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec a) { return std::hypot(a.x, a.y, a.z); }

struct Fluid {
  double rest_density = 0;
  double plastic_viscosity = 0, yield_stress = 0, growth_exponent = 1000;  // yield stress 0: Newtonian
};

// Equation (4) in long double, by its power series where the difference would cancel.
inline long double viscosity(const Fluid& f, long double shear_rate) {
  const long double x = f.growth_exponent * shear_rate;
  const long double ratio = x < 1e-4L ? 1 - x / 2 + x * x / 6 - x * x * x / 24 : (1 - std::exp(-x)) / x;
  return f.plastic_viscosity + f.yield_stress * f.growth_exponent * ratio;
}

struct Particle {
  Vec x, v;
  Vec by_pressure;    // force per volume in the last step
  double excess = 0;  // density - rest density
  double volume = 0, mass = 0, pressure = 0, viscosity = 0;
  double packing = 1;      // density at the start over that at rest
  double contact = -1e30;  // the least pressure towards walls
  double hollow = 0;       // void that must close before the density rises [kg/m^3]
  int fluid = 0;
  double key = 0;  // with heat: K(T) of its rheology; 0: none
  bool solid = false;
};

struct Wall {
  Vec x, v, normal;
  double depth = 0, pressure = 0;
  Vec back_normal;
  double back_depth = 0;  // below the opposite face of a thin plate; 0: there is none
  bool sticks = true;
  double slip_length = 0;     // Navier's, of a wall that sticks in part
  Vec acceleration, moved;    // moved: in the last step
  double tension_limit = -1;  // < 0: the world's
};

struct World {
  int dimensions = 3;
  double spacing = 0, support = 0, sound_speed = 0;
  double diffusion = 0.1, tension_limit = 0, anti_pairing = 0.1, correction = 1.05;
  Kernel kernel = Kernel::level;
  Weight weight = Weight::lattice;
  bool viscous_tension = true;    // bounded by the viscous stress, and the density with it
  double wall_tension_limit = 0;  // of walls without their own
  Vec gravity, body_acceleration;
  Vec period;  // 0: an open axis
  std::vector<Fluid> fluids;
  std::vector<Particle> particles;
  std::vector<Wall> walls;
  double way = 0;           // [s] that fluid moves with its velocities
  bool walls_move = false;  // else what they have moved is that of their surfaces

  Vec moved(const Wall& wall, double dt) const { return walls_move ? wall.moved : dt * wall.v; }
  // x_ij.u_ij + turn v_ij^2 of the implicit share theta is nought where a chord of the way keeps |x_ij|.
  double turn(double theta) const { return way / 2 * (2 * theta - 1) / theta; }
  // x_ij half-way.
  Vec half_way(const Particle& p, const Particle& other, Vec d) const {
    return d + way / 2 * (p.v - other.v);
  }
  const Fluid& kind(const Particle& p) const { return fluids[static_cast<std::size_t>(p.fluid)]; }
  double density(const Particle& p) const { return kind(p).rest_density + p.excess; }
  double limit(const Wall& wall) const {
    return wall.tension_limit < 0 ? wall_tension_limit : wall.tension_limit;
  }
  // Of a particle; towards a wall that bears another tension than the fluid its own.
  double pressure_towards(const Wall& wall, const Particle& p) const {
    const bool like_fluid = wall.tension_limit < 0 && wall_tension_limit == tension_limit;
    return like_fluid ? p.pressure : std::max(sound_speed * sound_speed * p.excess, -limit(wall));
  }
  SmoothingFunction smoothing() const { return {kernel, support, dimensions}; }
  double wall_volume() const { return std::pow(spacing, dimensions); }
  double softening() const { return 1e-6 * support * support; }
};

// A sum with the sum of its terms' sizes, by which rounding in the program under test is to be judged.
struct Sum {
  Vec value;
  double size = 0;
  void add(Vec term, double term_size) { value = value + term, size += term_size; }
  void add(double term, double term_size) { add(Vec{term, 0, 0}, term_size); }
};

// Calls f(a - b) for every periodic image of b that is closer to a than `reach`.
template <class F>
void for_images(const World& w, Vec a, Vec b, double reach, F f) {
  auto images = [](double period) { return period > 0 ? 1 : 0; };
  for (int i = -images(w.period.x); i <= images(w.period.x); ++i)
    for (int j = -images(w.period.y); j <= images(w.period.y); ++j)
      for (int k = -images(w.period.z); k <= images(w.period.z); ++k) {
        const Vec d = a - b - Vec{i * w.period.x, j * w.period.y, k * w.period.z};
        if (length(d) < reach) f(d);
      }
}

// Calls f(other particle, x_ij) for all others within the support, or `reach` times that.
template <class F>
void for_fluid_pairs(const World& w, std::size_t i, F f, double reach = 1) {
  for (std::size_t j = 0; j < w.particles.size(); ++j)
    if (j != i)
      for_images(w, w.particles[i].x, w.particles[j].x, reach * w.support,
                 [&](Vec d) { f(w.particles[j], d); });
}

template <class F>
void for_wall_pairs(const World& w, std::size_t i, F f, double reach = 1) {
  for (const Wall& wall : w.walls)
    for_images(w, w.particles[i].x, wall.x, reach * w.support, [&](Vec d) { f(wall, d); });
}
constexpr double reach_before = 1.05;  // of pairs that may have been within the support half a step ago

// (1/r) dW/dr; zero for coincident particles, between which nothing acts.
inline double slope_over_distance(const World& w, double r) { return r > 0 ? w.smoothing().slope(r) / r : 0; }
inline double flat_slope_over_distance(const World& w, double r) {
  return r > 0 ? flat_slope(r, w.support, w.dimensions) / r : 0;
}

// Of the velocity difference of a pair in the viscous operator.
inline double viscous_weight(const World& w, double r) {
  if (w.weight == Weight::lattice) return lattice_weight(r, w.support, w.dimensions);
  if (w.weight == Weight::value) return value_weight(w.kernel, r, w.support, w.dimensions);
  return -slope_over_distance(w, r) / (r * r + w.softening());
}

// Share that the function of pairs under tension has in the continuity of particle p below zero.
inline double tension_share(const World& w, const Particle& p) {
  if (w.kernel == Kernel::lucy) return 0;
  const double ratio = p.mass / p.volume * w.sound_speed * w.spacing / (40 * p.viscosity);
  return 1 / (1 + ratio * ratio);
}
// F, or what takes its place below zero.
inline double mixed_slope(const World& w, double share, double r) {
  return (1 - share) * slope_over_distance(w, r) + share * flat_slope_over_distance(w, r);
}

// A pressure with the share of the function for tension where it is below zero.
struct Side {
  double pressure, share;
};
inline double pressure_slope(const World& w, Side own, Side other, double r) {
  double sum = 0;
  for (const Side& s : {own, other})
    sum += s.pressure * (s.pressure < 0 ? mixed_slope(w, s.share, r) : slope_over_distance(w, r));
  return sum;
}

// Sum of -V x dW/dx over a lattice: what the pair sums make of a gradient of 1.
inline double gradient_on_lattice(const World& w) {
  double sum = 0;
  const int y = w.dimensions == 3 ? 4 : 0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -y; j <= y; ++j)
      for (int k = -4; k <= 4; ++k) {
        const Vec d = w.spacing * Vec{double(i), double(j), double(k)};
        sum -= w.wall_volume() * slope_over_distance(w, length(d)) * d.x * d.x;
      }
  return sum;
}

// Change of the density of particle i over a step of dt that has brought all to where they are: continuity
// and density diffusion (numerics.md, section 0), with the pairs where they were half-way. Walls take part
// with the density that their pressure has in the fluid's equation of state. Between fluids, what diffuses is
// the excess over each one's rest density: otherwise their interface would.
// How far the densities around particle i are below rest together: 1 when all are, 0 when as many are above.
inline double held_together(const World& w, std::size_t i, double dt) {
  const Particle& p = w.particles[i];
  if (p.excess >= 0) return 0;
  double sum = 0, sizes = 0;
  for_fluid_pairs(
      w, i,
      [&](const Particle& j, Vec d) {
        const Vec half_way = d - 0.5 * dt * (p.v - j.v);
        if (length(half_way) >= w.support) return;
        const double weight = -j.volume * slope_over_distance(w, length(half_way));
        sum += weight * j.excess, sizes += weight * std::fabs(j.excess);
      },
      reach_before);
  return sizes > 0 ? std::max(0.0, -sum / sizes) : 0;
}

inline Sum density_change(const World& w, std::size_t i, double dt) {
  const Particle& p = w.particles[i];
  const double c2 = w.sound_speed * w.sound_speed, rest = w.kind(p).rest_density;
  const double strength = 2 * w.diffusion * (w.support / 2) * w.sound_speed;
  const double density = w.density(p);
  const double in_tension = p.excess < 0 ? tension_share(w, p) * held_together(w, i, dt) : 0;
  Sum sum;
  // `moved`: what the step has added to d; `balanced`: minus the force per volume by pressure
  auto pair = [&](Vec d, double volume, Vec moved, double excess, Vec balanced, double share, double eta) {
    const Vec half_way = d - 0.5 * moved;
    if (length(half_way) >= w.support) return;
    const double f = slope_over_distance(w, length(half_way));
    const double mixed = mixed_slope(w, in_tension, length(half_way));
    sum.add(density * volume * mixed * dot(moved, half_way),
            density * volume * -f * length(moved) * length(d));
    const double smooth = dot(balanced, -1 * half_way) / c2 * share;
    const double thin = dt * strength / (1 + eta / (rest * w.sound_speed * w.support));
    sum.add(thin * volume * -f * (excess - p.excess - smooth),
            thin * volume * -f * (std::fabs(excess) + std::fabs(p.excess) + std::fabs(smooth)));
  };
  for_fluid_pairs(
      w, i,
      [&](const Particle& j, Vec d) {
        const bool alike = j.fluid == p.fluid;  // else nothing diffuses
        pair(d, j.volume, dt * (p.v - j.v), alike ? j.excess : p.excess,
             alike ? -0.5 * (p.by_pressure + j.by_pressure) : Vec{}, 1 / gradient_on_lattice(w),
             0.5 * (p.viscosity + j.viscosity));
      },
      reach_before);
  for_wall_pairs(
      w, i,
      [&](const Wall& j, Vec d) {
        const bool cut = j.pressure <= -w.limit(j);  // no diffusion there
        pair(d, w.wall_volume(), dt * p.v - w.moved(j, dt), cut ? p.excess : j.pressure / c2,
             cut ? Vec{} : rest * (w.gravity - j.acceleration), 1, p.viscosity);
      },
      reach_before);
  return sum;
}

// What is left of the void of particle i: no more than the places of all, half-way along the step, leave room
// for; of one above 2 % of the density no less than 0.96 of a fill shows, away from walls.
inline double hollow_left(const World& w, std::size_t i, double dt) {
  const Particle& p = w.particles[i];
  if (!(p.hollow > 0)) return 0;
  const SmoothingFunction smoothing = w.smoothing();
  double fill = p.volume * smoothing.value(0), nearest = 1e30;
  auto pair = [&](Vec half_way, double volume) {
    if (length(half_way) < w.support) fill += volume * smoothing.value(length(half_way));
  };
  for_fluid_pairs(
      w, i, [&](const Particle& j, Vec d) { pair(d - 0.5 * dt * (p.v - j.v), j.volume); }, reach_before);
  for_wall_pairs(
      w, i,
      [&](const Wall& j, Vec d) {
        pair(d - 0.5 * (dt * p.v - w.moved(j, dt)), w.wall_volume());
        nearest = std::min(nearest, length(d));
      },
      reach_before);
  const double rest = w.kind(p).rest_density;
  const double seen = p.hollow > 0.02 * rest && !(nearest < 0.9 * w.spacing) ? rest * (0.96 - fill) : 0;
  return std::min(std::max(p.hollow, seen), rest * std::max(0.0, 1.02 - fill));
}

// Morris' factor of a wall pair, for the face before which the fluid particle stands: the difference between
// the particle's velocity and the wall particle's on a line that vanishes at the slip length behind the face.
struct FaceBetween {
  double depth, height;
};
inline FaceBetween face_between(const World& w, const Wall& wall, Vec d) {
  const bool before_back = wall.back_depth > 0 && dot(d, wall.back_normal) > wall.back_depth;
  const Vec normal = before_back ? wall.back_normal : wall.normal;
  const double depth = before_back ? wall.back_depth : wall.depth;
  return {depth, std::max(dot(d, normal) - depth, w.spacing / 4)};
}
inline double no_slip_factor(const World& w, const Wall& wall, Vec d) {
  const FaceBetween f = face_between(w, wall, d);
  return std::min(3.0, (f.height + f.depth) / (f.height + wall.slip_length));
}
// The share of the velocity between fluid and wall that shears the fluid, and does not slip.
inline double share_in_fluid(const World& w, const Wall& wall, Vec d) {
  const double height = face_between(w, wall, d).height;
  return height / (height + wall.slip_length);
}

// gamma_i^2 of the step of dt that has brought all to where they are. Of a pair of two fluids each has the
// share of the strain that its viscosity gives it under a common stress.
inline Sum shear_rate_squared(const World& w, std::size_t i, double dt = 0) {
  const Particle& p = w.particles[i];
  Sum sum;
  auto pair = [&](Vec d, double volume, Vec velocity, Vec moved) {
    const Vec half_way = d - 0.5 * moved;
    if (length(half_way) >= w.support) return;
    const double r2 = dot(half_way, half_way);
    const double weight = viscous_weight(w, length(half_way)) * volume;
    const double factor = w.correction * (w.dimensions + 2) * weight;
    sum.add(factor * std::pow(dot(p.v - velocity, half_way), 2),
            factor * dot(p.v - velocity, p.v - velocity) * r2);
  };
  for_fluid_pairs(
      w, i,
      [&](const Particle& j, Vec d) {
        const double share = p.fluid == j.fluid ? 1 : 2 * j.viscosity / (p.viscosity + j.viscosity);
        pair(d, share * share * j.volume, j.v, dt * (p.v - j.v));
      },
      reach_before);
  for_wall_pairs(
      w, i,
      [&](const Wall& j, Vec d) {  // i carries all that the pair dissipates
        const Vec half_way = d - 0.5 * (dt * p.v - w.moved(j, dt));
        if (j.sticks)
          pair(d, 2 * no_slip_factor(w, j, half_way) * share_in_fluid(w, j, half_way) * w.wall_volume(),
               j.v - dt * j.acceleration, dt * p.v - w.moved(j, dt));
      },
      reach_before);
  return sum;
}

// Pressure that a wall particle takes from the fluid in reach.
inline Sum wall_pressure(const World& w, const Wall& wall) {
  Sum sum;
  double weights = 0;
  for (const Particle& p : w.particles)
    for_images(w, wall.x, p.x, w.support, [&](Vec d) {
      const double weight = w.smoothing().value(length(d));
      const double head = w.density(p) * dot(w.gravity - wall.acceleration, d);
      weights += weight;
      const double pressure = w.pressure_towards(wall, p);
      sum.add(weight * (pressure + head), weight * (std::fabs(pressure) + std::fabs(head)));
    });
  if (weights <= 0) return {};
  return {{std::max(sum.value.x / weights, -w.limit(wall)), 0, 0}, sum.size / weights};
}

// Acceleration by gravity, body force and pressure, with the term that keeps pairs apart. `given`: the part
// of it by that term and by the pressure of walls.
inline Sum acceleration(const World& w, std::size_t i, Vec* given = nullptr) {
  const Particle& p = w.particles[i];
  const double at_spacing = w.smoothing().value(w.spacing);
  Sum sum;
  sum.add(w.gravity + w.body_acceleration, length(w.gravity) + length(w.body_acceleration));
  const double own_share = w.kernel == Kernel::lucy ? 0 : 1;
  auto pair = [&](Vec d, double volume, double own, Side there) {
    const double other = there.pressure;
    const double r = length(d), ratio = w.smoothing().value(r) / at_spacing;
    const double pairing = w.anti_pairing * std::max(0.0, std::pow(ratio, 4) - 1);
    const double sizes = std::fabs(own) + std::fabs(other);
    const double volumes = p.volume * volume / p.mass, f = slope_over_distance(w, r);
    sum.add(-volumes * (pressure_slope(w, {own, own_share}, there, r) + pairing * sizes * f) * d,
            volumes * (1 + pairing) * sizes * -f * r);
    return -volumes * pairing * sizes * f * d;
  };
  auto give = [&](Vec a) {
    if (given) *given = *given + a;
  };
  for_fluid_pairs(w, i, [&](const Particle& j, Vec d) {
    give(pair(d, j.volume, p.pressure, {j.pressure, own_share}));
  });
  for_wall_pairs(w, i, [&](const Wall& j, Vec d) {
    const double elastic = w.pressure_towards(j, p), own = std::max(elastic, p.contact);
    const double volumes = p.volume * w.wall_volume() / p.mass, r = length(d);
    const Side wall{j.pressure, own_share};
    const double given_slope =
        pressure_slope(w, {own, own_share}, wall, r) - pressure_slope(w, {elastic, own_share}, {0, 0}, r);
    give(pair(d, w.wall_volume(), own, wall) - volumes * given_slope * d);
  });
  return sum;
}

}  // namespace reference
