// The end of a run: which steps it cuts, and that a run which goes on does not notice a break.
#include <gtest/gtest.h>

#include "core/simulation_setups.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

SimulationSetup ending_at(double end_time) {
  SimulationSetup s = dam();
  s.end_time = end_time;
  return s;
}

double full_step() { return Simulation(dam()).time_step(); }

TEST(EndTime, LastTwoStepsShareWhatIsLeft) {
  const double full = full_step();
  for (const double part : {0.01, 0.5, 0.99}) {
    Simulation simulation(ending_at((6 + part) * full));
    for (int k = 0; k < 5; ++k) {
      simulation.step();
      EXPECT_DOUBLE_EQ(simulation.time_step(), full);
    }
    for (int k = 0; k < 2; ++k) {
      simulation.step();
      EXPECT_NEAR(simulation.time_step(), 0.5 * (1 + part) * full, 1e-9 * full);
    }
    EXPECT_EQ(simulation.time(), (6 + part) * full);  // exactly
    simulation.step();
    EXPECT_DOUBLE_EQ(simulation.time_step(), full);
  }
}

TEST(EndTime, NoStepIsCutToLittle) {
  const double full = full_step();
  for (const double steps : {7.0, 7 - 1e-15, 7 + 1e-15, 7 - 1e-9, 7 + 1e-9}) {
    Simulation simulation(ending_at(steps * full));
    while (simulation.time() < steps * full) {
      simulation.step();
      ASSERT_GT(simulation.time_step(), 0.49 * full);
    }
    EXPECT_EQ(simulation.time(), steps * full);
  }
}

TEST(EndTime, AShortRunHasTwoSteps) {
  const double end = 1e-3 * full_step();
  Simulation simulation(ending_at(end));
  simulation.step(), simulation.step();
  EXPECT_EQ(simulation.time(), end);
  EXPECT_EQ(simulation.time_step(), 0.5 * end);
  EXPECT_NO_THROW(simulation.require_sound());
}

// Steps halved because a solve did not converge: the end is met all the same.
TEST(EndTime, IsMetAfterStepsThatWereTriedAgain) {
  SimulationSetup s = ending_at(1.3 * full_step());
  s.numerics.solver = ViscousSolver::conjugate_gradient;
  Simulation smooth(s);
  smooth.step();
  s.numerics.max_iterations = smooth.last_solve().iterations / 2;
  Simulation simulation(s);
  for (int k = 0; k < 100 && simulation.time() < s.end_time; ++k) simulation.step();
  EXPECT_EQ(simulation.time(), s.end_time);
  EXPECT_GT(simulation.solver_totals().retried, 0) << "nothing is tested";
}

TEST(EndTime, RestoredBetweenTheLastStepsGoesOnToTheSameBits) {
  const SimulationSetup s = ending_at(6.3 * full_step());
  Simulation unbroken(s);
  for (int broken = 4; broken <= 7; ++broken) {
    Simulation first(s), second(s);
    for (int k = 0; k < broken; ++k) first.step();
    second.restore(first.save());
    for (int k = broken; k < 9; ++k) second.step();
    while (unbroken.steps() < 9) unbroken.step();
    FluidSnapshot a, b;
    unbroken.read(a), second.read(b);
    EXPECT_EQ(a.time, b.time);
    ASSERT_EQ(a.id, b.id);
    for (std::size_t i = 0; i < a.id.size(); ++i) {
      EXPECT_TRUE(a.position[i] == b.position[i]) << broken;
      EXPECT_TRUE(a.velocity[i] == b.velocity[i]) << broken;
    }
  }
}

}  // namespace
}  // namespace slagflow
