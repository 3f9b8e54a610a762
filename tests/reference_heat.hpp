// The oracle of heat: all pairs, double precision, properties by their definitions.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "reference.hpp"

namespace reference {

using Rows = std::vector<std::array<double, 2>>;

inline double at(const Rows& rows, double x) {
  if (x <= rows.front()[0]) return rows.front()[1];
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (x <= rows[k][0])
      return rows[k - 1][1] +
             (rows[k][1] - rows[k - 1][1]) * (x - rows[k - 1][0]) / (rows[k][0] - rows[k - 1][0]);
  return rows.back()[1];
}

// Integral of linear rows from 0 to x; exact but for the kinks, which the steps are small against.
inline double integral(const Rows& rows, double from, double to) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int k = 0; k < steps; ++k) sum += at(rows, from + (to - from) * (k + 0.5) / steps);
  return sum * (to - from) / steps;
}

struct HeatWall {
  enum Kind { adiabatic, held, flux, thick } kind = adiabatic;
  double temperature = 0, flux_in = 0, contact = 0;  // contact 0: perfect
  double absorption = 0, taken = 0;                  // of a thick one: a, E per area
};

struct HeatWorld {
  World world;
  std::vector<Rows> conductivity;  // of each fluid
  std::vector<double> emissivity;
  std::vector<double> temperature;  // of each particle
  std::vector<HeatWall> bodies;
  std::vector<int> site;          // of each wall particle; -1: none
  std::vector<double> site_area;  // and of each site
  std::vector<int> site_body;
  double factor = 0;            // C_T
  std::vector<Vec> directions;  // of free surfaces
  double flat_share = 0, drop_exponent = 0, ambient = 0, transfer = 0;

  double k(std::size_t i, double t) const {
    return at(conductivity[static_cast<std::size_t>(world.particles[i].fluid)], t);
  }
  // Theta(b) - Theta(a).
  double potential(std::size_t i, double a, double b) const {
    return integral(conductivity[static_cast<std::size_t>(world.particles[i].fluid)], a, b);
  }
  double weight(double r) const {
    return 2 * factor * lattice_weight(r, world.support, world.dimensions) * r * r;
  }

  // [W] into particle i from the others, and the sum of the sizes of its terms.
  struct Flow {
    double value = 0, size = 0;
    void operator+=(double term) { value += term, size += std::fabs(term); }
  };
  Flow conducted(std::size_t i) const {
    Flow sum;
    for (std::size_t j = 0; j < world.particles.size(); ++j) {
      if (j == i) continue;
      for_images(world, world.particles[i].x, world.particles[j].x, world.support, [&](Vec d) {
        const double g = world.particles[i].volume * world.particles[j].volume * weight(length(d));
        if (world.particles[i].fluid == world.particles[j].fluid) {
          sum += g * potential(i, temperature[i], temperature[j]);
        } else {
          const double a = k(i, temperature[i]), b = k(j, temperature[j]);
          sum += g * 2 * a * b / (a + b) * (temperature[j] - temperature[i]);
        }
      });
    }
    return sum;
  }

  struct Contact {
    double area, distance;
  };
  Contact contact(std::size_t i, const Wall& w, Vec d) const {
    const double front = dot(d, w.normal) - w.depth, rear = dot(d, w.back_normal) - w.back_depth;
    const bool behind = w.back_depth > 0 && rear > 0;
    const double distance = std::max(behind ? rear : front, world.spacing / 4);
    const double depth = behind ? w.back_depth : w.depth;
    return {weight(length(d)) * world.particles[i].volume * world.wall_volume() * (distance + depth),
            distance};
  }

  // [W/m^2] over the difference of temperature.
  double conductance(std::size_t i, const HeatWall& body, double wall, double distance) const {
    double touch = wall, u = 0;
    for (int pass = 0; pass < (body.contact > 0 ? 3 : 1); ++pass) {
      const double apart = touch - temperature[i];
      const double k_mean =
          std::fabs(apart) > 1e-2 ? potential(i, temperature[i], touch) / apart : k(i, temperature[i]);
      u = 1 / (distance / k_mean + (body.contact > 0 ? 1 / body.contact : 0));
      touch = temperature[i] + u * (wall - temperature[i]) * distance / k_mean;
    }
    return u;
  }

  // Calls f(particle, contact) for the pairs of a site.
  void each_pair(int s, const std::function<void(std::size_t, Contact)>& f) const {
    for (std::size_t w = 0; w < world.walls.size(); ++w) {
      if (site[w] != s) continue;
      for (std::size_t i = 0; i < world.particles.size(); ++i)
        for_images(world, world.particles[i].x, world.walls[w].x, world.support,
                   [&](Vec d) { f(i, contact(i, world.walls[w], d)); });
    }
  }

