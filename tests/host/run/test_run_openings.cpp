// Runs with inlets and outlets: what they leave, and resumed ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "host/run/run.hpp"
#include "host/same_results.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing_tools::expect_same_results;
using testing_tools::read_text_file;
using testing_tools::TempFolder;

// A jet of 2 mm particles onto a floor, over whose edge it runs into an outlet; no fluid at the start.
const char* const poured = R"([case]
name = "poured"
[resolution]
spacing = 2e-3
[fluid.oil]
density = 1000
rheology = "bingham"
plastic_viscosity = 0.1
yield_stress = 1
[[wall]]
name = "floor"
shapes = [{shape = "box", min = [-0.004, -0.004, -0.006], max = [0.004, 0.004, 0]}]
[[inlet]]
name = "tap"
face = "rectangle"
center = [0, 0, 0.014]
width = 0.008
height = 0.008
normal = [0, 0, -1]
velocity = [[0, 0.1], [0.05, 0.3]]
[[outlet]]
name = "ladle"
shape = "plane"
direction = "-z"
position = -0.004
[domain]
min = [-0.016, -0.016, -0.008]
max = [0.016, 0.016, 0.02]
[output]
interval = 0.02
history_interval = 0.005
checkpoint_interval = 0
end_time = 0.12
)";

RunOptions into(const std::string& path) {
  RunOptions options;
  options.folder = path;
  options.verbosity = Verbosity::quiet;
  options.threads = 1;
  return options;
}

TEST(RunOpenings, TellWhatCameInAndWentOut) {
  const TempFolder folder;
  const RunOutcome outcome = run_case(parse_case(poured, "poured.toml"), into(folder / "run"));
  ASSERT_EQ(outcome.status, RunStatus::done);
  EXPECT_THAT(outcome.results, Contains(testing::StartsWith("inlet tap fed 2")));
  EXPECT_THAT(outcome.results, Contains(testing::StartsWith("outlet ladle took ")));
  EXPECT_THAT(outcome.results, Contains("no particle left the domain"));
  std::ifstream history(folder / "run/history.csv");
  std::string line, last;
  std::getline(history, line);
  EXPECT_THAT(line, testing::EndsWith("tap_mass_fed_kg,ladle_mass_removed_kg"));
  while (std::getline(history, line)) last = line;
  // (0.1 + 0.3)/2 0.05 + 0.3 0.07 m through 16 columns, but for rows on their way.
  const double fed = std::stod(last.substr(last.rfind(',', last.rfind(',') - 1) + 1));
  EXPECT_NEAR(fed, 16 * 4e-6 * 0.031 * 1000, 16 * 8e-6);
  EXPECT_GT(std::stod(last.substr(last.rfind(',') + 1)), 0);
  const std::string summary = read_text_file(folder / "run/summary.json");
  for (const char* part : {"\"inlets\"", "\"tap\"", "\"outlets\"", "\"ladle\"", "\"mass_fed\""})
    EXPECT_THAT(summary, HasSubstr(part));
}

TEST(RunOpenings, ResumedRunsGiveTheSameBits) {
  const TempFolder folder;
  const Case c = parse_case(poured, "poured.toml");
  ASSERT_EQ(run_case(c, into(folder / "whole")).status, RunStatus::done);
  RunOptions part = into(folder / "part");
  part.until = 0.07;
  ASSERT_EQ(run_case(c, part).status, RunStatus::done);
  RunOptions rest = into(folder / "part");
  rest.until = 0.12;
  ASSERT_EQ(resume_run(rest).status, RunStatus::done);
  expect_same_results(folder / "whole", folder / "part");
}

const char* const probes = R"(
[[measure]]
name = "edge"
type = "flux"
center = [0.004, 0, 0.005]
width = 0.02
height = 0.02
normal = [1, 0, 0]
[[measure]]
name = "puddle"
type = "surface"
start = [-0.003, 0, 0]
end = [0.003, 0, 0]
points = 4
[[measure]]
name = "floor"
type = "contact"
wall = "floor"
[[measure]]
name = "stay"
type = "residence"
outlet = "ladle"
)";

TEST(RunOpenings, ProbesGoOnAsIfTheRunHadNotStopped) {
  const TempFolder folder;
  const Case c = parse_case(std::string(poured) + probes, "poured.toml");
  const RunOutcome outcome = run_case(c, into(folder / "whole"));
  ASSERT_EQ(outcome.status, RunStatus::done);
  RunOptions part = into(folder / "part");
  part.until = 0.07;
  ASSERT_EQ(run_case(c, part).status, RunStatus::done);
  RunOptions rest = into(folder / "part");
  rest.until = 0.12;
  ASSERT_EQ(resume_run(rest).status, RunStatus::done);
  expect_same_results(folder / "whole", folder / "part");
  const std::string surface = read_text_file(folder / "whole/surface_puddle.csv");
  EXPECT_EQ(surface, read_text_file(folder / "part/surface_puddle.csv"));
  EXPECT_THAT(surface, testing::StartsWith("time_s,x_m,y_m,z_m,surface_m,height_m,thickness_m\n"));
  EXPECT_EQ(std::count(surface.begin(), surface.end(), '\n'), 1 + 4 * 7);  // a header, 7 snapshots
  for (const char* line :
       {"edge (flux): forward ", "puddle (surface): ", "floor (contact): fluid on ", "stay (residence): "})
    EXPECT_THAT(outcome.results, Contains(testing::StartsWith(line)));
  EXPECT_THAT(outcome.results, Contains(HasSubstr("particles left through ladle after 0.0")));
}

// Nothing is there at the start, and nothing after all has left and no inlet feeds.
TEST(RunOpenings, EndEarlyOnlyWhenNothingComesAnyMore) {
  const TempFolder folder;
  const std::vector<std::string> short_feed{"inlet.0.stop=0.03", "output.end_time=2",
                                            "wall.0.shapes.0.max=[-0.003,0.004,0]"};
  const RunOutcome outcome = run_case(parse_case(poured, "poured.toml", short_feed), into(folder / "run"));
  EXPECT_EQ(outcome.status, RunStatus::done);
  EXPECT_THAT(outcome.results, Contains(HasSubstr("ended early: all fluid has left the domain")));
  EXPECT_THAT(outcome.results, Contains(HasSubstr("inlet tap fed 3")));
}

}  // namespace
}  // namespace slagflow
