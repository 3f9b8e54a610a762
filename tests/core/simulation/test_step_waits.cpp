// What a step asks of the device: how often the host waits, which on a GPU costs time in which nothing is
// computed, and how much is launched. A CUDA build gives a step to the device as one graph.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/graph_loops.hpp"
#include "core/openings/fed_channel.hpp"
#include "core/simulation_setups.hpp"
#include "neighbours/neighbours.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

DeviceCounts counts_of_step(Simulation& simulation) {
  const DeviceCounts before = simulation.device_counts();
  simulation.step();
  const DeviceCounts after = simulation.device_counts();
  return {after.waits - before.waits,
          after.launches - before.launches,
          after.graph_launches - before.graph_launches,
          after.graph_kernels - before.graph_kernels,
          after.graph_recordings - before.graph_recordings,
          after.allocations - before.allocations};
}

// Over steps without rebuild whose solve took few iterations.
struct Quiet {
  int steps = 0;
  std::int64_t most_waits = 0, most_launches = 0, least_graphs = 1000, most_graphs = 0, most_kernels = 0;
};

Quiet quiet_steps(Simulation& simulation, int steps) {
  constexpr int few_iterations = 4;
  simulation.step();  // makes the solver's arrays, and waits for each
  Quiet quiet;
  for (int k = 1; k < steps; ++k) {
    const std::int64_t builds = simulation.list_builds();
    const DeviceCounts c = counts_of_step(simulation);
    if (simulation.list_builds() > builds || simulation.last_solve().iterations >= few_iterations) continue;
    ++quiet.steps;
    quiet.most_waits = std::max(quiet.most_waits, c.waits);
    quiet.most_launches = std::max(quiet.most_launches, c.launches);
    quiet.least_graphs = std::min(quiet.least_graphs, c.graph_launches);
    quiet.most_graphs = std::max(quiet.most_graphs, c.graph_launches);
    quiet.most_kernels = std::max(quiet.most_kernels, c.graph_kernels);
  }
  return quiet;
}

void expect_one_graph_a_step(const Quiet& quiet) {
  EXPECT_EQ(quiet.least_graphs, on_gpu() ? 1 : 0);
  EXPECT_EQ(quiet.most_graphs, on_gpu() ? 1 : 0);
  if (on_gpu()) {
    EXPECT_GT(quiet.most_kernels, 15);
  }
}

void expect_one_wait_and_one_launch_a_step(const Quiet& quiet) {
  EXPECT_GT(quiet.steps, 3);
  EXPECT_EQ(quiet.most_waits, 1);
  EXPECT_EQ(quiet.most_launches, 0);
  expect_one_graph_a_step(quiet);
}

Quiet quiet_steps(SimulationSetup setup, int steps) {
  setup.limits.interval = 1000000;  // the watch reads on its own
  Simulation simulation(setup);
  return quiet_steps(simulation, steps);
}

TEST(StepWaits, OnceInAStepOfFlow) { expect_one_wait_and_one_launch_a_step(quiet_steps(dam(), 20)); }

TEST(StepWaits, OnceInAStepWithSurfaceTension) {
  SimulationSetup s = dam();
  s.fluids[0].surface_tension = 2;
  expect_one_wait_and_one_launch_a_step(quiet_steps(s, 16));
}

TEST(StepWaits, OnceInAStepWithShiftingAndForcesOnWalls) {
  SimulationSetup s = dam();
  s.numerics.shifting = 0.5;
  s.measure_walls = true;
  expect_one_wait_and_one_launch_a_step(quiet_steps(s, 12));
}

