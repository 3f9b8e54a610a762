// Snapshots that arrive while steps go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "backend/buffer.hpp"
#include "backend/error.hpp"
#include "backend/side_copy.hpp"
#include "core/simulation_setups.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

struct Both {
  FluidSnapshot fluid;
  WallSnapshot walls;
};

Both read(Simulation& simulation) {
  Both both;
  simulation.read(both.fluid, both.walls);
  return both;
}

Both finish(StateTransfer& transfer) {
  Both both;
  transfer.finish(both.fluid, both.walls);
  EXPECT_FALSE(transfer.under_way());
  return both;
}

template <class T>
void expect_same_values(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  if (!a.empty()) {
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0);
  }
}

void expect_same(const Both& a, const Both& b) {
  EXPECT_EQ(a.fluid.time, b.fluid.time);
  expect_same_values(a.fluid.position, b.fluid.position),
      expect_same_values(a.fluid.velocity, b.fluid.velocity);
  expect_same_values(a.fluid.pressure, b.fluid.pressure),
      expect_same_values(a.fluid.density, b.fluid.density);
  expect_same_values(a.fluid.viscosity, b.fluid.viscosity);
  expect_same_values(a.fluid.shear_rate, b.fluid.shear_rate);
  expect_same_values(a.fluid.shear_stress, b.fluid.shear_stress);
  expect_same_values(a.fluid.thickness, b.fluid.thickness);
  expect_same_values(a.fluid.yielded, b.fluid.yielded), expect_same_values(a.fluid.fluid, b.fluid.fluid);
  expect_same_values(a.fluid.id, b.fluid.id);
  EXPECT_EQ(a.walls.time, b.walls.time);
  EXPECT_EQ(a.walls.moves, b.walls.moves);
  expect_same_values(a.walls.position, b.walls.position),
      expect_same_values(a.walls.pressure, b.walls.pressure);
  expect_same_values(a.walls.body, b.walls.body);
}

void advance(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step();
}

// The wall that moves vanishes on the way.
TEST(StateTransfer, GivesWhatWasThereWhenItBegan) {
  SimulationSetup s = moving_dam();
  s.bodies[1].motion.remove_at = 0.008;
  Simulation simulation(s);
  StateTransfer one, two;
  advance(simulation, 3);
  const Both first = read(simulation);
  simulation.start_reading(one, Reading::fluid_and_walls);
  EXPECT_TRUE(one.under_way());
  advance(simulation, 12);
  const Both second = read(simulation);
  simulation.start_reading(two, Reading::fluid_and_walls);
  Both other;
  std::thread writer([&] { other = finish(one); });
  advance(simulation, 3);
  writer.join();
  expect_same(other, first);
  expect_same(finish(two), second);
  EXPECT_LT(second.walls.position.size(), first.walls.position.size());
}

// Two on their way at a time, and steps between that take no memory; a twin tells what should arrive.
TEST(StateTransfer, OneDoesNotDisturbAnother) {
  Simulation simulation(dam()), twin(dam());
  StateTransfer transfers[2];
  advance(simulation, 3), advance(twin, 3);
  simulation.start_reading(transfers[0], Reading::fluid_and_walls);
  Both expected = read(twin);
  for (int k = 0; k < 8; ++k) {
    simulation.step(), twin.step();
    simulation.start_reading(transfers[(k + 1) % 2], Reading::fluid_and_walls);
    expect_same(finish(transfers[k % 2]), expected);
    expected = read(twin);
  }
  expect_same(finish(transfers[0]), expected);
}

TEST(StateTransfer, LeavesTheWallsWhereOnlyTheFluidIsRead) {
  Simulation simulation(dam());
  StateTransfer transfer;
  simulation.start_reading(transfer, Reading::fluid);
  const Both both = finish(transfer);
  EXPECT_EQ(both.fluid.id.size(), dam().particles.position.size());
  EXPECT_TRUE(both.walls.position.empty());
}

// Neither does the host wait when a transfer begins, nor a step while it is under way.
TEST(StateTransfer, MakesNobodyWait) {
  for (const YieldModel yield : {YieldModel::regularised, YieldModel::exact}) {
    SimulationSetup s = dam();
    s.limits.interval = 1000000;  // the watch reads on its own
    s.numerics.yield = yield;
    Simulation simulation(s);
    StateTransfer one, two;
    advance(simulation, 3);
    simulation.start_reading(one, Reading::fluid_and_walls);  // takes the memory, which waits
    finish(one);
    const std::int64_t before = simulation.device_counts().waits;
    simulation.start_reading(one, Reading::fluid_and_walls);
    simulation.start_reading(two, Reading::fluid);
    EXPECT_EQ(simulation.device_counts().waits, before);
    if (yield == YieldModel::exact) continue;  // its steps wait many times
    std::int64_t least = 1000;
    for (int k = 0; k < 4; ++k) {
      const std::int64_t already = simulation.device_counts().waits;
      simulation.step();
      least = std::min(least, simulation.device_counts().waits - already);
    }
    EXPECT_EQ(least, 1);
  }
}

// A CPU build takes memory like any other program.
TEST(StateTransfer, SaysWhatDoesNotFitOnTheDeviceAndGoesOn) {
  if (device_info().backend != "cuda") GTEST_SKIP() << "of a GPU";
  Context context;
  SideStream side(context);
  SideCopy copy;
  const Buffer<char> some(context, "some", 10);
  try {
    copy.start(side, {{some.span().data, std::size_t(1) << 60}});
    ADD_FAILURE() << "it fits";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("the copy that a snapshot is read from needs 11529215046068"));
  }
  EXPECT_EQ(context.allocated(), 10U);
  context.synchronize();
  copy.start(side, {{some.span().data, 10}});
  copy.wait();
}

// 16 B of motion and of state, 24 B of position, 4 B of pressure, shear rate, stress, thickness and id, and
// two bytes. One of the bytes, and the thickness, which is found by way of another array, are there for the
// copy alone.
TEST(StateTransfer, CountsItsMemoryOnTheDevice) {
  Simulation simulation(dam());
  const std::size_t before = simulation.device_bytes(), n = dam().particles.position.size();
  StateTransfer one, two;
  simulation.start_reading(one, Reading::fluid);
  simulation.start_reading(two, Reading::fluid);
  const std::size_t taken = simulation.device_bytes() - before;
  constexpr std::size_t made = 1 + 2 * sizeof(Real),
                        copy = 24 + 4 * sizeof(Real) * 2 + 4 * sizeof(Real) + 4 + 2, aligning = 10 * 256;
  if (device_info().backend == "cuda") {
    EXPECT_GE(taken, n * (copy + made));
    EXPECT_LE(taken, n * (copy + made) + aligning);
  } else {
    EXPECT_EQ(taken, n * made);
  }
}

}  // namespace
}  // namespace slagflow
