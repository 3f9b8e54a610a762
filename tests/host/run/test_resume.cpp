// Broken runs, resumed, against unbroken ones, bit by bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "backend/error.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/output/hdf5_handles.hpp"
#include "host/output/provenance.hpp"
#include "host/output/vtkhdf.hpp"
#include "host/program/program.hpp"
#include "host/program_process.hpp"
#include "host/run/run.hpp"
#include "host/same_results.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::expect_same_results;
using testing_tools::ProgramProcess;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;
using testing_tools::wait_until;

constexpr const char* end_time = "0.03";

class Resume : public testing::Test {
 protected:
  Resume() { std::ofstream(case_file()) << tiny_case(end_time); }

  std::string case_file() const { return folder_ / "tiny.toml"; }
  std::string said() const { return read_text_file(folder_ / "said"); }

  std::vector<std::string> run_command(const std::string& name) const {
    return {"run",          case_file(), "-o",
            folder_ / name, "--threads", "1",
            "--quiet",      "--set",     "output.checkpoint_interval=0.002",
            "--overwrite"};
  }
  std::vector<std::string> resume_command(const std::string& name) const {
    return {"resume", folder_ / name, "--threads", "1", "--quiet"};
  }
  int call(const std::vector<std::string>& command) const {
    return ProgramProcess(command, folder_ / "said").wait();
  }
  // To its end in this process; with `until` less than that, there is a run to resume.
  void run_here(const std::string& name, std::optional<double> until = {}) const {
    RunOptions options = here(name);
    options.until = until;
    const Case c = load_case(case_file(), {"output.checkpoint_interval=0.002"});
    ASSERT_EQ(run_case(c, options).status, RunStatus::done);
  }
  RunOutcome resume_here(const std::string& name, std::optional<double> until = {}) const {
    RunOptions options = here(name);
    options.until = until;
    return resume_run(options);
  }
  std::size_t lines_of_history(const std::string& name) const {
    const std::string text = read_text_file(folder_ / name + "/history.csv");
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  const TempFolder folder_;

 private:
  RunOptions here(const std::string& name) const {
    RunOptions options;
    options.folder = folder_ / name;
    options.threads = 1;
    options.verbosity = Verbosity::quiet;
    return options;
  }
};

TEST_F(Resume, GivesTheBitsOfAnUnbrokenRunAfterSigterm) {
  run_here("unbroken");
  ProgramProcess process(run_command("broken"), folder_ / "said");
  ASSERT_TRUE(wait_until([&] { return lines_of_history("broken") > 5; }));
  process.send(SIGTERM);
  ASSERT_EQ(process.wait(), 130) << said();
  EXPECT_THAT(read_text_file(folder_ / "broken/summary.json"), HasSubstr("\"status\": \"interrupted\""));
  EXPECT_EQ(call(resume_command("broken")), 0) << said();
  expect_same_results(folder_ / "broken", folder_ / "unbroken");
  EXPECT_THAT(read_text_file(folder_ / "broken/summary.json"), HasSubstr("\"resumes\": 1"));
}

// SLAGFLOW_KILLS sets the number of runs; each is killed up to three times before it may end.
TEST_F(Resume, GivesTheBitsOfAnUnbrokenRunAfterSigkill) {
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_EQ(call(run_command("unbroken")), 0) << said();
  const auto wall = std::chrono::steady_clock::now() - begun;
  const char* given = std::getenv("SLAGFLOW_KILLS");
  const int runs = given != nullptr ? std::atoi(given) : 5;
  std::mt19937 random(20170419);
  std::uniform_real_distribution<double> share(0, 0.8);
  int resumed = 0;
  for (int k = 0; k < runs; ++k) {
    SCOPED_TRACE("run " + std::to_string(k));
    std::vector<std::string> command = run_command("broken");
    for (int kills = 0; kills < 3; ++kills) {
      ProgramProcess process(command, folder_ / "said");
      std::this_thread::sleep_for(share(random) * wall);
      process.send(SIGKILL);
      const int status = process.wait();
      ASSERT_TRUE(status == 128 + SIGKILL || status == 0) << said();
      if (!std::filesystem::exists(folder_ / "broken/checkpoint.h5")) continue;  // too early: begin again
      if (status != 0) ++resumed;
      command = resume_command("broken");
    }
    ASSERT_EQ(call(command), 0) << said();
    expect_same_results(folder_ / "broken", folder_ / "unbroken");
  }
  EXPECT_GT(resumed, 0);
}

TEST_F(Resume, Sigusr1WritesACheckpointAndTheRunGoesOn) {
  std::vector<std::string> command = run_command("run");
  command.insert(command.end(), {"--set", "output.end_time=1000", "--set", "output.checkpoint_interval=0"});
  ProgramProcess process(command, folder_ / "said");
  ASSERT_TRUE(wait_until([&] { return lines_of_history("run") > 2; }));
  const std::string checkpoint = folder_ / "run/checkpoint.h5";
  EXPECT_FALSE(std::filesystem::exists(checkpoint));
  process.send(SIGUSR1);
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(checkpoint); }));
  const std::size_t lines = lines_of_history("run");
  EXPECT_TRUE(wait_until([&] { return lines_of_history("run") > lines; }));
  EXPECT_TRUE(process.runs());
  EXPECT_THROW(resume_here("run"), InputError);  // while the other is at work
  EXPECT_GT(read_checkpoint(checkpoint).run.steps, 0);
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 130);
}

