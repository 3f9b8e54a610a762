// Flows with an exact yield stress that take too many iterations for a test of the core.
#include <gtest/gtest.h>

#include "core/simulation_setups.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

// Strain rates must not depend on the speed of the frame: a square in free fall, as fast as it may be.
TEST(ExactYieldFlows, ABlockFallsFreelyAtAnySpeed) {
  for (const double speed : {0.0, 1.0, 10.0}) {
    SimulationSetup s = empty_setup({-1, -1, -1}, {10, 1, 1});
    s.bodies.clear();
    s.numerics.yield = YieldModel::exact, s.numerics.sound_speed = 100;
    for (int k = 0; k < 125; ++k)
      add_particle(s, {(k % 5) * dx, (k / 5 % 5) * dx, (k / 25) * dx}, {speed, 0, 0}, 0);
    Simulation simulation(s);
    for (int k = 0; k < 60; ++k) simulation.step();
    EXPECT_EQ(simulation.solver_totals().retried, 0);
    FluidSnapshot after;
    simulation.read(after);
    // v = g t, half a step before; a velocity is rounded by half an epsilon of its size in each step.
    const double fall = norm(s.gravity) * (simulation.time() - simulation.time_step() / 2),
                 rounding = 60 * 6e-8 * (speed + fall);
    for (const auto& v : after.velocity) {
      EXPECT_NEAR(v.z, -fall, 1e-3 * fall + rounding);
      EXPECT_NEAR(v.x, speed, 1e-3 * fall + rounding);
    }
  }
}

// A layer of paste of this yield stress under one of oil, ten spacings each, between plates of which the
// upper one moves; periodic along x, two dimensions.
SimulationSetup paste_under_oil(double tau, double eta_both, double speed) {
  SimulationSetup s = empty_setup({0, -1, -0.04}, {8 * dx, 1, 0.24});
  s.dimensions = 2, s.gravity = {};
  s.domain.periodic = {true, false, false};
  s.fluids = {{"paste", 1000, {RheologyKind::bingham, {Real(eta_both), Real(tau), Real(1000)}}},
              {"oil", 1000, {RheologyKind::newtonian, {Real(eta_both)}}}};
  s.bodies = {{"lower", WallSlip::no_slip}, {"upper", WallSlip::no_slip}};
  s.bodies[1].surface.velocity = {speed, 0, 0};
  s.numerics.yield = YieldModel::exact;
  for (int k = -4; k < 24; ++k)
    for (int i = 0; i < 8; ++i) {
      const Vec3d x{(i + 0.5) * dx, 0, (k + 0.5) * dx};
      if (k >= 0 && k < 20) add_particle(s, x, {}, k < 10 ? 0 : 1);
      if (k < 0) add_wall(s, x, {0, 0, 1}, -x.z);
      if (k >= 20) add_wall(s, x, {0, 0, -1}, x.z - 0.2), s.walls.body.back() = 1;
    }
  return s;
}

// Closed form: one stress T in both; shear rates (T - tau)/eta or 0, and T/eta.
TEST(ExactYieldFlows, APasteUnderOilShearsAsItsOwnStressSays) {
  constexpr double viscosity_of_both = 200, stress = 200, depth = 10 * dx;
  for (const double tau : {4000.0, 40.0}) {
    const double of_paste = std::max(stress - tau, 0.0) / viscosity_of_both,
                 of_oil = stress / viscosity_of_both;
    const double speed = depth * (of_paste + of_oil);
    Simulation simulation(paste_under_oil(tau, viscosity_of_both, speed));
    while (simulation.time() < 0.25) simulation.step();  // the momentum diffuses through both in 0.02 s
    FluidSnapshot after;
    simulation.read(after);
    for (std::size_t i = 0; i < after.position.size(); ++i) {
      const double z = after.position[i].z;
      const double wanted = z < depth ? of_paste * z : of_paste * depth + of_oil * (z - depth);
      EXPECT_NEAR(after.velocity[i].x, wanted, 0.01 * speed) << "at " << z << " m, yield stress " << tau;
    }
  }
}

}  // namespace
}  // namespace slagflow
