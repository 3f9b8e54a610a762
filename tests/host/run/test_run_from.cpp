// New runs that begin in a state of another one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "backend/error.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/output/snapshot_reader.hpp"
#include "host/run/run.hpp"
#include "host/run/start_state.hpp"
#include "host/same_results.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_tools::expect_same_results;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

class RunFrom : public testing::Test {
 protected:
  RunFrom() {
    std::ofstream(folder_ / "tiny.toml") << tiny_case("0.012");
    RunOptions o = options("old");
    o.until = 0.006;
    EXPECT_EQ(run_case(load_case(folder_ / "tiny.toml"), o).exit_code(), 0);
  }

  RunOptions options(const std::string& name) const {
    RunOptions o;
    o.folder = folder_ / name, o.threads = 1, o.verbosity = Verbosity::quiet;
    return o;
  }
  RunOutcome from(const std::string& what, const std::vector<std::string>& sets,
                  const std::string& name = "new") const {
    return run_from({folder_ / what, "", sets}, options(name));
  }
  std::string refusal(const std::string& what, const std::vector<std::string>& sets) const {
    try {
      from(what, sets);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string file(const std::string& name) const { return read_text_file(folder_ / name); }
  FluidSnapshot last_snapshot(const std::string& name) const {
    const std::string path = folder_ / name + "/particles.vtkhdf";
    return read_snapshot(path, list_snapshots(path).times.size() - 1);
  }

  const TempFolder folder_;
  const std::vector<std::string> on_{"output.end_time=0.012"};
};

double largest_distance(const FluidSnapshot& a, const FluidSnapshot& b) {
  double largest = 0;
  EXPECT_EQ(a.id, b.id);
  for (std::size_t i = 0; i < a.id.size() && i < b.id.size(); ++i)
    largest = std::max(largest, norm(a.position[i] - b.position[i]));
  return largest;
}

// To the rounding of another order of the pairs, and the tolerance of solves with another first guess.
TEST_F(RunFrom, WithTheSameKeysGivesTheFlowOfTheRunThatGoesOn) {
  EXPECT_EQ(from("old", on_).exit_code(), 0);
  EXPECT_EQ(resume_run([&] {
              RunOptions o = options("old");
              o.changes = on_;
              return o;
            }())
                .exit_code(),
            0);
  const FluidSnapshot old = last_snapshot("old"), now = last_snapshot("new");
  EXPECT_EQ(old.time, now.time);
  EXPECT_LT(largest_distance(old, now), 2e-3 * 2e-3);  // of a spacing
}

TEST_F(RunFrom, SaysWhereItBeganAndWhatDiffers) {
  EXPECT_EQ(from("old", {on_[0], "fluid.oil.yield_stress=8", "gravity.acceleration=[1,0,-9.81]"}).exit_code(),
            0);
  const std::string summary = file("new/summary.json");
  EXPECT_THAT(summary, AllOf(HasSubstr("\"from\": {"), HasSubstr("\"folder\": \""),
                             HasSubstr("\"file\": \"checkpoint.h5\""),
                             HasSubstr("fluid.oil.yield_stress 5.0 -> 8.0"), HasSubstr("\"step\": ")));
  const Checkpoint end = read_checkpoint(folder_ / "new/checkpoint.h5");
  EXPECT_THAT(end.text("from_folder"), testing::EndsWith("/old"));
  EXPECT_THAT(end.text("from_changes"),
              HasSubstr("gravity.acceleration [0.0, 0.0, -9.81] -> [1.0, 0.0, -9.81]"));
  EXPECT_THAT(file("new/case.toml"), AllOf(HasSubstr("# Began in a state"), HasSubstr("yield_stress = 8.0")));
  EXPECT_THAT(file("new/history.csv"), HasSubstr("\n0.006"));
  EXPECT_THAT(file("new/log.txt"), HasSubstr("starts from checkpoint.h5 of"));
}

TEST_F(RunFrom, GoesOnToTheBitsOfOneThatWasNotBroken) {
  from("old", on_, "whole");
  RunOptions o = options("broken");
  o.until = 0.009;
  run_from({folder_ / "old", "", on_}, o);
  o = options("broken");
  o.until = 0.012;
  EXPECT_EQ(resume_run(o).exit_code(), 0);
  expect_same_results(folder_ / "broken", folder_ / "whole");
  EXPECT_THAT(file("broken/summary.json"), HasSubstr("\"from\": {"));
  std::filesystem::remove(folder_ / "broken/start.h5");
  EXPECT_THROW(resume_run(o), InputError);
}

// That one was told to end at 0.006 s.
TEST_F(RunFrom, EndsWithItsCaseNotWhereTheOtherRunWasToldTo) {
  EXPECT_EQ(from("old", {}).exit_code(), 0);
  EXPECT_THAT(file("new/case.toml"), HasSubstr("until = \"end_time\""));
}

TEST_F(RunFrom, TakesTheNearestStateAndRefusesTimesThatAreNotThere) {
  const StartState newest = find_state(folder_ / "old"), same = find_state((folder_ / "old") + "@0.0062");
  EXPECT_EQ(newest.checkpoint.text("from_file"), "checkpoint.h5");
  EXPECT_EQ(same.checkpoint.text("from_time"), newest.checkpoint.text("from_time"));
  const StartState snapshot = find_state((folder_ / "old") + "@0.0021");
  EXPECT_EQ(snapshot.checkpoint.text("from_file"), "particles.vtkhdf");
  EXPECT_NEAR(snapshot.checkpoint.run.time, 0.002, 5e-4);
  ASSERT_EQ(snapshot.warnings.size(), 1U);
  EXPECT_THAT(snapshot.warnings[0], HasSubstr("starts from a snapshot"));
  EXPECT_THAT(refusal("old@0.5", {}), AllOf(HasSubstr("there is no state"), HasSubstr("checkpoints at 0.006"),
                                            HasSubstr("snapshots at 0, ")));
  EXPECT_THAT(refusal("old@soon", {}), HasSubstr("allowed: DIR@TIME"));
  EXPECT_THAT(refusal("none", {}), HasSubstr("no such folder"));
}

TEST_F(RunFrom, BeginsFromASnapshotWhereNoCheckpointIsLeft) {
  for (const char* name : {"checkpoint.h5", "checkpoint.previous.h5", "case.toml", "history.csv"})
    std::filesystem::remove(folder_ / "old/" + name);
  EXPECT_THAT(refusal("old", on_), AllOf(HasSubstr("holds no checkpoint"), HasSubstr("DIR@TIME")));
  EXPECT_EQ(from("old@0.004", on_).exit_code(), 0);
  EXPECT_THAT(file("new/summary.json"),
              AllOf(HasSubstr("\"file\": \"particles.vtkhdf\""), HasSubstr("\"status\": \"done\"")));
}

TEST_F(RunFrom, KeepsVolumesAndCompressionsOfADenserFluidAndPressuresWithAnotherSound) {
  const StartState start = find_state(folder_ / "old");
  const FluidState before = fluid_state(start.checkpoint.state);
  BuiltCase built = build_setup(parse_case(start.checkpoint.text("case_text"), "old",
                                           {"fluid.oil.density=1930", "numerics.sound_speed=10"}));
  start_from(start, built);
  const FluidMemory &old = before.particles.memory, &now = built.setup.particles.memory;
  for (std::size_t i = 0; i < old.excess.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(now.excess[i]), 0.5 * static_cast<double>(old.excess[i]), 1e-3);  // 2/4
    const double volume =
        static_cast<double>(old.packing[i]) / (1 + static_cast<double>(old.excess[i]) / 965);
    EXPECT_NEAR(static_cast<double>(now.packing[i]) / (1 + static_cast<double>(now.excess[i]) / 1930), volume,
                1e-6);
    EXPECT_EQ(norm(built.setup.particles.position[i] - before.particles.position[i]), 0);
  }
}

// A state may be of a moment when particles had left that were not yet removed.
TEST_F(RunFrom, WhatHasJustLeftMayBeInTheState) {
  const StartState start = find_state(folder_ / "old");
  const auto refused = [&](const std::vector<KeyChange>& changes) -> std::string {
    BuiltCase built =
        build_setup(parse_case(start.checkpoint.text("case_text"), "old", {on_[0], "output.until=0.012"}));
    start_from(start, built);
    built.setup.particles.position[0].x = built.setup.domain.upper.x + 1e-3;
    try {
      require_startable(start, built, changes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refused({}), "none");
  EXPECT_THAT(refused({{"domain.max", "[1, 1, 1]", "[0.5, 1, 1]"}}),
              HasSubstr("1 particles of the state are outside of the domain"));
}

TEST_F(RunFrom, RefusesWhatTheStateCannotHold) {
  EXPECT_THAT(refusal("old", {on_[0], "resolution.spacing=1e-3"}),
              HasSubstr("key 'resolution.spacing': value 0.001: the particles are those"));
  EXPECT_THAT(refusal("old", {on_[0], "region.0.velocity=[1,0,0]"}), HasSubstr("no region is filled"));
  EXPECT_THAT(refusal("old", {on_[0], "domain.max=[0.009,0.015,0.02]"}),
              HasSubstr("particles of the state are outside of the domain"));
  EXPECT_THAT(refusal("old", {on_[0], "wall.0.motion={type=\"constant\", velocity=[0,0,1]}"}),
              HasSubstr("deeper than half a spacing in walls"));
  EXPECT_THAT(refusal("old", {"output.end_time=0.006"}), HasSubstr("key 'output.end_time'"));
  EXPECT_THAT(refusal("old", {"output.end_time=0.005"}), HasSubstr("its clock goes on"));
  std::ofstream(folder_ / "renamed.toml") << [] {
    std::string t = tiny_case("0.012");
    t.replace(t.find("[fluid.oil]"), 11, "[fluid.tar]");
    return t;
  }();
  EXPECT_THROW(run_from({folder_ / "old", folder_ / "renamed.toml", {}}, options("new")), InputError);
  RunOptions o = options("old");
  o.overwrite = Overwrite::replace;
  EXPECT_THROW(run_from({folder_ / "old", "", on_}, o), InputError);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "old/checkpoint.h5"));
}

TEST_F(RunFrom, CountsMassAndWhatPassesFromThereOn) {
  EXPECT_EQ(from("old", {on_[0], "fluid.oil.density=1930", "domain.max=[0.0105,0.015,0.02]"}).exit_code(), 0);
  const std::string summary = file("new/summary.json");
  const auto number = [&](const std::string& key) {
    return std::stod(summary.substr(summary.find("\"" + key + "\": ") + key.size() + 4));
  };
  EXPECT_NEAR(number("mass_start"), 125 * 8e-9 * 1930, 1e-9);
  EXPECT_NEAR(number("mass_in") + number("mass_left"), number("mass_start"), 1e-9);
  EXPECT_EQ(number("balance_error"), 0);
}

}  // namespace
}  // namespace slagflow