// Killed at once, long before its first checkpoint is due.
TEST_F(Resume, GoesOnFromACheckpointOfTheStart) {
  run_here("unbroken");
  std::vector<std::string> command = run_command("broken");
  command.insert(command.end(), {"--set", "output.checkpoint_interval=1000"});
  ProgramProcess process(command, folder_ / "said");
  ASSERT_TRUE(wait_until([&] { return lines_of_history("broken") > 2; }));
  process.send(SIGKILL);
  ASSERT_EQ(process.wait(), 128 + SIGKILL) << said();
  const RunRecord start = read_checkpoint(folder_ / "broken/checkpoint.h5").run;
  EXPECT_EQ(start.steps, 0);
  EXPECT_EQ(start.history_lines, 1);
  EXPECT_EQ(start.snapshots, 1);
  EXPECT_EQ(call(resume_command("broken")), 0) << said();
  expect_same_results(folder_ / "broken", folder_ / "unbroken");
}

std::string attribute_of(const std::string& path, const char* name) {
  const hdf5::File file = hdf5::File::open(path, hdf5::File::Access::read);
  for (const auto& [key, value] : read_texts(file, open_group(file, "/VTKHDF")))
    if (key == name) return value;
  return "missing";
}

// The outputs of a run that was taken further carry the case that gives them. Its end time stays as written.
TEST_F(Resume, CaseInTheOutputsFollowsALaterEndTime) {
  run_here("run", 0.0107);
  for (const char* name : {"/particles.vtkhdf", "/walls.vtkhdf"}) {
    EXPECT_THAT(attribute_of(folder_ / "run" + name, "case_text"),
                HasSubstr("end_time = 0.03\nuntil = 0.0107\n"));
    EXPECT_THAT(attribute_of(folder_ / "run" + name, "ended_utc"), testing::EndsWith("Z"));
  }
  const std::string started = attribute_of(folder_ / "run/particles.vtkhdf", "started_utc");
  resume_here("run", std::stod(end_time));
  const std::string resolved = read_text_file(folder_ / "run/case.toml");
  EXPECT_THAT(resolved, HasSubstr("end_time = 0.03\nuntil = \"end_time\"\n"));
  for (const char* name : {"/particles.vtkhdf", "/walls.vtkhdf"}) {
    EXPECT_EQ(attribute_of(folder_ / "run" + name, "case_text"), resolved);
    EXPECT_EQ(attribute_of(folder_ / "run" + name, "started_utc"), started);
  }
  EXPECT_EQ(read_checkpoint(folder_ / "run/checkpoint.h5").text("case_text"), resolved);
  std::ofstream(folder_ / "repeated.toml") << attribute_of(folder_ / "run/particles.vtkhdf", "case_text");
  RunOptions options;
  options.folder = folder_ / "repeated", options.threads = 1, options.verbosity = Verbosity::quiet;
  EXPECT_EQ(run_case(load_case(folder_ / "repeated.toml"), options).exit_code(), 0);
  expect_same_results(folder_ / "run", folder_ / "repeated");
}