  // Surface temperature of a thick wall after a step, by bisection of a x|x|/E + B x = B (T - T_0).
  double surface(int s) const {
    const HeatWall& body = bodies[static_cast<std::size_t>(site_body[static_cast<std::size_t>(s)])];
    if (body.kind != HeatWall::thick) return body.temperature;
    double conducts = 0, carries = 0;
    each_pair(s, [&](std::size_t i, Contact c) {
      const double part = c.area * conductance(i, body, body.temperature, c.distance);
      conducts += part, carries += part * (temperature[i] - body.temperature);
    });
    if (!(conducts > 0)) return body.temperature;
    const double b = conducts / site_area[static_cast<std::size_t>(s)], above = carries / conducts;
    double low = std::min(0.0, above), high = std::max(0.0, above);
    for (int k = 0; k < 200; ++k) {
      const double x = 0.5 * (low + high);
      (body.absorption * x * std::fabs(x) / body.taken + b * x > b * above ? high : low) = x;
    }
    return body.temperature + 0.5 * (low + high);
  }

  // [W] into each particle from the walls, and out of each site.
  struct FromWalls {
    std::vector<double> particle, site;
  };
  FromWalls from_walls() const {
    FromWalls result{std::vector<double>(world.particles.size()), std::vector<double>(site_body.size())};
    for (std::size_t s = 0; s < site_body.size(); ++s) {
      const HeatWall& body = bodies[static_cast<std::size_t>(site_body[s])];
      const double wall = surface(static_cast<int>(s));
      double covered = 0;
      each_pair(static_cast<int>(s), [&](std::size_t, Contact c) { covered += c.area; });
      each_pair(static_cast<int>(s), [&](std::size_t i, Contact c) {
        const double flux = body.kind == HeatWall::flux
                                ? body.flux_in * site_area[s] / std::max(covered, site_area[s] / 2)
                                : conductance(i, body, wall, c.distance) * (wall - temperature[i]);
        result.particle[i] += c.area * flux, result.site[s] += c.area * flux;
      });
    }
    return result;
  }

  double deficit(std::size_t i) const {
    const SmoothingFunction w{Kernel::lucy, world.support, world.dimensions};
    double fill = world.particles[i].volume * w.value(0);
    for_fluid_pairs(world, i, [&](const Particle& o, Vec d) { fill += o.volume * w.value(length(d)); });
    for_wall_pairs(world, i, [&](const Wall&, Vec d) { fill += world.wall_volume() * w.value(length(d)); });
    return 1 - fill;
  }

  // Of the directions from a particle those in which a place a spacing away is within a spacing of no other;
  // not-a-number where rounding decides.
  double open_directions(std::size_t i) const {
    double open = 0;
    for (const Vec& u : directions) {
      double deepest = -1e30;
      const auto look = [&](Vec d) {
        deepest = std::max(deepest, 2 * world.spacing * dot(u, -1.0 * d) - dot(d, d));
      };
      for_fluid_pairs(world, i, [&](const Particle&, Vec d) { look(d); });
      for_wall_pairs(world, i, [&](const Wall&, Vec d) { look(d); });
      if (std::fabs(deepest) < 1e-5 * world.spacing * world.spacing) return std::nan("");
      open += deepest > 0 ? 0 : 1;
    }
    return open;
  }

  // [W] lost by the surface of a particle: its temperature by bisection.
  double lost(std::size_t i, double inside) const {
    if (deficit(i) <= inside) return 0;
    const double share = open_directions(i) / static_cast<double>(directions.size()) / flat_share;
    const double size = world.dimensions == 3 ? world.spacing * world.spacing : world.spacing;
    const double area = size * (share <= 2 ? share : 2 * std::pow(share / 2, drop_exponent));
    const double radiance = 5.670374e-8 * emissivity[static_cast<std::size_t>(world.particles[i].fluid)];
    const auto flux = [&](double t) {
      return radiance * (std::pow(t, 4) - std::pow(ambient, 4)) + transfer * (t - ambient);
    };
    double low = ambient, high = temperature[i];
    for (int k = 0; k < 100; ++k) {
      const double t = 0.5 * (low + high);
      (potential(i, t, temperature[i]) > flux(t) * world.spacing / 2 ? low : high) = t;
    }
    return area * flux(0.5 * (low + high));
  }
};

}  // namespace reference
