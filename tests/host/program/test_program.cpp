#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/program/program.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

struct Result {
  int code;
  std::string out, err;
};

Result call(std::vector<std::string> arguments) {
  std::vector<const char*> argv{"slagflow"};
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = run_program(static_cast<int>(argv.size()), argv.data());
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

class Program : public testing::Test {
 protected:
  Program() { std::ofstream(case_file()) << tiny_case(); }
  std::string case_file() const { return folder_ / "tiny.toml"; }

  const TempFolder folder_;
};

TEST_F(Program, TellsVersionBuildAndDevice) {
  const Result result = call({"--version"});
  EXPECT_EQ(result.code, 0);
  for (const char* part : {"slagflow ", "commit ", "build ", "device "})
    EXPECT_THAT(result.out, HasSubstr(part));
}

TEST_F(Program, HelpNamesTheCommands) {
  const Result result = call({"--help"});
  EXPECT_EQ(result.code, 0);
  for (const char* part : {"run", "resume", "check", "info", "rheometry"})
    EXPECT_THAT(result.out, HasSubstr(part));
}

TEST_F(Program, AWordThatIsNoCommandIsNamed) {
  const Result result = call({"rnu", case_file()});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("command 'rnu': unknown: did you mean 'run'? allowed: run, resume, check"));
}

TEST_F(Program, AnUnusableOutputIsAMistake) {
  const Result run = call({"run", case_file(), "-o", case_file() + "/out"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("cannot create the folder " + case_file() + "/out: Not a directory"));
  const std::string curve = folder_ / "curve.csv";
  std::ofstream(curve) << "shear_rate_1/s,shear_stress_Pa\n1,3\n2,4\n5,7\n10,12\n";
  const Result fit = call({"rheometry", curve, "-o", folder_ / "none/fluid.toml"});
  EXPECT_EQ(fit.code, 2);
  EXPECT_THAT(fit.err, HasSubstr("is no folder that can be written to"));
}

TEST_F(Program, BadArgumentsGiveTwo) {
  EXPECT_EQ(call({}).code, 2);
  EXPECT_EQ(call({"walk"}).code, 2);
  EXPECT_EQ(call({"run"}).code, 2);
  EXPECT_EQ(call({"run", case_file(), "--threads", "0"}).code, 2);
  for (const char* until : {"-1", "0", "nan", "inf", "1e31", "soon"}) {
    const Result refused = call({"run", case_file(), "--until", until});
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr(std::string("--until: value ") + until + ": allowed: a number > 0.0"));
  }
  const Result result = call({"run", case_file(), "--fast"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("--fast"));
}

TEST_F(Program, RunNeedsACaseOrAState) {
  EXPECT_THAT(call({"run"}).err, HasSubstr("neither a case nor --from"));
  EXPECT_EQ(call({"run", "--from", folder_ / "none"}).code, 2);
  EXPECT_EQ(call({"run", "--from", ""}).code, 2);
  for (const char* form : {"--man", "--completion"}) {
    const std::string text = call({"help", form}).out;
    EXPECT_THAT(text, HasSubstr(form[2] == 'm' ? "\\-\\-from" : "--from"));
  }
}

TEST_F(Program, ResumeTakesKeysThatMayChange) {
  EXPECT_EQ(call({"run", case_file(), "-o", folder_ / "run", "--quiet"}).code, 0);
  EXPECT_EQ(call({"resume", folder_ / "run", "--quiet", "--set", "output.end_time=0.006"}).code, 0);
  EXPECT_THAT(read_text_file(folder_ / "run/case.toml"), HasSubstr("end_time = 0.006"));
  EXPECT_EQ(call({"resume", folder_ / "run", "--quiet", "--set", "fluid.oil.density=900"}).code, 2);
}

TEST_F(Program, MissingCaseFileGivesTwo) {
  const Result result = call({"run", folder_ / "none.toml"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("none.toml"));
}

TEST_F(Program, BadCaseGivesTwoWithFileAndLine) {
  std::ofstream(folder_ / "bad.toml") << tiny_case() << "[outputs]\n";
  const Result result = call({"check", folder_ / "bad.toml"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("bad.toml:"));
  EXPECT_THAT(result.err, HasSubstr("outputs"));
}

TEST_F(Program, RunsACaseAndRefusesToReplaceIt) {
  const std::string folder = folder_ / "out";
  const Result first = call(
      {"run", case_file(), "--threads", "1", "-o", folder, "--quiet", "--set", "measure.0.fraction=0.3"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("results in " + folder));
  EXPECT_THAT(first.out, HasSubstr("spread (front): "));
  EXPECT_EQ(first.err, "");

  const Result second = call({"run", case_file(), "--threads", "1", "-o", folder});
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.err, HasSubstr(folder));
  EXPECT_THAT(second.err, HasSubstr("--overwrite"));
  const Result third = call({"run", case_file(), "--threads", "1", "-o", folder, "--overwrite", "--quiet"});
  EXPECT_EQ(third.code, 0);
  EXPECT_THAT(third.err, HasSubstr("warning: measure 'spread' has arrived at the start already"));
}

TEST_F(Program, SetsKeysOfTheCase) {
  const std::string folder = folder_ / "out";
  const Result result = call({"run", case_file(), "--threads", "1", "-o", folder, "--quiet", "--set",
                              "fluid.oil.yield_stress=7.25", "--set", "output.end_time=1e-3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(read_text_file(folder + "/case.toml"), HasSubstr("7.25"));
  const Result bad = call({"check", case_file(), "--set", "fluid.oil.yield_stress=-1"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.err, HasSubstr("yield_stress"));
}

TEST_F(Program, CheckTellsSizesNumbersAndCost) {
  const Result result = call({"check", case_file()});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* part : {"125 fluid", "support radius", "limited by", "Reynolds", "Bingham", "N ", "Mach",
                           "memory", "run time"})
    EXPECT_THAT(result.out, HasSubstr(part));
}

TEST_F(Program, InfoDescribesAFileOfARun) {
  call({"run", case_file(), "--threads", "1", "-o", folder_ / "out", "--quiet"});
  const Result result = call({"info", folder_ / "out/particles.vtkhdf"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, HasSubstr("case: tiny"));
  const Result missing = call({"info", folder_ / "none.vtkhdf"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("none.vtkhdf"));
}

}  // namespace
}  // namespace slagflow
