// The watch ends a run whose state cannot be true, and says where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "simulation.hpp"
#include "simulation_setups.hpp"

namespace slagflow {
namespace {

using testing_tools::dam;

std::string end_of(const SimulationSetup& setup) {
  Simulation simulation(setup);
  try {
    for (int k = 0; k < 40; ++k) simulation.step();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Watch, LetsASoundRunGoOn) { EXPECT_EQ(end_of(dam()), ""); }

TEST(Watch, EndsARunawayAndNamesTheParticle) {
  SimulationSetup setup = dam();
  setup.limits.max_speed = 1e-6;
  EXPECT_THAT(end_of(setup), testing::AllOf(testing::HasSubstr("step 10"), testing::HasSubstr("a speed of"),
                                            testing::HasSubstr("particle "), testing::HasSubstr("try ")));
}

TEST(Watch, EndsACompressionBeyondItsLimit) {
  SimulationSetup setup = dam();
  setup.limits.max_compression = 1e-7;
  EXPECT_THAT(end_of(setup), testing::HasSubstr("a compression"));
}

TEST(Watch, EndsACollapsedTimeStep) {
  SimulationSetup setup = dam();
  setup.limits.min_time_step_ratio = 2;
  EXPECT_THAT(end_of(setup), testing::HasSubstr("the time step fell"));
}

}  // namespace
}  // namespace slagflow
