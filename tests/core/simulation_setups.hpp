// Small setups for tests of the whole simulation.
#pragma once

#include <cmath>

#include "scene.hpp"
#include "simulation/simulation.hpp"

namespace slagflow::testing_tools {

inline constexpr double dx = 0.01;

inline FluidSetup slag() { return {"slag", 2600, {RheologyKind::bingham, {Real(0.5), Real(5), Real(1000)}}}; }
inline FluidSetup oil() { return {"oil", 900, {RheologyKind::newtonian, {Real(0.3)}}}; }

inline void add_particle(SimulationSetup& s, Vec3d x, Vec3d v, std::uint8_t fluid) {
  s.particles.position.push_back(x), s.particles.velocity.push_back(v);
  s.particles.pressure.push_back(0), s.particles.fluid.push_back(fluid);
}

inline void add_wall(SimulationSetup& s, Vec3d x, Vec3d normal, double depth) {
  s.walls.position.push_back(x), s.walls.normal.push_back(normal);
  s.walls.depth.push_back(depth), s.walls.body.push_back(0);
}

// A box without walls or particles.
inline SimulationSetup empty_setup(Vec3d lower, Vec3d upper) {
  SimulationSetup s;
  s.spacing = dx;
  s.fluids = {slag(), oil()};
  s.bodies = {{"floor", WallSlip::no_slip}};
  s.domain.lower = lower, s.domain.upper = upper;
  s.numerics.sound_speed = 4;
  s.numerics.courant = 0.5;  // short steps: some tests count them
  return s;
}

// A column of slag under oil that runs off the end of a floor and out through the bottom and the front;
// periodic along y. Positions carry noise, so that nothing is symmetric.
inline SimulationSetup dam() {
  SimulationSetup s = empty_setup({-0.05, -0.02, -0.03}, {0.16, 0.05, 0.12});
  s.domain.periodic = {false, true, false};
  s.fronts = {{0, 1, 0.05}, {2, -1, 0.0}};
  Random random(1);
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 7; ++i) {
        const Vec3d noise = random.vector(0.1 * dx);
        add_particle(s, Vec3d{(i + 0.5) * dx, -0.02 + (j + 0.5) * dx, (k + 0.5) * dx} + noise, {0.6, 0, 0},
                     k < 3 ? 0 : 1);
        s.particles.pressure.back() = 9.81 * dx * (k < 3 ? (2.5 - k) * 2600 + 3 * 900 : (5.5 - k) * 900);
      }
  for (int k = -3; k < 8; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = -3; i < 7; ++i) {
        const Vec3d x{(i + 0.5) * dx, -0.02 + (j + 0.5) * dx, (k + 0.5) * dx};
        if (k < 0) add_wall(s, x, {0, 0, 1}, -x.z);
        if (k >= 0 && i < 0) add_wall(s, x, {1, 0, 0}, -x.x);
      }
  return s;
}

// The dam with a back wall and a floor that move as bodies of their own.
inline SimulationSetup moving_dam() {
  SimulationSetup s = dam();
  s.bodies = {{"floor", WallSlip::no_slip}, {"back", WallSlip::partial_slip}};
  s.bodies[1].slip_length = 0.5 * dx;
  s.bodies[0].surface.velocity = {0.2, 0.1, 0};
  s.bodies[1].motion.kind = MotionKind::sine;
  s.bodies[1].motion.amplitude = {0.4 * dx, 0, 0.1 * dx}, s.bodies[1].motion.angular_amplitude = {0, 0.1, 0};
  s.bodies[1].motion.frequency = 20;
  s.bodies[1].motion.center = {0, 0, 0.03};
  for (std::size_t i = 0; i < s.walls.position.size(); ++i)
    s.walls.body[i] = s.walls.position[i].z > 0 ? 1 : 0;
  s.measure_walls = true;
  return s;
}

// Fluid at rest in a tank with a floor and periodic sides, its pressure hydrostatic.
inline SimulationSetup tank(const FluidSetup& fluid) {
  SimulationSetup s = empty_setup({0, 0, -0.03}, {0.08, 0.08, 0.12});
  s.domain.periodic = {true, true, false};
  s.fluids = {fluid};
  for (int k = -3; k < 6; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        const Vec3d x{(i + 0.5) * dx, (j + 0.5) * dx, (k + 0.5) * dx};
        if (k < 0) {
          add_wall(s, x, {0, 0, 1}, -x.z);
        } else {
          add_particle(s, x, {}, 0);
          s.particles.pressure.back() = fluid.rest_density * 9.81 * (0.06 - x.z);
        }
      }
  return s;
}

// The same in two dimensions: one layer of it.
inline SimulationSetup flat_tank(const FluidSetup& fluid) {
  SimulationSetup setup = tank(fluid), flat = setup;
  flat.dimensions = 2, flat.particles = {}, flat.walls = {};
  flat.domain.lower.y = 0, flat.domain.upper.y = dx, flat.domain.periodic = {true, false, false};
  for (std::size_t i = 0; i < setup.particles.position.size(); ++i) {
    const Vec3d x = setup.particles.position[i];
    if (x.y > dx) continue;
    add_particle(flat, x, {}, 0);
    flat.particles.pressure.back() = setup.particles.pressure[i];
  }
  for (std::size_t i = 0; i < setup.walls.position.size(); ++i)
    if (setup.walls.position[i].y < dx)
      add_wall(flat, setup.walls.position[i], setup.walls.normal[i], setup.walls.depth[i]);
  return flat;
}

// A free cube that spins about the axis y through its centre.
inline SimulationSetup spinning_block(double rate) {
  SimulationSetup s = empty_setup({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  s.gravity = {};
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i) {
        const Vec3d x{(i - 4.5) * dx, (j - 4.5) * dx, (k - 4.5) * dx};
        add_particle(s, x, {rate * x.z, 0, -rate * x.x}, 0);
      }
  return s;
}

}  // namespace slagflow::testing_tools