// Fluid leaves all the while; only what a build of the lists finds may need more room.
// On a CPU rows of lists that are filled anew may take more, now and then.
TEST(StepWaits, NoStepBetweenTwoBuildsTakesMemory) {
  Simulation simulation(dam());
  simulation.step();  // makes the solver's arrays
  const std::int64_t start = simulation.particles();
  std::int64_t between = 0, taken = 0;
  for (int k = 0; k < 150; ++k) {
    const std::int64_t builds = simulation.list_builds();
    const DeviceCounts c = counts_of_step(simulation);
    if (simulation.list_builds() > builds) continue;
    taken += c.allocations;
    ++between;
  }
  EXPECT_LE(taken, slice_width == 1 ? between / 20 : 0);
  EXPECT_GT(between, 15);
  EXPECT_LT(simulation.particles(), start) << "nothing left";
}

TEST(StepWaits, OnceInAStepAtRest) { expect_one_wait_and_one_launch_a_step(quiet_steps(tank(oil()), 12)); }

TEST(StepWaits, OnceInAStepOfTwoDimensions) {
  expect_one_wait_and_one_launch_a_step(quiet_steps(flat_tank(oil()), 12));
}

TEST(StepWaits, OnceInAStepOfARunThatWentOn) {
  SimulationSetup s = dam();
  s.limits.interval = 1000000;
  Simulation first(s), second(s);
  for (int k = 0; k < 5; ++k) first.step();
  second.restore(first.save());
  expect_one_wait_and_one_launch_a_step(quiet_steps(second, 12));
}

TEST(StepWaits, OnceMoreWhenTheWatchLooks) {
  SimulationSetup s = tank(oil());
  s.limits.interval = 1;
  Simulation simulation(s);
  EXPECT_EQ(quiet_steps(simulation, 8).most_waits, 2);
}

std::int64_t waits_of_totals(const SimulationSetup& setup) {
  Simulation simulation(setup);
  for (int k = 0; k < 3; ++k) simulation.step();
  simulation.totals();  // takes its memory
  const std::int64_t before = simulation.device_counts().waits;
  simulation.totals();
  return simulation.device_counts().waits - before;
}

TEST(StepWaits, OnceForALineOfTheHistory) {
  EXPECT_EQ(waits_of_totals(dam()), 1);
  EXPECT_EQ(waits_of_totals(moving_dam()), 1);
}

TEST(StepWaits, OnceForALineOfTheHistoryWithManyMeasures) {
  SimulationSetup s = moving_dam();
  s.planes = {{0, 1, 0.06}, {1, 1, 0.01}};
  s.boxes = {{{0, 0, 0}, {0.05, 0.05, 0.05}}};
  s.rectangles = {{{0.07, 0, 0.02}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.1, 0.1}};
  s.contacts = {0, 1};
  s.site_area.assign(s.walls.position.size(), dx * dx);
  EXPECT_EQ(waits_of_totals(s), 1);
}

// There are places for so many numbers only.
TEST(StepWaits, ALineWithHundredsOfBoxesWaitsMoreOften) {
  SimulationSetup s = dam();
  for (int k = 0; k < 600; ++k) s.boxes.push_back({{-1, -1, -1}, {0.001 * k, 1, 1}});
  EXPECT_EQ(waits_of_totals(s), 2);
  Simulation all(s);
  const Totals t = all.totals();
  for (const std::size_t k : {0, 20, 50, 300, 520, 599}) {
    s.boxes = {{{-1, -1, -1}, {0.001 * static_cast<double>(k), 1, 1}}};
    EXPECT_EQ(t.boxes[k], Simulation(s).totals().boxes[0]);
  }
  EXPECT_EQ(t.boxes[599], t.particles);
}

// For its first four iterations, for each two with multigrid, and for what it moved.
TEST(StepWaits, AStiffStepWaitsForItsIterationsOnly) {
  SimulationSetup s = dam();
  s.fluids[1].rheology.parameters[0] = 30;
  s.numerics.tolerance = 1e-4;
  s.limits.interval = 1000000;
  Simulation simulation(s);
  simulation.step();
  int stiff = 0;
  for (int k = 0; k < 12; ++k) {
    const std::int64_t builds = simulation.list_builds();
    const DeviceCounts c = counts_of_step(simulation);
    const int by_levels = simulation.last_solve().iterations - 4;
    if (simulation.list_builds() > builds || by_levels <= 0) continue;
    EXPECT_EQ(c.waits, 2 + (by_levels + 1) / 2) << by_levels;
    ++stiff;
  }
  EXPECT_GT(stiff, 3);
}

