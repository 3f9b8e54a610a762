// How often the host waits for the device in a step, which on a GPU costs time in which nothing is computed.
#include <gtest/gtest.h>

#include <algorithm>

#include "simulation_setups.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

struct Count {
  std::int64_t quiet_steps = 0, most = 0;  // steps without rebuild whose solve took few iterations, and waits
};

Count count_waits(const SimulationSetup& setup, int steps) {
  constexpr int few_iterations = 4;
  Simulation simulation(setup);
  Count count;
  simulation.step();  // makes the solver's arrays, and waits for each
  for (int k = 1; k < steps; ++k) {
    const std::int64_t waits = simulation.waits(), builds = simulation.list_builds();
    simulation.step();
    if (simulation.list_builds() > builds || simulation.last_solve().iterations >= few_iterations) continue;
    ++count.quiet_steps;
    count.most = std::max(count.most, simulation.waits() - waits);
  }
  return count;
}

TEST(StepWaits, OnceInAStepOfFlow) {
  SimulationSetup s = dam();
  s.limits.interval = 1000000;  // the watch reads on its own
  const Count count = count_waits(s, 60);
  EXPECT_GT(count.quiet_steps, 10);
  EXPECT_EQ(count.most, 1);
}

TEST(StepWaits, OnceInAStepWithSurfaceTension) {
  SimulationSetup s = dam();
  s.fluids[0].surface_tension = 2;
  s.limits.interval = 1000000;
  const Count count = count_waits(s, 60);
  EXPECT_GT(count.quiet_steps, 10);
  EXPECT_EQ(count.most, 1);
}

TEST(StepWaits, OnceInAStepAtRest) {
  SimulationSetup s = tank(oil());
  s.limits.interval = 1000000;
  const Count count = count_waits(s, 20);
  EXPECT_GT(count.quiet_steps, 10);
  EXPECT_EQ(count.most, 1);
}

TEST(StepWaits, TwiceMoreWhenTheWatchLooks) {
  SimulationSetup s = tank(oil());
  s.limits.interval = 1;
  EXPECT_EQ(count_waits(s, 20).most, 3);  // for its maxima and for its sums
}

}  // namespace
}  // namespace slagflow
