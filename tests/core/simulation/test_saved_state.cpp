// What a checkpoint holds of a simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "core/simulation_setups.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

SimulationSetup with_everything() {
  SimulationSetup s = moving_dam();
  s.planes.push_back({0, 1, 0.05});
  s.fluids[0].surface_tension = 2;
  return s;
}

SimulationSetup exact() {
  SimulationSetup s = dam();
  s.numerics.yield = YieldModel::exact;
  return s;
}

SavedState saved_after(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step();
  return simulation.save();
}

SavedArray& array_of(SavedState& state, const std::string& name) {
  return *std::find_if(state.begin(), state.end(), [&](const SavedArray& a) { return a.name == name; });
}

void set_number(SavedState& state, std::size_t place, double value) {
  std::memcpy(array_of(state, "numbers").bytes.data() + place * sizeof value, &value, sizeof value);
}

std::string message_of_restoring(const SavedState& state) {
  Simulation simulation(dam());
  try {
    simulation.restore(state);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SavedState, IsTheSameAfterItWasRestored) {
  for (const SimulationSetup& setup : {with_everything(), exact()}) {
    Simulation first(setup), second(setup);
    const SavedState saved = saved_after(first, 15);
    second.restore(saved);
    const SavedState again = second.save();
    ASSERT_EQ(saved.size(), again.size());
    for (std::size_t k = 0; k < saved.size(); ++k) {
      EXPECT_EQ(saved[k].name, again[k].name);
      EXPECT_EQ(saved[k].bytes, again[k].bytes) << saved[k].name;
    }
  }
}

// Two threads put the rows of neighbour lists, and the yield stresses of pairs with them, wherever there is
// room at the moment.
TEST(SavedState, AndWhatFollowsAreTheSameWithTwoThreads) {
  if (device_info().backend == "cuda") GTEST_SKIP() << "threads are of the CPU build";
  const int before = device_info().threads;
  set_threads(1);
  Simulation alone(exact());
  const SavedState saved = saved_after(alone, 15), later = saved_after(alone, 10);
  set_threads(2);
  for (int again = 0; again < 20; ++again) {
    Simulation shared(exact()), resumed(exact());
    resumed.restore(saved);
    const SavedState first = saved_after(shared, 15), second = saved_after(resumed, 10);
    for (std::size_t k = 0; k < saved.size(); ++k) {
      EXPECT_EQ(saved[k].bytes, first[k].bytes) << saved[k].name;
      EXPECT_EQ(later[k].bytes, second[k].bytes) << later[k].name;
    }
  }
  set_threads(before);
}

// Of particles that have moved on to other planes of cells, or left.
TEST(SavedState, SumsAfterItAreThoseOfTheUnbrokenRun) {
  Simulation unbroken(dam()), resumed(dam());
  SavedState start = unbroken.save();
  SavedState saved = saved_after(unbroken, 80);
  EXPECT_LT(array_of(saved, "id").bytes.size(), array_of(start, "id").bytes.size())
      << "nothing left: little is tested";
  resumed.restore(saved);
  const SavedState wanted = saved_after(unbroken, 5), found = saved_after(resumed, 5);
  for (std::size_t k = 0; k < wanted.size(); ++k)
    EXPECT_EQ(found[k].bytes, wanted[k].bytes) << wanted[k].name;
}

TEST(SavedState, HasNamesOfTheirOwnForAllArrays) {
  for (const SimulationSetup& setup : {with_everything(), exact()}) {
    Simulation simulation(setup);
    std::vector<std::string> names;
    for (const SavedArray& array : saved_after(simulation, 1)) names.push_back(array.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  }
}

TEST(SavedState, WithTooFewOrTooManyNumbersIsRefused) {
  Simulation simulation(dam());
  SavedState state = saved_after(simulation, 2);
  std::vector<std::byte>& numbers = array_of(state, "numbers").bytes;
  numbers.resize(numbers.size() - sizeof(double));
  EXPECT_THAT(message_of_restoring(state), testing::HasSubstr("do not belong to this case"));
  numbers.resize(numbers.size() + 2 * sizeof(double));
  EXPECT_THAT(message_of_restoring(state), testing::HasSubstr("do not belong to this case"));
}

TEST(SavedState, WithACountThatNoIntegerHoldsIsRefused) {
  constexpr std::size_t steps = 11;  // its place among the numbers
  Simulation simulation(dam());
  SavedState state = saved_after(simulation, 2);
  double held = 0;
  std::memcpy(&held, array_of(state, "numbers").bytes.data() + steps * sizeof held, sizeof held);
  ASSERT_EQ(held, 2);
  for (const double count : {1e300, -1e300, std::numeric_limits<double>::quiet_NaN(), -1.0}) {
    set_number(state, steps, count);
    EXPECT_THAT(message_of_restoring(state), testing::HasSubstr("not those of a run")) << count;
  }
}

}  // namespace
}  // namespace slagflow
