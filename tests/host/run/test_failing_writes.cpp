// A disk that fails at the n-th write, for every n (label long) or every fifth: nothing that was complete is
// lost, and the run can go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "backend/error.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/program/info.hpp"
#include "host/program_process.hpp"
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

struct Failure {
  const char* mode;
  int step;  // from one n to the next
};

void PrintTo(const Failure& failure, std::ostream* out) { *out << failure.mode; }

class FailingWrites : public testing::TestWithParam<Failure> {
 protected:
  FailingWrites() {
    std::ofstream(folder_ / "tiny.toml") << tiny_case("0.002");
    call(run_command("unbroken"), SLAGFLOW_PROGRAM);
  }

  std::vector<std::string> run_command(const std::string& name) const {
    return {"run",
            folder_ / "tiny.toml",
            "-o",
            folder_ / name,
            "--threads",
            "1",
            "--quiet",
            "--set",
            "output.checkpoint_interval=1e-9",
            "--overwrite"};
  }
  std::vector<std::string> resume_command() const {
    return {"resume", folder_ / "run", "--threads", "1", "--quiet", "--until", "0.002"};
  }
  int call(const std::vector<std::string>& command, const std::string& program) const {
    return ProgramProcess(command, folder_ / "said", program).wait();
  }
  static std::string label(int n) { return std::string(GetParam().mode) + " " + std::to_string(n); }
  std::string said() const { return read_text_file(folder_ / "said"); }

  // The n-th write fails. Returns whether the program noticed, which it must say with file and reason.
  bool call_with_failure(const std::vector<std::string>& command, int n) const {
    setenv("SLAGFLOW_FAIL_WRITE", label(n).c_str(), 1);
    const int status = call(command, SLAGFLOW_FAILING_PROGRAM);
    unsetenv("SLAGFLOW_FAIL_WRITE");
    EXPECT_TRUE(status == 0 || status == 1) << status << ": " << said();
    if (status != 1) return false;
    EXPECT_THAT(said(), testing::ContainsRegex("cannot [a-z ]+ /.*/run/[a-z.0-9]+"));
    EXPECT_THAT(said(), testing::AnyOf(HasSubstr("No space left on device"), HasSubstr("file write failed")));
    return true;
  }
  void expect_to_go_on() const {
    EXPECT_GE(read_checkpoint(folder_ / "run/checkpoint.h5").run.snapshots, 1);
    EXPECT_THAT(describe_file(folder_ / "run/particles.vtkhdf"), HasSubstr("time steps: "));
    EXPECT_THAT(describe_file(folder_ / "run/walls.vtkhdf"), HasSubstr("time steps: "));
    ASSERT_EQ(call(resume_command(), SLAGFLOW_PROGRAM), 0) << said();
    expect_same_results(folder_ / "run", folder_ / "unbroken");
  }

  const TempFolder folder_;
};

// The first hundreds of writes make the files.
TEST_P(FailingWrites, LeaveNothingFalseInARunThatBegins) {
  int failed = 0;
  for (int n = 1; n <= 400; n += n < 50 ? GetParam().step : 50) {
    SCOPED_TRACE(label(n));
    if (call_with_failure(run_command("run"), n)) ++failed;
    if (std::filesystem::exists(folder_ / "run/checkpoint.h5")) expect_to_go_on();
  }
  EXPECT_GT(failed, 40 / GetParam().step);
}

TEST_P(FailingWrites, LoseNothingThatWasComplete) {
  std::vector<std::string> begin = run_command("begun");
  begin.insert(begin.end(), {"--until", "0.0007"});
  ASSERT_EQ(call(begin, SLAGFLOW_PROGRAM), 0) << said();
  int failed = 0;
  for (int n = 1; n <= 300; n += n < 50 ? GetParam().step : 25) {
    SCOPED_TRACE(label(n));
    std::filesystem::remove_all(folder_ / "run");
    std::filesystem::copy(folder_ / "begun", folder_ / "run");
    if (call_with_failure(resume_command(), n)) ++failed;
    expect_to_go_on();
  }
  EXPECT_GT(failed, 40 / GetParam().step);
}

std::string mode_of(const testing::TestParamInfo<Failure>& info) { return info.param.mode; }

INSTANTIATE_TEST_SUITE_P(Disk, FailingWrites,
                         testing::Values(Failure{"once", 5}, Failure{"always", 5}, Failure{"torn", 5}),
                         mode_of);
INSTANTIATE_TEST_SUITE_P(DiskAtEveryWrite, FailingWrites,
                         testing::Values(Failure{"once", 1}, Failure{"always", 1}, Failure{"torn", 1}),
                         mode_of);

}  // namespace
}  // namespace slagflow
