// What `slagflow check` tells of the start, the machine, and what to change.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "host/run/advice.hpp"
#include "host/run/check.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;
using testing_tools::TempFolder;

// Two boxes of fluid, of 6 and of 12 by 20 particles of 10 mm, on a plate of a given thickness.
BuiltCase two_boxes(const std::string& plate = "-0.05", const std::vector<std::string>& set = {}) {
  return build_setup(parse_case(R"([case]
name = "boxes"
[resolution]
spacing = 0.01
dimensions = 2
[fluid.slag]
density = 2000
rheology = "newtonian"
dynamic_viscosity = 2
surface_tension = 0.5
[[region]]
shapes = [{shape="box", min=[0, -1, 0], max=[0.06, 1, 0.2]}, {shape="box", min=[0.2, -1, 0], max=[0.32, 1, 0.2]}]
[[wall]]
name = "plate"
shapes = [{shape="box", min=[-1, -1, )" +
                                    plate +
                                    R"(], max=[2, 1, 0]}]
[domain]
min = [-0.1, -1, -0.1]
max = [0.5, 1, 0.4]
[output]
end_time = 1
interval = 0.1
)",
                                "boxes.toml", set));
}

TEST(Check, TellsPiecesAndHowManyParticlesAreAcross) {
  const CaseCheck check = check_case(two_boxes());
  ASSERT_EQ(check.pieces.size(), 2U);
  EXPECT_EQ(check.pieces[0].particles, 240U);
  EXPECT_EQ(check.pieces[0].across, 12);
  EXPECT_EQ(check.pieces[1].across, 6);
  EXPECT_EQ(check.fluid_across, 6);
  EXPECT_EQ(check.wall.name, "plate");
  EXPECT_NEAR(check.wall.across, 5, 0.01);
  EXPECT_NEAR(std::abs(check.wall.place.z + 0.025), 0.025, 1e-9);  // on either side of it
  const std::string text = to_text(check);
  EXPECT_THAT(text, HasSubstr("2 pieces that do not touch at the start, 6 particles across the thinnest"));
  EXPECT_THAT(text, HasSubstr("walls            'plate' is thinnest, 5 spacings at ("));
  EXPECT_THAT(text, HasSubstr("domain           (-0.1, -0.005, -0.1) to (0.5, 0.005, 0.4) m"));
}

TEST(Check, TellsFroudeAndCapillaryNumber) {
  const CaseCheck check = check_case(two_boxes());
  const double speed = std::sqrt(2 * 9.81 * 0.2);
  EXPECT_NEAR(check.froude, speed / std::sqrt(9.81 * 0.2), 1e-6);
  EXPECT_NEAR(check.fluids[0].capillary, 2 * speed / 0.5, 1e-6);
}

TEST(Check, TellsTheSizeOfItsFiles) {
  const CaseCheck check = check_case(two_boxes());
  EXPECT_EQ(check.snapshots, 11);
  EXPECT_NEAR(check.output, 11 * 70.0 * 360 + 29.0 * static_cast<double>(check.wall_particles), 1e-6);
}

TEST(Check, RunTimeGoesByTheSpeedOfTheMachine) {
  const BuiltCase built = two_boxes();
  const CaseCheck check = check_case(built, {1e6, "2026-01-02T03:04:05Z", false});
  EXPECT_NEAR(check.run_time, check.steps * 360 / 1e6, 1e-9);
  EXPECT_THAT(to_text(check),
              HasSubstr("on this machine: 1e+06 particle-steps/s, measured 2026-01-02T03:04:05Z"));
  EXPECT_THAT(to_text(check), HasSubstr("on an H100: a model figure, not measured"));
  EXPECT_THAT(to_text(check_case(built)), HasSubstr("not measured on this machine"));
  EXPECT_THAT(to_json(check).text(), HasSubstr("\"gpu_model_run_time\""));
}

TEST(Advice, OfFluidThatIsTooCoarse) {
  // 6 across: 10 at 6 mm, in two dimensions (10/6)^3 times as long.
  EXPECT_THAT(
      check_case(two_boxes()).advice,
      Contains("resolution.spacing = 0.006: 4.63 times the run time, 10 particles across the thinnest "
               "fluid, which has 6"));
  EXPECT_THAT(to_text(check_case(two_boxes())), HasSubstr("advice: resolution.spacing = 0.006: "));
  const std::vector<std::string> finer{"resolution.spacing=0.005"};
  EXPECT_THAT(check_case(two_boxes("-0.05", finer)).advice, testing::IsEmpty());
}

TEST(Advice, OfThinWalls) {
  const CaseCheck check = check_case(two_boxes("-0.02"));
  EXPECT_NEAR(check.wall.across, 2, 0.01);
  EXPECT_THAT(check.advice, Contains(StartsWith("wall 'plate': 0.01 m more at (")));
  EXPECT_THAT(check.advice, Contains(HasSubstr("or resolution.spacing = 0.0066")));
}

TEST(Advice, OfRunsThatTakeLong) {
  const std::vector<std::string> finer{"resolution.spacing=0.0025"};
  const CaseCheck slow = check_case(two_boxes("-0.05", finer), {100, "", false});
  EXPECT_THAT(slow.advice, Contains(StartsWith("resolution.spacing = 0.006: 1/13.8 of the run time")));
  EXPECT_THAT(slow.advice, Contains(StartsWith("output.end_time = ")));
  const CaseCheck fast = check_case(two_boxes("-0.05", finer), {1e9, "", false});
  EXPECT_THAT(fast.advice, testing::IsEmpty());
}

TEST(Advice, OfFilesThatAreLarge) {
  const std::vector<std::string> many{"output.interval=1e-6", "output.end_time=0.9",
                                      "resolution.spacing=0.005"};
  const CaseCheck check = check_case(two_boxes("-0.05", many));
  EXPECT_GT(check.output, 5e9);
  EXPECT_THAT(check.advice, Contains(StartsWith("output.interval = ")));
}

// In a cache of its own.
TEST(MachineSpeed, IsTimedOnceAndKept) {
  const TempFolder folder;
  const char* const name = "XDG_CACHE_HOME";
  const char* const before = std::getenv(name);
  const std::string kept = before != nullptr ? before : "";
  setenv(name, (folder / "cache").c_str(), 1);
  const MachineSpeed first = machine_speed(2), second = machine_speed(2);
  EXPECT_TRUE(first.now);
  EXPECT_GT(first.particle_steps, 1e3);
  EXPECT_FALSE(second.now);
  EXPECT_EQ(second.made, first.made);
  EXPECT_NEAR(second.particle_steps, first.particle_steps, 1e-4 * first.particle_steps);
  EXPECT_TRUE(machine_speed(2, true).now);
  EXPECT_TRUE(machine_speed(3).now);   // of its own
  EXPECT_FALSE(machine_speed(2).now);  // still there
  setenv(name, "/dev/null", 1);        // nothing can be kept
  EXPECT_GT(machine_speed(2).particle_steps, 1e3);
  before != nullptr ? setenv(name, kept.c_str(), 1) : unsetenv(name);
}

// The table of tests/bench/README.md.
TEST(ModelledGpuStep, IsThatOfTheTable) {
  for (const auto& [particles, step] : {std::pair{12500.0, 0.109e-3}, std::pair{102000.0, 0.383e-3},
                                        std::pair{1e6, 3.4e-3}, std::pair{1e7, 33.7e-3}})
    EXPECT_NEAR(modelled_gpu_step(particles), step, 0.1 * step);
}

}  // namespace
}  // namespace slagflow
