// The program as its shell sees it: environment, signals, output that nobody takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/program_process.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing_tools::ProgramProcess;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;
using testing_tools::wait_until;

class Process : public testing::Test {
 protected:
  Process() { std::ofstream(folder_ / "tiny.toml") << tiny_case("1000"); }

  int shell(const std::string& script) const {
    return ProgramProcess({"-c", script}, folder_ / "said", "/bin/sh").wait();
  }
  std::string said() const { return read_text_file(folder_ / "said"); }
  std::string run(const std::string& options = "") const {
    return std::string(SLAGFLOW_PROGRAM) + " run " + (folder_ / "tiny.toml") + " -o " + (folder_ / "run") +
           " --threads 1 --quiet " + options;
  }
  bool history_has_lines() const {
    std::ifstream file(folder_ / "run/history.csv");
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines > 2;
  }

  const TempFolder folder_;
};

TEST_F(Process, OpenMpWaitsWithoutSpinningUnlessTheUserWishesOtherwise) {
  const std::string version = std::string(" OMP_DISPLAY_ENV=true ") + SLAGFLOW_PROGRAM + " --version";
  EXPECT_EQ(shell("env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT" + version), 0);
  if (said().find("OMP_WAIT_POLICY") == std::string::npos) GTEST_SKIP() << "no OpenMP that tells";
  EXPECT_THAT(said(), HasSubstr("OMP_WAIT_POLICY = 'PASSIVE'"));
  EXPECT_EQ(shell("env OMP_WAIT_POLICY=active" + version), 0);
  EXPECT_THAT(said(), HasSubstr("OMP_WAIT_POLICY = 'ACTIVE'"));
  EXPECT_THAT(said(), Not(HasSubstr("PASSIVE")));
}

TEST_F(Process, AFullStdoutIsAFailureAndAReaderWhoLeavesIsNone) {
  const std::string help = std::string(SLAGFLOW_PROGRAM) + " help --page";
  EXPECT_EQ(shell(help + " >/dev/full"), 1);
  EXPECT_THAT(said(), HasSubstr("error: cannot write to stdout: No space left on device"));
  EXPECT_EQ(shell(std::string(SLAGFLOW_PROGRAM) + " --version >/dev/full"), 1);
  EXPECT_EQ(shell("{ " + help + "; echo status $? >&2; } | head -n 1 >/dev/null"), 0);
  EXPECT_EQ(said(), "status 0\n");
}

TEST_F(Process, AClosedTerminalStopsARunUnlessItWasToBeIgnored) {
  ProgramProcess stopped({"-c", "exec " + run()}, folder_ / "said", "/bin/sh");
  ASSERT_TRUE(wait_until([&] { return history_has_lines(); })) << said();
  stopped.send(SIGHUP);
  EXPECT_EQ(stopped.wait(), 130) << said();
  std::filesystem::remove(folder_ / "run/history.csv");
  ProgramProcess stays({"-c", "trap '' HUP; exec " + run("--overwrite")}, folder_ / "said", "/bin/sh");
  ASSERT_TRUE(wait_until([&] { return history_has_lines(); })) << said();
  stays.send(SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_TRUE(stays.runs());
  stays.send(SIGTERM);
  EXPECT_EQ(stays.wait(), 130) << said();
}

TEST_F(Process, TellsOfMoreThreadsThanThereAreCoresAndRefusesAFolderWithoutAName) {
  const std::string once = std::string(SLAGFLOW_PROGRAM) + " run " + (folder_ / "tiny.toml") +
                           " --quiet --set output.end_time=1e-3 ";
  EXPECT_EQ(shell(once + "--threads 999 -o " + (folder_ / "many")), 0) << said();
  EXPECT_THAT(said(), HasSubstr("warning: --threads 999: this machine has "));
  EXPECT_EQ(shell(once + "-o ''"), 2);
  EXPECT_THAT(said(), HasSubstr("allowed: a folder"));
}

}  // namespace
}  // namespace slagflow