TEST_F(Resume, NamesBothProgramsWhereAnotherOneGoesOn) {
  run_here("run", 0.002);
  const CheckpointStore store(folder_ / "run");
  Checkpoint older = store.read_newest().checkpoint;
  for (auto& [key, value] : older.texts)
    if (key == "commit") value = "0123456789ab";
  store.write(older);
  testing::internal::CaptureStderr();
  resume_here("run", 0.004), resume_here("run", 0.006);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("may differ in their last digits"));
  const std::string commit = attribute_of(folder_ / "run/particles.vtkhdf", "commit");
  EXPECT_EQ(commit, "0123456789ab, resumed with " + build_provenance().commit);
}

TEST_F(Resume, TakesAFinishedRunFurther) {
  run_here("unbroken");
  run_here("extended", 0.0107);
  const RunOutcome outcome = resume_here("extended", std::stod(end_time));
  EXPECT_EQ(outcome.exit_code(), 0);
  expect_same_results(folder_ / "extended", folder_ / "unbroken");
  EXPECT_THAT(read_text_file(folder_ / "extended/case.toml"),
              HasSubstr(std::string("end_time = ") + end_time));
}

// Beyond the end time of the case, at which its steps are cut: those steps are part of the run that goes on.
TEST_F(Resume, GoesBeyondTheEndTimeOfTheCaseToTheBitsOfAnUnbrokenRun) {
  constexpr double later = 0.0421;
  run_here("unbroken", later);
  run_here("in_steps", 0.0107);
  for (const double until : {0.03, 0.0333, later}) EXPECT_EQ(resume_here("in_steps", until).exit_code(), 0);
  expect_same_results(folder_ / "in_steps", folder_ / "unbroken");
  EXPECT_EQ(read_text_file(folder_ / "in_steps/case.toml"), read_text_file(folder_ / "unbroken/case.toml"));
  const std::string history = read_text_file(folder_ / "unbroken/history.csv");
  EXPECT_THAT(history, HasSubstr("\n0.03,"));  // exactly
  const RunRecord end = read_checkpoint(folder_ / "unbroken/checkpoint.h5").run;
  EXPECT_GE(end.time, later);
  EXPECT_GT(end.time - later, 1e-9) << "cut to meet a time that is not the case's own";
}

// As if ten particles had been in a wall before.
TEST_F(Resume, RemembersTheMostThatWereInWalls) {
  run_here("run", 0.004);
  const CheckpointStore store(folder_ / "run");
  Checkpoint checkpoint = store.read_newest().checkpoint;
  EXPECT_EQ(checkpoint.run.most_in_walls, 0);
  checkpoint.run.most_in_walls = 10, checkpoint.run.deepest_in_wall = 1.5;
  store.write(std::move(checkpoint));
  EXPECT_THAT(resume_here("run", 0.008).results,
              testing::Contains(HasSubstr("10 particles at most, 0 at the end; the deepest 1.50 spacings")));
  EXPECT_EQ(store.read_newest().checkpoint.run.most_in_walls, 10);
  EXPECT_THAT(read_text_file(folder_ / "run/summary.json"), HasSubstr("\"most\": 10"));
}

TEST_F(Resume, LeavesAFinishedRunAsItIsAndSaysSo) {
  run_here("unbroken");
  run_here("again");
  for (int k = 0; k < 2; ++k) {
    const RunOutcome outcome = resume_here("again");
    EXPECT_EQ(outcome.exit_code(), 0);
    ASSERT_FALSE(outcome.results.empty());
    EXPECT_THAT(outcome.results[0], HasSubstr("has reached its end of 0.03"));
    EXPECT_THAT(outcome.results[0], HasSubstr("--until"));
  }
  expect_same_results(folder_ / "again", folder_ / "unbroken");
}

TEST_F(Resume, UsesThePreviousCheckpointWhereTheNewestIsDamaged) {
  run_here("unbroken");
  run_here("damaged");
  const std::string newest = folder_ / "damaged/checkpoint.h5";
  std::filesystem::resize_file(newest, std::filesystem::file_size(newest) / 2);
  testing::internal::CaptureStderr();
  const RunOutcome outcome = resume_here("damaged");
  EXPECT_THAT(
      testing::internal::GetCapturedStderr(),
      HasSubstr("checkpoint.h5: is truncated or no checkpoint: its end is missing; the previous one"));
  EXPECT_EQ(outcome.exit_code(), 0);
  expect_same_results(folder_ / "damaged", folder_ / "unbroken");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "damaged/checkpoint.damaged.h5"));
  EXPECT_NO_THROW(read_checkpoint(newest));
}

