#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "backend/error.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint.hpp"
#include "host/program/info.hpp"
#include "host/run/run.hpp"
#include "host/run/run_interrupt.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::leaving_case;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

RunOptions into(const TempFolder& folder, const std::string& name = "run") {
  RunOptions options;
  options.folder = folder / name;
  options.verbosity = Verbosity::quiet;
  options.threads = 1;  // more than the case is worth
  return options;
}

RunOutcome run_text(const std::string& text, const RunOptions& options,
                    const std::vector<std::string>& overrides = {}) {
  return run_case(parse_case(text, "tiny.toml", overrides), options);
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

TEST(Run, LeavesAllFilesOfAFinishedRun) {
  const TempFolder folder;
  const RunOutcome outcome = run_text(tiny_case(), into(folder));
  EXPECT_EQ(outcome.status, RunStatus::done);
  EXPECT_EQ(outcome.exit_code(), 0);
  const std::string summary = read_text_file(folder / "run/summary.json");
  for (const char* part :
       {"\"status\": \"done\"", "\"case\": \"tiny\"", "\"fluid\": 125", "\"iterations_mean\"", "\"mass_in\"",
        "\"particle_steps_per_second\"", "\"neighbours_mean\"", "\"max_compression\"", "\"device_bytes\"",
        "\"peak_memory_bytes\"", "\"list_builds\"", "\"timings\"", "\"spread\"", "\"+z\": 0"})
    EXPECT_THAT(summary, HasSubstr(part));
  EXPECT_THAT(read_text_file(folder / "run/log.txt"), HasSubstr("case tiny: 125 fluid"));
  // At 0, 1, 2, 3 and 4 ms.
  EXPECT_THAT(describe_file(folder / "run/particles.vtkhdf"), HasSubstr("time steps: 5, from 0 s to 0.004"));
  EXPECT_THAT(describe_file(folder / "run/walls.vtkhdf"), HasSubstr("time steps: 5"));
  const auto history = lines_of(folder / "run/history.csv");
  ASSERT_EQ(history.size(), 1u + 9u);
  EXPECT_THAT(history[0], testing::StartsWith("time_s,step,dt_s,particles_in,particles_out,max_speed_m_s,"));
  EXPECT_THAT(
      history[0],
      testing::EndsWith(
          "spread_front_m,spread_passed,outflow_passed_m3,outflow_behind_m3,outflow_flow_m3_s,corner_m3"));
}

// 10 mm of fluid at rest press it together by (rho g 9 mm)/(rho c0^2).
TEST(Run, TellsTheLargestCompressionAndWarnsOfMuch) {
  const TempFolder folder;
  const RunOutcome soft = run_text(tiny_case(), into(folder, "soft"), {"numerics.sound_speed=0.8"});
  EXPECT_EQ(soft.status, RunStatus::done);
  EXPECT_THAT(soft.results, testing::Contains(testing::StartsWith("largest compression 1")));
  const std::string log = read_text_file(folder / "soft/log.txt");
  const std::size_t advice = log.find("numerics.sound_speed = ");
  ASSERT_NE(advice, std::string::npos) << log;
  const double enough = std::stod(log.substr(advice + 23));
  EXPECT_GT(enough, 0.8 * 0.138 / 0.1);
  const RunOutcome stiff =
      run_text(tiny_case(), into(folder, "stiff"), {"numerics.sound_speed=" + std::to_string(enough)});
  EXPECT_THAT(stiff.results, testing::Contains(HasSubstr("largest compression")));
  EXPECT_EQ(read_text_file(folder / "stiff/log.txt").find("numerics.sound_speed = "), std::string::npos);
}

// Read back by read_vtkhdf.py with VTK's reader, from the folder that the variable names.
TEST(Run, LeavesSampleForOtherReaders) {
  const TempFolder own;
  const char* given = std::getenv("SLAGFLOW_VTK_SAMPLES");
  RunOptions options = into(own);
  if (given != nullptr) options.folder = std::string(given) + "/run";
  EXPECT_EQ(run_text(leaving_case("remove"), options).status, RunStatus::done);
  options.folder += "_with_walls";
  EXPECT_EQ(run_text(tiny_case(), options).status, RunStatus::done);
}

TEST(Run, ResolvedCaseGivesTheSameRun) {
  const TempFolder folder;
  RunOptions options = into(folder);
  options.until = 0.002;
  run_text(tiny_case(), options);
  RunOptions again = into(folder);
  again.folder = folder / "again";
  run_case(load_case(folder / "run/case.toml"), again);
  EXPECT_EQ(read_text_file(folder / "run/history.csv"), read_text_file(folder / "again/history.csv"));
  EXPECT_EQ(read_text_file(folder / "run/case.toml"), read_text_file(folder / "again/case.toml"));
}

TEST(Run, EndsAtItsEndTimeExactly) {
  const TempFolder folder;
  run_text(tiny_case("0.0041"), into(folder));
  EXPECT_EQ(read_checkpoint(folder / "run/checkpoint.h5").run.time, 0.0041);
  EXPECT_THAT(lines_of(folder / "run/history.csv").back(), testing::StartsWith("0.0041,"));
}

// In next to no gravity the longest stable step would be 300 s.
TEST(Run, TakesNoStepLongerThanItsEndTime) {
  const TempFolder folder;
  const Case c = parse_case(tiny_case("0.02"), "tiny.toml",
                            {"gravity.acceleration=[0,0,-1e-12]", "numerics.sound_speed=auto"});
  EXPECT_EQ(run_case(c, into(folder)).status, RunStatus::done);
  const RunRecord end = read_checkpoint(folder / "run/checkpoint.h5").run;
  EXPECT_EQ(end.time, 0.02);
  EXPECT_EQ(end.steps, 2);
}

FluidSnapshot end_of(const std::string& folder) {
  Checkpoint last = read_checkpoint(folder + "/checkpoint.h5");
  Simulation simulation(build_setup(load_case(folder + "/case.toml")).setup);
  simulation.restore(last.state);
  FluidSnapshot snapshot;
  simulation.read(snapshot);
  return snapshot;
}

// What is written, and when, is no part of the flow.
TEST(Run, OutputKeysChangeNoBitOfTheFlow) {
  const TempFolder folder;
  std::vector<FluidSnapshot> ends;
  for (const std::vector<std::string>& keys :
       {std::vector<std::string>{}, std::vector<std::string>{"output.interval=0.00037", "output.walls=false"},
        std::vector<std::string>{"output.interval=0.02", "output.history_interval=0.00011",
                                 "output.checkpoint_interval=0.001", "output.until=0.01"}}) {
    RunOptions options = into(folder);
    options.folder = folder / ("run" + std::to_string(ends.size()));
    EXPECT_EQ(run_case(parse_case(tiny_case("0.01"), "tiny.toml", keys), options).status, RunStatus::done);
    ends.push_back(end_of(options.folder));
  }
  ASSERT_EQ(ends[0].id.size(), 125u);
  for (const FluidSnapshot& end : {ends[1], ends[2]}) {
    EXPECT_EQ(end.time, ends[0].time);
    EXPECT_EQ(end.id, ends[0].id);
    for (std::size_t i = 0; i < end.id.size(); ++i) {
      EXPECT_TRUE(end.position[i] == ends[0].position[i]) << i;
      EXPECT_TRUE(end.velocity[i] == ends[0].velocity[i]) << i;
      EXPECT_EQ(end.density[i], ends[0].density[i]) << i;
    }
  }
}

TEST(Run, EndsAtTheTimeAskedFor) {
  const TempFolder folder;
  RunOptions options = into(folder);
  options.until = 0.0015;
  run_text(tiny_case(), options);
  const std::string last = lines_of(folder / "run/history.csv").back();
  const double time = std::stod(last);
  EXPECT_GE(time, 0.0015);
  EXPECT_LT(time, 0.0015 + 3e-4);  // one time step more
}

TEST(Run, RefusesAFolderThatHoldsFiles) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "run");
  std::ofstream(folder / "run/notes.txt") << "mine";
  EXPECT_THROW(run_text(tiny_case(), into(folder)), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "run/case.toml"));
}

