// The watch ends a run whose state cannot be true, and says where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "backend/error.hpp"
#include "core/simulation_setups.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::dam;

std::string end_of(const SimulationSetup& setup, int steps = 40) {
  Simulation simulation(setup);
  try {
    for (int k = 0; k < steps; ++k) simulation.step();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Watch, LetsASoundRunGoOn) { EXPECT_EQ(end_of(dam()), ""); }

TEST(Watch, EndsARunawayAndNamesTheParticle) {
  SimulationSetup setup = dam();
  setup.limits.max_speed = 1e-6;
  EXPECT_THAT(end_of(setup), testing::AllOf(HasSubstr("step 10"), HasSubstr("a speed of"),
                                            HasSubstr("limits.max_speed is 1e-06 m/s"),
                                            HasSubstr("particle "), HasSubstr("try ")));
}

TEST(Watch, LooksAsOftenAsItIsTold) {
  SimulationSetup setup = dam();
  setup.limits.max_speed = 1e-6, setup.limits.interval = 3;
  EXPECT_THAT(end_of(setup), HasSubstr("step 3 "));
}

TEST(Watch, EndsACompressionBeyondItsLimit) {
  SimulationSetup setup = dam();
  setup.limits.max_compression = 1e-7;
  EXPECT_THAT(end_of(setup), testing::AllOf(HasSubstr("a compression"), HasSubstr("particle "),
                                            HasSubstr("limits.max_compression is 1e-07")));
}

TEST(Watch, EndsACompressionBetweenLooks) {
  SimulationSetup setup = dam();
  setup.limits.max_compression = 1e-7, setup.limits.interval = 1000;
  EXPECT_THAT(end_of(setup), testing::AllOf(HasSubstr("step 1 "), HasSubstr("a compression")));
}

TEST(Watch, EndsACollapsedTimeStep) {
  SimulationSetup setup = dam();
  setup.limits.min_time_step_ratio = 2;
  EXPECT_THAT(end_of(setup), testing::AllOf(HasSubstr("the time step fell"),
                                            HasSubstr("limits.min_time_step_ratio allows")));
}

TEST(Watch, EndsARunThatLosesItsParticles) {
  SimulationSetup setup = dam();
  setup.limits.max_lost_fraction = 0.001;
  const std::string end = end_of(setup, 80);
  EXPECT_THAT(end,
              testing::AllOf(HasSubstr("a fraction 0."), HasSubstr("limits.max_lost_fraction is 0.001")));
  // A row of particles at most: those outside are counted when all are sorted, which the builds do at steps
  // of their own.
  EXPECT_LT(std::stod(end.substr(end.find("fraction ") + 9)), 0.2) << end;
}

// A block under pressure that is let go. Explicit acoustics add energy where the time step is too long for
// them.
SimulationSetup released_block(double courant, std::uint8_t fluid) {
  SimulationSetup setup = testing_tools::spinning_block(0);
  testing_tools::Random random(1);
  for (Vec3d& x : setup.particles.position) x += random.vector(0.02 * testing_tools::dx);
  for (double& p : setup.particles.pressure) p = 500;
  for (std::uint8_t& kind : setup.particles.fluid) kind = fluid;
  for (FluidSetup& f : setup.fluids) f.rheology = {RheologyKind::newtonian, {Real(1e-3)}};
  setup.numerics.courant = courant;
  setup.numerics.density_diffusion = 0;  // would shorten the time step
  return setup;
}

TEST(Watch, LargestCompressionIsThatOfAllSteps) {
  const SimulationSetup setup = released_block(0.5, 0);
  Simulation simulation(setup);
  double largest = 0, last = 0;
  for (int k = 0; k < 20; ++k) {
    simulation.step();
    last = simulation.totals().max_density_error;
    largest = std::max(largest, last);
    ASSERT_EQ(simulation.largest_compression().value, largest) << k;
  }
  ASSERT_LT(last, largest);  // else it might be that of the last step
  ASSERT_LT(simulation.largest_compression().time, simulation.time());
  Simulation restored(setup);
  restored.restore(simulation.save());
  EXPECT_EQ(restored.largest_compression().value, largest);
  EXPECT_EQ(restored.largest_compression().time, simulation.largest_compression().time);
}

TEST(Watch, EndsARunWhoseEnergyGrowsWithoutASource) {
  for (const std::uint8_t fluid : {std::uint8_t{0}, std::uint8_t{1}}) {
    EXPECT_EQ(end_of(released_block(0.5, fluid)), "");
    EXPECT_THAT(end_of(released_block(2.5, fluid)),
                testing::AllOf(HasSubstr("step 10 "), HasSubstr("the energy grew by"),
                               HasSubstr("limits.max_energy_growth is 0.05"), HasSubstr("courant")));
  }
}

// What leaves takes its energy with it, and must not hide that the rest gains some.
TEST(Watch, SeesEnergyGrowWhileParticlesLeave) {
  SimulationSetup setup = released_block(3.5, 0);
  setup.numerics.density_diffusion = 0;  // which would shorten the steps
  for (Vec3d& v : setup.particles.velocity) v.x = -0.05;
  setup.domain.lower.x = -0.046;
  EXPECT_THAT(end_of(setup), HasSubstr("the energy grew by"));
  setup.limits.max_lost_fraction = 0.05;
  EXPECT_THAT(end_of(setup), HasSubstr("has left the domain")) << "nothing leaves: nothing is tested";
}

// Wrong signs: viscosity that drives, and diffusion that gathers, are found within 20 steps.
TEST(Watch, FindsAWrongSignWithinTwentySteps) {
  SimulationSetup driven = testing_tools::spinning_block(0);
  testing_tools::Random random(2);
  for (Vec3d& v : driven.particles.velocity) v = random.vector(0.01);
  EXPECT_EQ(end_of(driven, 20), "");
  for (FluidSetup& f : driven.fluids) f.rheology = {RheologyKind::newtonian, {Real(-1)}};
  driven.numerics.weights = StoredWeights::full;  // short ones have no sign
  EXPECT_THAT(end_of(driven, 20), HasSubstr("viscosity gave the fluid"));
  SimulationSetup gathering = dam();
  gathering.numerics.density_diffusion = -0.3;
  gathering.limits.max_speed = gathering.limits.max_compression = 1e9;
  EXPECT_THAT(end_of(gathering, 20), HasSubstr("the energy grew by"));
}

// Without gravity there is no weight to measure a growth by: jittered particles under pressure in a closed
// box, whose arrangement relaxes, and a drop that bounces.
TEST(Watch, LetsABoxWithoutGravityGoOn) {
  SimulationSetup setup = testing_tools::flat_tank(testing_tools::oil());
  setup.gravity = {};
  testing_tools::Random random(4);
  for (Vec3d& x : setup.particles.position) {
    const Vec3d shift = random.vector(0.2 * testing_tools::dx);
    x.x += shift.x, x.z += shift.z;
  }
  setup.particles.pressure.assign(setup.particles.pressure.size(), 1000);
  const std::vector<Vec3d> floor = setup.walls.position;
  for (const Vec3d& x : floor) testing_tools::add_wall(setup, {x.x, x.y, 0.06 - x.z}, {0, 0, -1}, -x.z);
  EXPECT_EQ(end_of(setup, 150), "");
}

TEST(Watch, LetsADropBounce) {
  for (const double speed : {0.2, 0.7, 2.0}) {
    SimulationSetup setup = testing_tools::flat_tank(testing_tools::oil());
    setup.particles = {};
    testing_tools::add_particle(setup, {0.041, 0.005, 0.02}, {0, 0, -speed}, 0);
    setup.limits.max_compression = 0.5;
    EXPECT_EQ(end_of(setup, 130), "") << speed;
  }
}

// Heavy fluid over light fluid has the same weight as the other way round.
TEST(Watch, TakesTheMassOfEachFluid) {
  for (bool swapped : {false, true}) {
    SimulationSetup setup = dam();
    if (swapped) std::swap(setup.fluids[0], setup.fluids[1]);
    if (swapped)
      for (std::uint8_t& kind : setup.particles.fluid) kind = static_cast<std::uint8_t>(1 - kind);
    EXPECT_EQ(end_of(setup), "");
  }
}

TEST(Watch, LooksOutOfTurnWithoutALastingEffect) {
  SimulationSetup setup = dam();
  setup.limits.interval = 1000;
  Simulation looked(setup), other(setup);
  for (int k = 0; k < 12; ++k) looked.step(), other.step(), looked.require_sound();
  const SavedState a = looked.save(), b = other.save();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].bytes, b[k].bytes) << a[k].name;
  setup.limits.max_speed = 1e-6;
  Simulation runaway(setup);
  runaway.step();
  EXPECT_THROW(runaway.require_sound(), Error);
}

}  // namespace
}  // namespace slagflow
