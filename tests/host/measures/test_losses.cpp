// What a run tells of fluid that leaves the domain or is inside walls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/geometry/setup_builder.hpp"
#include "host/measures/losses.hpp"
#include "host/run/run.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing_tools::leaving_case;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

constexpr double spacing = 2e-3;  // of the tiny case, whose floor lies at z = 0

RunOptions into(const TempFolder& folder) {
  RunOptions options;
  options.folder = folder / "run";
  options.verbosity = Verbosity::quiet;
  options.threads = 1;
  return options;
}

Case parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_case(text, "tiny.toml", overrides);
}

TEST(Losses, CountsWhatIsDeeperThanHalfASpacing) {
  const Case c = parsed(tiny_case());
  Losses losses(c);
  losses.look_at({{0, 0, -0.4 * spacing}, {0, 0, 0.001}, {0.004, 0, -0.6 * spacing}, {0, 0, -1.4 * spacing}},
                 0);
  EXPECT_EQ(losses.in_walls().now, 2);
  losses.look_at({Vec3d{0, 0, -0.2 * spacing}}, 0);
  EXPECT_EQ(losses.in_walls().now, 0);
  EXPECT_EQ(losses.in_walls().most, 2);
  EXPECT_NEAR(losses.in_walls().deepest, 1.4, 1e-9);
  EXPECT_THAT(losses.lines({}, 125),
              Contains("deeper than half a spacing in walls: 2 particles at most, 0 at the end; the deepest "
                       "1.40 spacings"));
}

// One of 125 particles is 0.8 %.
TEST(Losses, WarnsOfWallsThatDoNotHold) {
  const Case c = parsed(tiny_case());
  Losses losses(c);
  EXPECT_THAT(losses.warnings({}, 125), IsEmpty());
  EXPECT_THAT(losses.lines({}, 125), Contains(HasSubstr("no particle was deeper than half a spacing")));
  losses.look_at({Vec3d{0, 0, -0.6 * spacing}}, 0);
  EXPECT_THAT(losses.warnings({}, 125), Contains(HasSubstr("1 particle (0.8 %) was deeper")));
  EXPECT_THAT(losses.warnings({}, 1001), IsEmpty());
}

// Particles of a simulation, moved into the floor by hand, as the wall particles see them.
TEST(Losses, FindsInASimulationWhatALookAtAllFinds) {
  const Case c = parsed(tiny_case());
  BuiltCase built = build_setup(c);
  std::vector<Vec3d>& place = built.setup.particles.position;
  place[0] = {0.003, 0.003, -0.7 * spacing}, place[7] = {0.007, 0.0041, -2.2 * spacing};
  place[9] = {0.005, 0.0061, -0.3 * spacing}, place[11] = {-0.0035, 0.001, 0.1 * spacing};
  Simulation simulation(built.setup);
  Losses some(c), all(c);
  some.look(simulation);
  all.look_at_all(simulation);
  for (const Losses* losses : {&some, &all}) {
    EXPECT_EQ(losses->in_walls().now, 2);
    EXPECT_NEAR(losses->in_walls().deepest, 0.8, 1e-5);  // of the second, from the floor's lower side
  }
}

// A floor that rises and turns by 0.04 spacings and 2 degrees a step, with two particles in it from the
// start.
TEST(Losses, FollowAWallThatMoves) {
  const Case c = parsed(tiny_case(), {R"(wall.0.motion={type="constant", velocity=[0, 0, 0.2], )"
                                      R"(angular_velocity=[0, 80, 0], center=[0.005, 0.005, 0]})"});
  BuiltCase built = build_setup(c);
  built.setup.limits.max_compression = 1;
  built.setup.particles.position[0] = {0.003, 0.003, -0.9 * spacing};
  built.setup.particles.position[7] = {0.007, 0.005, -1.2 * spacing};
  Simulation simulation(built.setup);
  Losses some(c), all(c);
  for (int step = 0; step < 8; ++step) {
    some.look(simulation), all.look_at_all(simulation);
    EXPECT_EQ(some.in_walls().now, all.in_walls().now) << step;
    EXPECT_EQ(some.in_walls().deepest, all.in_walls().deepest) << step;
    simulation.step();
  }
  EXPECT_GE(all.in_walls().most, 2);
  const Case still = parsed(tiny_case());
  Losses at_rest(still);
  at_rest.look_at_all(simulation);
  EXPECT_NE(at_rest.in_walls().deepest, all.in_walls().deepest);
}

