#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>

#include "backend/error.hpp"
#include "host/output/history.hpp"
#include "host/output/summary_json.hpp"
#include "host/run/log.hpp"
#include "host/run/progress.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing_tools::read_text_file;
using testing_tools::TempFolder;

TEST(HistoryFile, HasEachLineOnDiskAtOnce) {
  const TempFolder folder;
  HistoryFile history(folder / "h.csv", {"time_s", "step", "front_m"});
  EXPECT_EQ(read_text_file(folder / "h.csv"), "time_s,step,front_m\n");
  history.write({0.123456789, 1234567, -1.5e-7});
  EXPECT_EQ(read_text_file(folder / "h.csv"), "time_s,step,front_m\n0.123456789,1234567,-1.5e-07\n");
}

TEST(HistoryFile, LeavesUnknownNumbersEmpty) {
  const TempFolder folder;
  HistoryFile history(folder / "h.csv", {"a", "b"});
  history.write({std::nan(""), 2});
  EXPECT_EQ(read_text_file(folder / "h.csv"), "a,b\n,2\n");
}

TEST(HistoryFile, RefusesLinesThatDoNotFitTheHeader) {
  const TempFolder folder;
  HistoryFile history(folder / "h.csv", {"a", "b"});
  EXPECT_THROW(history.write({1}), Error);
}

TEST(HistoryFile, NamesTheFileThatCannotBeWritten) {
  const TempFolder folder;
  try {
    HistoryFile history(folder / "missing/h.csv", {"a"});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("missing/h.csv"));
    EXPECT_THAT(error.what(), testing::HasSubstr("No such file or directory"));
  }
}

TEST(HistoryFile, FailsOnAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_THROW(HistoryFile("/dev/full", {"a"}), Error);
}

TEST(Json, WritesNestedObjectsInOrder) {
  Json json = Json::object();
  json.set("b", 1).set("a", Json::object().set("x", 0.25)).set("none", Json()).set("empty", Json::object());
  EXPECT_EQ(json.text(),
            "{\n  \"b\": 1,\n  \"a\": {\n    \"x\": 0.25\n  },\n  \"none\": null,\n  \"empty\": {}\n}");
}

TEST(Json, ReplacesAKeyInItsPlace) {
  Json json = Json::object();
  json.set("a", 1).set("b", 2).set("a", 3);
  EXPECT_EQ(json.text(), "{\n  \"a\": 3,\n  \"b\": 2\n}");
}

TEST(Json, EscapesText) { EXPECT_EQ(Json("a\"b\\c\n\x01").text(), "\"a\\\"b\\\\c\\u000a\\u0001\""); }

TEST(Json, WritesNullForWhatIsNoNumber) {
  EXPECT_EQ(Json(std::nan("")).text(), "null");
  EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).text(), "null");
}

TEST(Log, KeepsInTheFileWhatWasSaidBeforeItsOpening) {
  const TempFolder folder;
  testing::internal::CaptureStderr();
  {
    Log log(Verbosity::normal);
    log.warning("early");
    log.open(folder / "log.txt");
    log.status("half-way");
    log.info("late");
  }
  const std::string shown = testing::internal::GetCapturedStderr();
  EXPECT_EQ(read_text_file(folder / "log.txt"), "warning: early\nlate\n");
  EXPECT_THAT(shown, testing::HasSubstr("warning: early\n"));
  EXPECT_THAT(shown, testing::HasSubstr("half-way"));
  EXPECT_THAT(shown, testing::EndsWith("late\n"));
}

TEST(Log, ShowsOnlyWarningsAndErrorsWhenQuiet) {
  const TempFolder folder;
  testing::internal::CaptureStderr();
  Log log(Verbosity::quiet);
  log.open(folder / "log.txt");
  log.info("chatter");
  log.status("half-way");
  log.warning("careful");
  log.error("broken");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: careful\nerror: broken\n");
}

TEST(Progress, TellsShareRatesAndTimeLeft) {
  const std::string line = progress_line({0.25, 1, 500, 1000000, 2.5}, 10);
  EXPECT_THAT(line, testing::HasSubstr("25.0 %"));
  EXPECT_THAT(line, testing::HasSubstr("50 steps/s"));
  EXPECT_THAT(line, testing::HasSubstr("1e+05 particle-steps/s"));
  EXPECT_THAT(line, testing::HasSubstr("2.5 iterations"));
  EXPECT_THAT(line, testing::HasSubstr("0:30 min left"));
}

TEST(StageLine, TellsTheStageUntilItEnds) {
  using std::chrono::milliseconds;
  std::mutex mutex;
  std::vector<std::string> lines;
  const auto last = [&] {
    const std::lock_guard<std::mutex> guard(mutex);
    return lines.empty() ? std::string() : lines.back();
  };
  {
    StageLine line(
        [&](const std::string& told) {
          const std::lock_guard<std::mutex> guard(mutex);
          lines.push_back(told);
        },
        {milliseconds(1), milliseconds(1)});
    for (const char* const what : {"filling the regions", "placing wall particles"}) {
      line.stage(what);
      while (last().rfind(std::string(what) + ", ", 0) != 0) std::this_thread::sleep_for(milliseconds(1));
    }
  }
  const std::size_t told = lines.size();
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_EQ(lines.size(), told);
}

TEST(StageLine, IsSilentWhereTheWorkIsShort) {
  std::vector<std::string> lines;
  {
    StageLine([&](const std::string& told) { lines.push_back(told); }).stage("filling the regions");
  }
  EXPECT_TRUE(lines.empty());
}

TEST(StartProgress, SaysNothingWithoutATerminal) {
  testing::internal::CaptureStderr();
  {
    StartProgress progress(Verbosity::normal);
    progress.stage()("filling the regions");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace slagflow