// Moving walls are placed, and their lists judged, from the host; the step itself is one graph all the same.
TEST(StepWaits, MovingWallsLeaveTheStepOneGraph) {
  const Quiet quiet = quiet_steps(moving_dam(), 10);
  EXPECT_GT(quiet.steps, 3);
  expect_one_graph_a_step(quiet);
}

// A step that is tried again starts with a graph and goes on launch by launch; the next one is a graph again.
TEST(StepWaits, ARetriedStepIsOneGraphAndMore) {
  SimulationSetup s = dam();
  s.numerics.solver = ViscousSolver::conjugate_gradient;
  Simulation smooth(s);
  smooth.step();
  s.numerics.max_iterations = smooth.last_solve().iterations / 2;
  Simulation simulation(s);
  const DeviceCounts first = counts_of_step(simulation), second = counts_of_step(simulation);
  EXPECT_GE(simulation.solver_totals().retried, 1);
  EXPECT_EQ(first.graph_launches, on_gpu() ? 1 : 0);
  EXPECT_EQ(second.graph_launches, on_gpu() ? 1 : 0);
  if (on_gpu()) {
    EXPECT_GT(first.launches, 10);
  }
}

void expect_the_same_bits(Simulation& one, Simulation& other) {
  const SavedState a = one.save(), b = other.save();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].bytes, b[k].bytes) << a[k].name;
}

// A graph must not hold a number or a place of an earlier step.
TEST(StepWaits, AGraphComputesTheBitsOfSingleLaunches) {
  SimulationSetup all = moving_dam(), weightless = dam();
  all.fluids[0].surface_tension = 2, all.numerics.shifting = 0.5;
  all.bodies[1].motion.remove_at = 0.003;
  weightless.gravity = {}, weightless.numerics.viscous_step = ViscousStepping::explicit_step;
  constexpr int steps = 9;
  for (SimulationSetup setup : {all, weightless}) {
    Simulation graphs(setup);
    setup.time_parts = true;
    Simulation single(setup);
    for (int k = 0; k < steps; ++k) {
      graphs.step(), single.step();
      FluidSnapshot snapshot;
      if (k == 4) graphs.read(snapshot), graphs.totals();
    }
    expect_the_same_bits(graphs, single);
    EXPECT_EQ(single.device_counts().graph_launches, 0);
    EXPECT_EQ(graphs.device_counts().graph_launches, on_gpu() ? steps : 0);
  }
}

// Particles come in and go, and all are sorted time and again: what was recorded once serves.
TEST(StepWaits, FlowThroughAChannelIsRecordedOnceInAHundredSteps) {
  SimulationSetup setup = fed_channel();
  setup.gravity = {0.2, 0, 0}, setup.inlets[0].rate = steady(1.5);
  Simulation graphs(setup);
  setup.time_parts = true;
  Simulation single(setup);
  constexpr int filling = 60, steps = 100;
  for (int k = 0; k < filling; ++k) graphs.step(), single.step();
  const std::int64_t builds = graphs.list_builds(), removed = graphs.totals().removed[0];
  const DeviceCounts before = graphs.device_counts();
  for (int k = 0; k < steps; ++k) graphs.step(), single.step();
  expect_the_same_bits(graphs, single);
  EXPECT_GT(graphs.list_builds(), builds + 10);
  EXPECT_GT(graphs.totals().removed[0], removed + 30);
  const DeviceCounts after = graphs.device_counts();
  EXPECT_EQ(after.graph_launches - before.graph_launches, on_gpu() ? steps : 0);
  EXPECT_LE(after.graph_recordings - before.graph_recordings, steps / 100);
  EXPECT_EQ(after.graph_recordings > 0, on_gpu());
}

}  // namespace
}  // namespace slagflow