TEST_F(Resume, FailsWithTheReasonsWhereNoCheckpointIsSound) {
  run_here("run");
  std::filesystem::resize_file(folder_ / "run/checkpoint.h5", 1000);
  std::filesystem::resize_file(folder_ / "run/checkpoint.previous.h5", 0);
  const std::string history = read_text_file(folder_ / "run/history.csv");
  EXPECT_EQ(call(resume_command("run")), 1);
  EXPECT_THAT(said(), HasSubstr("checkpoint.h5: is truncated"));
  EXPECT_THAT(said(), HasSubstr("checkpoint.previous.h5: is truncated"));
  EXPECT_EQ(read_text_file(folder_ / "run/history.csv"), history);
}

TEST_F(Resume, RefusesWhatIsNoFolderOfARun) {
  EXPECT_EQ(call(resume_command("missing")), 2);
  EXPECT_THAT(said(), HasSubstr("missing: is no folder"));
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_EQ(call(resume_command("empty")), 2);
  EXPECT_THAT(said(), HasSubstr("holds no checkpoint.h5"));
}

TEST_F(Resume, RefusesACheckpointOfAnotherPrecisionOrBackend) {
  run_here("run", 0.002);
  const CheckpointStore store(folder_ / "run");
  const Checkpoint written = store.read_newest().checkpoint;
  for (const char* name : {"precision", "backend"}) {
    Checkpoint other = written;
    for (auto& [key, value] : other.texts)
      if (key == name) value = "other";
    store.write(other);
    try {
      resume_here("run");
      FAIL() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string("a build with ") + name + " \"other\""));
    }
  }
}

TEST_F(Resume, RefusesACaseWhoseGeometryHasChanged) {
  run_here("run", 0.002);
  const CheckpointStore store(folder_ / "run");
  Checkpoint other = store.read_newest().checkpoint;
  other.run.geometry ^= 1;
  store.write(other);
  EXPECT_THROW(resume_here("run"), Error);
}

TEST_F(Resume, RefusesOutputsThatAreShorterThanTheCheckpointKnows) {
  run_here("run", 0.01);
  std::filesystem::resize_file(folder_ / "run/history.csv", 300);
  EXPECT_EQ(call(resume_command("run")), 2);
  EXPECT_THAT(said(), HasSubstr("history.csv: holds 300 bytes"));
  EXPECT_THAT(said(), HasSubstr("slagflow run --from"));
}

TEST_F(Resume, FailedRunKeepsItsLastGoodCheckpoint) {
  std::ofstream(case_file()) << testing_tools::leaving_case("stop");
  EXPECT_EQ(call(run_command("run")), 1);
  const RunRecord last = read_checkpoint(folder_ / "run/checkpoint.h5").run;
  EXPECT_GT(last.steps, 0);
  const std::string history = read_text_file(folder_ / "run/history.csv");
  EXPECT_EQ(call(resume_command("run")), 1);
  EXPECT_EQ(read_text_file(folder_ / "run/history.csv"), history);
}

// A folder in place of the unfinished file: no checkpoint can be written, all else can.
TEST_F(Resume, GoesOnWithoutCheckpointsButFailsWithoutTheLast) {
  run_here("unbroken");
  run_here("run", 0.01);
  const std::string before = read_text_file(folder_ / "run/checkpoint.h5");
  std::filesystem::create_directory(folder_ / "run/checkpoint.h5.tmp");
  testing::internal::CaptureStderr();
  const RunOutcome outcome = resume_here("run", std::stod(end_time));
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("warning: no checkpoint, the last one stays"));
  EXPECT_EQ(outcome.exit_code(), 1);
  EXPECT_THAT(outcome.reason, HasSubstr("checkpoint.h5.tmp: Is a directory"));
  EXPECT_EQ(read_text_file(folder_ / "run/checkpoint.h5"), before);
  std::filesystem::remove(folder_ / "run/checkpoint.h5.tmp");
  EXPECT_EQ(resume_here("run", std::stod(end_time)).exit_code(), 0);
  expect_same_results(folder_ / "run", folder_ / "unbroken");
}

}  // namespace
}  // namespace slagflow