TEST(Run, OverwritesOnlyItsOwnFiles) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "run");
  std::ofstream(folder / "run/notes.txt") << "mine";
  std::ofstream(folder / "run/checkpoint.h5") << "old";
  RunOptions options = into(folder);
  options.overwrite = Overwrite::replace;
  EXPECT_EQ(run_text(tiny_case(), options).status, RunStatus::done);
  EXPECT_EQ(read_text_file(folder / "run/notes.txt"), "mine");
  EXPECT_NE(read_text_file(folder / "run/checkpoint.h5"), "old");
}

TEST(Run, DoesNotReplaceTheCaseThatItIsGiven) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "run");
  const std::string text = "# mine\n" + tiny_case();
  std::ofstream(folder / "run/case.toml") << text;
  RunOptions options = into(folder);
  options.overwrite = Overwrite::replace;
  EXPECT_THROW(run_case(load_case(folder / "run/case.toml"), options), InputError);
  EXPECT_EQ(read_text_file(folder / "run/case.toml"), text);
  std::ofstream(folder / "run/log.txt") << "an earlier run";
  EXPECT_EQ(run_case(load_case(folder / "run/case.toml"), options).status, RunStatus::done);
}

TEST(Run, IsNoLongerThanItsCheckpointsCouldTell) {
  const TempFolder folder;
  RunOptions options = into(folder);
  options.until = 1e9;
  try {
    run_text(tiny_case(), options);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("--until 1e+09: allowed: up to "));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

TEST(Run, RefusesAFileInPlaceOfItsFolder) {
  const TempFolder folder;
  std::ofstream(folder / "run") << "a file";
  RunOptions options = into(folder);
  options.overwrite = Overwrite::replace;
  EXPECT_THROW(run_text(tiny_case(), options), InputError);
}

TEST(Run, FailureLeavesReasonAndLastState) {
  const TempFolder folder;
  testing::internal::CaptureStderr();
  const RunOutcome outcome = run_text(leaving_case("stop"), into(folder));
  const std::string shown = testing::internal::GetCapturedStderr();
  EXPECT_EQ(outcome.status, RunStatus::failed);
  EXPECT_EQ(outcome.exit_code(), 1);
  EXPECT_THAT(shown, HasSubstr("error: " + outcome.reason));
  EXPECT_THAT(read_text_file(folder / "run/log.txt"), HasSubstr(outcome.reason));
  const std::string summary = read_text_file(folder / "run/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"status\": \"failed\""));
  EXPECT_THAT(summary, HasSubstr("\"reason\": "));
  EXPECT_THAT(summary, HasSubstr("\"simulated_time\": "));
  EXPECT_THAT(describe_file(folder / "run/particles.vtkhdf"), HasSubstr("time steps: "));
}

