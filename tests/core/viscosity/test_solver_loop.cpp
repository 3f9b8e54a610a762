// Iterations that repeat until they end, against batches that the host looks after: the same bits, the same
// counts and the same end where there is no solution.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "core/graph_loops.hpp"
#include "core/simulation_setups.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;
using testing::HasSubstr;

SimulationSetup with_solver(SimulationSetup s, ViscousSolver solver, double tolerance) {
  s.numerics.solver = solver, s.numerics.tolerance = tolerance;
  s.limits.interval = 1000000;  // the watch reads on its own
  return s;
}

// The host repeats them where graphs cannot.
SimulationSetup looping(SimulationSetup s) {
  s.numerics.solver_loop = SolverLoop::conditional;
  s.time_parts = !records_loops();
  return s;
}

std::string error_of(const SimulationSetup& setup, int steps) {
  try {
    Simulation simulation(setup);
    for (int k = 0; k < steps; ++k) simulation.step();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class SolverLoop : public testing::Test {
 protected:
  void SetUp() override {
    if (!missing_for_loops().empty()) GTEST_SKIP() << "needs " << missing_for_loops();
  }
};

void expect_same_solves(const SimulationSetup& setup, int steps, int least_iterations) {
  Simulation batch(setup), loop(looping(setup));
  for (int k = 0; k < steps; ++k) {
    batch.step(), loop.step();
    const SolveReport a = batch.last_solve(), b = loop.last_solve();
    EXPECT_EQ(a.iterations, b.iterations) << k;
    EXPECT_EQ(a.residual, b.residual) << k;
    EXPECT_EQ(a.velocity_error, b.velocity_error) << k;
  }
  const SolverTotals a = batch.solver_totals(), b = loop.solver_totals();
  EXPECT_GE(a.max_iterations, least_iterations);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.retried, b.retried);
  EXPECT_EQ(batch.time(), loop.time());
  const SavedState kept = batch.save(), other = loop.save();
  ASSERT_EQ(kept.size(), other.size());
  for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(kept[k].bytes, other[k].bytes) << kept[k].name;
}

TEST_F(SolverLoop, GivesTheBitsOfBatchesWithConjugateGradients) {
  constexpr int more_than_two_batches = 9, restarts_likely = 20;
  expect_same_solves(with_solver(dam(), ViscousSolver::conjugate_gradient, 1e-2), 12, 0);
  expect_same_solves(with_solver(dam(), ViscousSolver::conjugate_gradient, 1e-4), 9, more_than_two_batches);
  expect_same_solves(with_solver(moving_dam(), ViscousSolver::conjugate_gradient, 1e-6), 6, restarts_likely);
}

TEST_F(SolverLoop, GivesTheBitsOfBatchesWithMultigrid) {
  constexpr int by_diagonal = 4;
  expect_same_solves(with_solver(dam(), ViscousSolver::multigrid, 1e-2), 12, 0);
  expect_same_solves(with_solver(dam(), ViscousSolver::multigrid, 1e-5), 9, by_diagonal + 3);
  expect_same_solves(with_solver(flat_tank(slag()), ViscousSolver::multigrid, 1e-6), 9, by_diagonal + 1);
}

TEST_F(SolverLoop, ASolveThatEndsAtTheMostIterationsIsRetriedTheSameWay) {
  SimulationSetup setup = with_solver(dam(), ViscousSolver::conjugate_gradient, 1e-2);
  Simulation smooth(setup);
  smooth.step();
  setup.numerics.max_iterations = smooth.last_solve().iterations / 2;
  expect_same_solves(setup, 3, setup.numerics.max_iterations);
  Simulation loop(looping(setup));
  loop.step();
  EXPECT_GE(loop.solver_totals().retried, 1);
}

TEST_F(SolverLoop, EndsWithTheSameReason) {
  for (const ViscousSolver solver : {ViscousSolver::conjugate_gradient, ViscousSolver::multigrid}) {
    SimulationSetup hard = with_solver(dam(), solver, 1e-6);
    hard.numerics.max_iterations = 5;
    EXPECT_THAT(error_of(looping(hard), 3), HasSubstr("did not converge"));
    EXPECT_EQ(error_of(looping(hard), 3), error_of(hard, 3));
    SimulationSetup broken = with_solver(dam(), solver, 1e-2);
    broken.particles.velocity[57].z = std::nan("");
    EXPECT_THAT(error_of(looping(broken), 5), HasSubstr("not a number"));
    EXPECT_EQ(error_of(looping(broken), 5), error_of(broken, 5));
  }
}

// However many iterations it takes.
void expect_one_graph_a_step(ViscousSolver solver) {
  SimulationSetup stiff = with_solver(dam(), solver, 1e-4);
  stiff.fluids[1].rheology.parameters[0] = 30;
  Simulation simulation(looping(stiff));
  simulation.step();
  int beyond_a_batch = 0;
  for (int k = 0; k < 12; ++k) {
    const DeviceCounts before = simulation.device_counts();
    const std::int64_t builds = simulation.list_builds();
    simulation.step();
    if (simulation.list_builds() > builds) continue;
    const DeviceCounts after = simulation.device_counts();
    if (simulation.last_solve().iterations > 4) ++beyond_a_batch;
    EXPECT_EQ(after.waits - before.waits, 1);
    EXPECT_EQ(after.launches, before.launches);
    EXPECT_EQ(after.graph_launches - before.graph_launches, on_gpu() ? 1 : 0);
  }
  EXPECT_GT(beyond_a_batch, 3);
}

TEST_F(SolverLoop, ASolveByConjugateGradientsIsPartOfTheOneGraphOfAStep) {
  if (!records_loops()) GTEST_SKIP() << "on a GPU, with SLAGFLOW_GRAPH_LOOPS=1";
  expect_one_graph_a_step(ViscousSolver::conjugate_gradient);
}

TEST_F(SolverLoop, ASolveByMultigridIsPartOfTheOneGraphOfAStep) {
  if (!records_loops()) GTEST_SKIP() << "on a GPU, with SLAGFLOW_GRAPH_LOOPS=1";
  expect_one_graph_a_step(ViscousSolver::multigrid);
}

TEST_F(SolverLoop, IsRefusedWhereItIsNotTheDeviceThatDecides) {
  const auto refused = [](const std::function<void(NumericsSetup&)>& change) {
    SimulationSetup s = looping(dam());
    change(s.numerics);
    return error_of(s, 0);
  };
  EXPECT_EQ(refused([](NumericsSetup&) {}), "no error");
  for (const std::string& message :
       {refused([](NumericsSetup& n) { n.solver = ViscousSolver::sor; }),
        refused([](NumericsSetup& n) { n.solver = ViscousSolver::jacobi; }),
        refused([](NumericsSetup& n) { n.viscous_step = ViscousStepping::explicit_step; }),
        refused([](NumericsSetup& n) { n.yield = YieldModel::exact; })}) {
    EXPECT_THAT(message, HasSubstr("numerics.solver_loop: value \"conditional\" with"));
    EXPECT_THAT(message, HasSubstr("allowed: \"batch\""));
  }
}

TEST(DeviceLoops, NeedAToolkitAndADriverWithConditionalNodes) {
  EXPECT_EQ(missing_for_loops(12040, 12040), "");
  EXPECT_EQ(missing_for_loops(13000, 13020), "");
  EXPECT_EQ(missing_for_loops(12030, 13000), "CUDA 12.4 or newer; this program was built with CUDA 12.3");
  EXPECT_EQ(missing_for_loops(13000, 12020), "a driver for CUDA 12.4 or newer; this one is for CUDA 12.2");
}

}  // namespace
}  // namespace slagflow