TEST(Losses, WarnsOfEachFaceThatIsNoExit) {
  const Case c = parsed(tiny_case(), {R"(domain.exits=["-z"])"});
  const Losses losses(c);
  Totals totals;
  totals.departed = {0, 3, 0, 0, 20, 1};
  EXPECT_THAT(
      losses.lines(totals, 2000),
      Contains("24 particles of 2000 (1.2 %) left the domain: 3 through +x, no exit; 20 through -z, an "
               "exit; 1 through +z, no exit"));
  const std::vector<std::string> warnings = losses.warnings(totals, 2000);
  ASSERT_EQ(warnings.size(), 1u);  // one of 2000 is less than 0.1 %
  EXPECT_THAT(warnings[0], HasSubstr("3 particles (0.15 %) left through face +x of the domain"));
  Json summary = Json::object();
  losses.add_to(summary, totals);
  EXPECT_EQ(summary.at("lost_through_other_faces").number(), 4);
}

TEST(Losses, EndOfARunTellsThem) {
  const TempFolder folder;
  const RunOutcome outcome = run_case(parsed(tiny_case()), into(folder));
  EXPECT_THAT(outcome.results, Contains("no particle left the domain"));
  EXPECT_THAT(outcome.results, Contains(HasSubstr("deeper than half a spacing in a wall")));
  const std::string summary = read_text_file(folder / "run/summary.json");
  for (const char* part : {"\"exits\": \"none\"", "\"lost_through_other_faces\": 0", "\"in_walls\": {",
                           "\"most\": 0", "\"at_end\": 0", "\"deepest_spacings\": "})
    EXPECT_THAT(summary, HasSubstr(part));
  EXPECT_THAT(read_text_file(folder / "run/log.txt"), HasSubstr("no particle left the domain"));
}

TEST(Losses, RunWarnsOfAFaceThatIsNoExitOnly) {
  for (const std::string exits : {"[]", R"(["+x"])"}) {
    const TempFolder folder;
    testing::internal::CaptureStderr();
    run_case(parsed(leaving_case("remove"), {"domain.exits=" + exits}), into(folder));
    const std::string shown = testing::internal::GetCapturedStderr();
    const auto warned = HasSubstr("warning: 125 particles (100 %) left through face +x of the domain");
    if (exits == "[]")
      EXPECT_THAT(shown, warned);
    else
      EXPECT_THAT(shown, Not(HasSubstr("left through")));
  }
}

// They pass x = 15 mm after 14 ms at the latest; the case would go on to 1 s.
TEST(Losses, RunEndsWhenAllFluidHasLeft) {
  const TempFolder folder;
  const RunOutcome outcome =
      run_case(parsed(leaving_case("remove"), {"output.end_time=1", R"(domain.exits=["+x"])"}), into(folder));
  EXPECT_EQ(outcome.status, RunStatus::done);
  EXPECT_THAT(outcome.results, Contains(HasSubstr("ended early: all fluid has left the domain")));
  const std::string summary = read_text_file(folder / "run/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"status\": \"done\""));
  EXPECT_THAT(summary, HasSubstr("\"ended_early\": \"all fluid has left the domain"));
  const std::string key = "\"simulated_time\": ";
  const double time = std::stod(summary.substr(summary.find(key) + key.size()));
  EXPECT_GT(time, 0.013);
  EXPECT_LT(time, 0.03);
  EXPECT_THAT(read_text_file(folder / "run/log.txt"), HasSubstr("all fluid has left the domain"));
}

TEST(Losses, ResumedRunWithoutFluidEndsAtOnceWithTheSameOutputs) {
  const TempFolder folder;
  RunOptions options = into(folder);
  run_case(parsed(leaving_case("remove"), {"output.end_time=1"}), options);
  const std::string history = read_text_file(folder / "run/history.csv");
  options.until = 2;
  const RunOutcome again = resume_run(options);
  EXPECT_EQ(again.status, RunStatus::done);
  EXPECT_THAT(again.results, Contains(HasSubstr("ended early")));
  EXPECT_EQ(read_text_file(folder / "run/history.csv"), history);
  EXPECT_THAT(read_text_file(folder / "run/summary.json"), HasSubstr("\"ended_early\""));
}

TEST(Losses, RunGoesOnWhileFluidIsLeft) {
  const TempFolder folder;
  const RunOutcome outcome =
      run_case(parsed(leaving_case("remove"), {"output.end_time=0.008"}), into(folder));
  EXPECT_THAT(outcome.results, Not(Contains(HasSubstr("ended early"))));
  EXPECT_THAT(read_text_file(folder / "run/summary.json"), Not(HasSubstr("ended_early")));
}

TEST(Losses, GoOnFromWhatIsRestored) {
  const Case c = parsed(tiny_case());
  Losses losses(c);
  losses.restore(5, 0.9);
  losses.look_at({Vec3d{0, 0, -0.6 * spacing}}, 0);
  EXPECT_EQ(losses.in_walls().most, 5);
  EXPECT_EQ(losses.in_walls().now, 1);
  EXPECT_EQ(losses.in_walls().deepest, 0.9);
}

}  // namespace
}  // namespace slagflow