TEST(Run, EndsWithAllOutputsWhenAllParticlesHaveLeft) {
  const TempFolder folder;
  const RunOutcome outcome = run_text(leaving_case("remove"), into(folder));
  EXPECT_EQ(outcome.status, RunStatus::done) << outcome.reason;
  EXPECT_THAT(describe_file(folder / "run/particles.vtkhdf"), HasSubstr("125 in the first, 0 in the last"));
  EXPECT_THAT(read_text_file(folder / "run/summary.json"), HasSubstr("\"+x\": 125"));
}

// Waits for the second line of the history, so that the run surely listens, and interrupts it.
void interrupt_when_running(const std::string& history) {
  for (int k = 0; k < 6000; ++k) {
    if (lines_of(history).size() > 2) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(getpid(), SIGINT);
}

TEST(Run, InterruptEndsItWithItsFilesClosed) {
  const TempFolder folder;
  std::thread user(interrupt_when_running, folder / "run/history.csv");
  const RunOutcome outcome = run_text(tiny_case("1000"), into(folder));
  user.join();
  EXPECT_EQ(outcome.status, RunStatus::interrupted);
  EXPECT_EQ(outcome.exit_code(), 130);
  EXPECT_THAT(read_text_file(folder / "run/summary.json"), HasSubstr("\"status\": \"interrupted\""));
  EXPECT_THAT(describe_file(folder / "run/particles.vtkhdf"), HasSubstr("time steps: "));
  ASSERT_FALSE(outcome.results.empty());
  EXPECT_EQ(outcome.results.back().find("to go on: slagflow resume " + (folder / "run")), 0U);
}

// On stdout, from the results, and in the log.
TEST(Run, TellsItsEndOnce) {
  const TempFolder folder;
  RunOptions options = into(folder);
  options.verbosity = Verbosity::normal;
  testing::internal::CaptureStderr();
  const RunOutcome outcome = run_text(tiny_case(), options);
  const std::string shown = testing::internal::GetCapturedStderr(),
                    log = read_text_file(folder / "run/log.txt");
  EXPECT_GT(outcome.results.size(), 5U);
  for (const std::string& line : outcome.results) {
    EXPECT_THAT(log, HasSubstr(line));
    EXPECT_THAT(shown, testing::Not(HasSubstr(line)));
  }
}

// The setup looks at some millions of lattice sites, the signal comes as soon as it is waited for. A shell
// that starts the tests in the background has them ignore it until then.
TEST(Run, InterruptDuringTheSetupLeavesTheOldRunAsItIs) {
  const TempFolder folder;
  run_text(tiny_case(), into(folder));
  const std::string before = read_text_file(folder / "run/summary.json");
  struct sigaction idle {};
  sigaction(SIGINT, nullptr, &idle);
  std::thread user([idle] {
    struct sigaction now = idle;
    for (int k = 0; k < 60000 && now.sa_handler == idle.sa_handler; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      sigaction(SIGINT, nullptr, &now);
    }
    if (now.sa_handler != idle.sa_handler) kill(getpid(), SIGINT);
  });
  RunOptions options = into(folder);
  options.overwrite = Overwrite::replace;
  const RunOutcome outcome =
      run_text(tiny_case("1000"), options, {"domain.min=[-0.15,-0.15,-0.15]", "domain.max=[0.15,0.15,0.15]"});
  user.join();
  EXPECT_EQ(outcome.exit_code(), 130);
  EXPECT_THAT(outcome.results, testing::ElementsAre(HasSubstr("nothing in " + (folder / "run"))));
  EXPECT_EQ(read_text_file(folder / "run/summary.json"), before);
  EXPECT_FALSE(lines_of(folder / "run/history.csv").empty());
}

TEST(Run, FolderThatVanishesIsAFailureThatNamesAFileInIt) {
  const TempFolder folder;
  std::thread other([&] {
    for (int k = 0; k < 6000 && lines_of(folder / "run/history.csv").size() <= 2; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::error_code in_use;  // while the run makes files in it
    for (int k = 0; k < 6000 && std::filesystem::exists(folder / "run"); ++k)
      std::filesystem::remove_all(folder / "run", in_use);
  });
  testing::internal::CaptureStderr();
  const RunOutcome outcome = run_text(tiny_case("1000"), into(folder));
  other.join();
  EXPECT_EQ(outcome.exit_code(), 1);
  EXPECT_THAT(outcome.reason,
              testing::ContainsRegex("run/(particles|walls).vtkhdf: No such file or directory"));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("error: " + outcome.reason));
}

TEST(InterruptGuard, LeavesTheSecondSignalToTheSystem) {
  struct sigaction before {
  }, now{};
  sigaction(SIGINT, nullptr, &before);
  {
    const InterruptGuard guard;
    EXPECT_FALSE(guard.requested());
    raise(SIGINT);
    EXPECT_TRUE(guard.requested());
    sigaction(SIGINT, nullptr, &now);
    EXPECT_EQ(now.sa_handler, SIG_DFL);
  }
  sigaction(SIGINT, nullptr, &now);
  EXPECT_EQ(now.sa_handler, before.sa_handler);
}

TEST(Run, EndsWhenTheMeasureItWaitsForHasArrived) {
  const TempFolder folder;
  std::string text = leaving_case("remove");
  const Case c = parse_case(text, "t.toml", {"output.stop_after=spread"});
  EXPECT_EQ(parse_case(to_toml(c), "u.toml").output.stop_after, "spread");
  RunOptions options;
  options.folder = folder / "run";
  options.verbosity = Verbosity::quiet;
  EXPECT_EQ(run_case(c, options).exit_code(), 0);
  const std::string summary = read_text_file(folder / "run/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"status\": \"done\""));
  EXPECT_THAT(summary, HasSubstr("\"ended_early\": \"spread has arrived"));
  // The first particles have 0.5 mm to go at 1 m/s; the case would end at 20 ms.
  const std::string key = "\"simulated_time\": ";
  EXPECT_LT(std::stod(summary.substr(summary.find(key) + key.size())), 0.005);
}

}  // namespace
}  // namespace slagflow
