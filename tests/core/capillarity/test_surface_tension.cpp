// Surface tension: its strength, what it conserves, what it does to a drop.
#include <gtest/gtest.h>

#include <limits>

#include "capillarity/surface_tension.hpp"
#include "core/simulation_setups.hpp"
#include "fluid/constants.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

SimulationSetup tense_dam() {
  SimulationSetup s = dam();
  for (FluidSetup& fluid : s.fluids) fluid.surface_tension = 2;
  s.bodies[0].contact_angle = 60;
  s.measure_walls = true;
  return s;
}

// The integral by the midpoint rule with 400 intervals each way, worked out apart.
TEST(SurfaceTension, HasTheStrengthOfItsIntegral) {
  EXPECT_NEAR(plane_surface_tension(2), 0.310987, 2e-4);
  EXPECT_NEAR(plane_surface_tension(3), 0.315968, 2e-4);
  EXPECT_NEAR(plane_wall_tension(2), 0.324187, 5e-5);
  EXPECT_NEAR(plane_wall_tension(3), 0.325487, 5e-5);
}

TEST(SurfaceTension, LimitsTheTimeStep) {
  SimulationSetup s = empty_setup({0, 0, 0}, {1, 1, 1});
  EXPECT_GT(capillary_time_step(s), 1e300);
  s.fluids[1].surface_tension = 3;
  EXPECT_NEAR(capillary_time_step(s), 0.5 * std::sqrt(900e-6 / (6 * 3.14159265358979)), 1e-12);
  s.numerics.sound_speed = 1e-3;
  EXPECT_EQ(stable_time_step(s), capillary_time_step(s));
}

class SurfaceTensionWith : public testing::TestWithParam<YieldModel> {};

// Momentum after - before = gravity - impulse on the walls, bounds as in test_wall_forces.cpp.
TEST_P(SurfaceTensionWith, BalancesTheMomentumWithTheWalls) {
  SimulationSetup s = tense_dam();
  s.numerics.yield = GetParam(), s.numerics.theta = 1;
  s.numerics.tolerance = 1e-9, s.numerics.max_iterations = 2000;
  Simulation simulation(s);
  const int steps = GetParam() == YieldModel::exact ? 2 : 10;  // its solves take long at this tolerance
  for (int step = 0; step < steps; ++step) {
    const Totals before = simulation.totals();
    simulation.step();
    const Totals after = simulation.totals();
    const Vec3d walls =
        after.walls[0].pressure + after.walls[0].viscous - before.walls[0].pressure - before.walls[0].viscous;
    const Vec3d gravity = simulation.velocity_time_step() * after.mass_in * s.gravity;
    const Vec3d error = after.momentum - before.momentum - gravity + walls;
    const double size = norm(walls) + norm(gravity) + norm(after.momentum);
    EXPECT_LT(norm(error), 20 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * size) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(YieldModels, SurfaceTensionWith,
                         testing::Values(YieldModel::regularised, YieldModel::exact));

TEST(SurfaceTension, ResumesToTheBit) {
  Simulation whole(tense_dam()), first(tense_dam()), second(tense_dam());
  for (int step = 0; step < 7; ++step) first.step();
  second.restore(first.save());
  for (int step = 0; step < 6; ++step) second.step();
  for (int step = 0; step < 13; ++step) whole.step();
  FluidSnapshot a, b;
  whole.read(a), second.read(b);
  ASSERT_EQ(a.position.size(), b.position.size());
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    EXPECT_EQ(a.position[i], b.position[i]);
    EXPECT_EQ(a.velocity[i], b.velocity[i]);
  }
}

}  // namespace
}  // namespace slagflow
