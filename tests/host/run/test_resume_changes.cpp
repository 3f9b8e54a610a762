// Runs whose case has changed before they go on, and folders that lack a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "backend/error.hpp"
#include "host/geometry_cases.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/run/run.hpp"
#include "host/run/run_loop.hpp"
#include "host/same_results.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing_tools::expect_same_results;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

class ChangedRun : public testing::Test {
 protected:
  ChangedRun() {
    std::ofstream(folder_ / "tiny.toml") << tiny_case("0.006");
    begin("run");
  }

  RunOptions options(const std::string& name) const {
    RunOptions o;
    o.folder = folder_ / name, o.threads = 1, o.verbosity = Verbosity::quiet;
    return o;
  }
  void begin(const std::string& name, const std::vector<std::string>& sets = {}, double until = 0.003) const {
    RunOptions o = options(name);
    o.until = until;
    ASSERT_EQ(run_case(load_case(folder_ / "tiny.toml", sets), o).exit_code(), 0);
  }
  RunOutcome resume(const std::vector<std::string>& changes = {}, const std::string& name = "run") const {
    RunOptions o = options(name);
    o.changes = changes;
    return resume_run(o);
  }
  std::string refusal(const std::vector<std::string>& changes = {}) const {
    try {
      resume(changes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  void edit(const std::string& from, const std::string& to) const {
    std::string text = read_text_file(folder_ / "run/case.toml");
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(folder_ / "run/case.toml") << text.replace(at, from.size(), to);
  }
  std::string file(const std::string& name) const { return read_text_file(folder_ / "run/" + name); }

  const TempFolder folder_;
};

// Of a wall beside the fluid: the file has gone to another folder since.
TEST_F(ChangedRun, GoesOnWithAnStlFileThatHasMoved) {
  const std::string before = folder_ / "before.stl", after = folder_ / "after.stl";
  std::ofstream(before, std::ios::binary)
      << binary_stl(box_triangles({-0.02, -0.02, -0.02}, {0.02, 0.02, -0.006}));
  std::ofstream(folder_ / "tiny.toml")
      << tiny_case("0.006") << "[[wall]]\nname = 'block'\nshapes = [{shape='stl', file='" << before
      << "'}]\n";
  begin("moved"), begin("whole", {}, 0.006);
  std::filesystem::rename(before, after);
  RunOptions o = options("moved");
  o.until = 0.006;
  o.changes = {"wall.1.shapes.0.file=" + after};
  EXPECT_EQ(resume_run(o).exit_code(), 0);
  EXPECT_EQ(read_text_file(folder_ / "moved/history.csv"), read_text_file(folder_ / "whole/history.csv"));
}

TEST_F(ChangedRun, RefusesAnEditOfTheFlowNamingBothValuesAndTheWayOut) {
  const std::string history = file("history.csv");
  edit("yield_stress = 5.0", "yield_stress = 8.0");
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("case.toml:"),
                    HasSubstr("key 'fluid.oil.yield_stress': value 8.0, the run has 5.0: cannot change"),
                    HasSubstr("allowed: output.*"),
                    HasSubstr("slagflow run --from " + (folder_ / "run") +
                              " --set fluid.oil.yield_stress=8.0 -o NEW")));
  EXPECT_EQ(file("history.csv"), history);
}

TEST_F(ChangedRun, RefusesEachKeyThatMustStay) {
  for (const char* change : {"gravity.acceleration=[0,0,-5]", "resolution.spacing=1e-3", "output.walls=false",
                             "case.name=other", "measure.0.fraction=0.2", "numerics.sound_speed=6",
                             "wall.0.contact_angle=60", "region.0.velocity=[1,0,0]"})
    EXPECT_THAT(refusal({change}), AllOf(HasSubstr("cannot change while it goes on"), HasSubstr("--set ")))
        << change;
  EXPECT_THAT(refusal({"output.interval=-1"}), HasSubstr("--set output.interval=-1"));
  edit("yield_stress = 5.0", "yield_stress = five");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("case.toml:"), HasSubstr("without it the run goes on as it was")));
}

TEST_F(ChangedRun, TakesTheSameChangesFromSetAndFromTheFileAndRemembersThem) {
  begin("set");
  EXPECT_EQ(
      resume({"output.end_time=0.005", "limits.max_speed=9", "numerics.tolerance=0.02"}, "set").exit_code(),
      0);
  edit("end_time = 0.006", "end_time = 0.005"), edit("until = 0.003", "until = \"end_time\"");
  edit("max_speed = 15.0", "max_speed = 9.0"), edit("tolerance = 0.01", "tolerance = 0.02");
  EXPECT_EQ(resume().exit_code(), 0);
  expect_same_results(folder_ / "run", folder_ / "set");
  for (const std::string& text :
       {file("summary.json"), read_checkpoint(folder_ / "run/checkpoint.h5").text("changes")})
    EXPECT_THAT(
        text, AllOf(HasSubstr("at 0.003"), HasSubstr("output.end_time 0.006 -> 0.005"),
                    HasSubstr("limits.max_speed 15.0 -> 9.0"), HasSubstr("numerics.tolerance 0.01 -> 0.02")));
  EXPECT_EQ(resume({"output.end_time=0.007"}).exit_code(), 0);
  EXPECT_THAT(file("case.toml"), AllOf(HasSubstr("end_time = 0.007"), HasSubstr("max_speed = 9.0")));
  EXPECT_THAT(file("summary.json"),
              AllOf(HasSubstr("-> 0.005"), HasSubstr("output.end_time 0.005 -> 0.007")));
}

TEST_F(ChangedRun, WritesAtANewIntervalFromThereOn) {
  EXPECT_EQ(resume({"output.until=0.006", "output.interval=0.003"}).exit_code(), 0);
  EXPECT_EQ(testing_tools::tables_of(folder_ / "run/particles.vtkhdf").at("/VTKHDF/Steps/Values").size(), 5U);
  Schedule due(0.01);
  due.restore(0.05, 0.0123);
  EXPECT_DOUBLE_EQ(due.next(), 0.02);
  due.restore(0.02, 0.0123);
  EXPECT_EQ(due.next(), 0.02);
}

TEST_F(ChangedRun, WritesALostCaseAnew) {
  const std::string written = file("case.toml");
  for (const char* name : {"case.toml", "summary.json", "log.txt"})
    std::filesystem::remove(folder_ / "run/" + name);
  EXPECT_EQ(resume().exit_code(), 0);
  EXPECT_EQ(file("case.toml"), written);
  EXPECT_THAT(file("log.txt"), HasSubstr("case.toml was missing"));
}

TEST_F(ChangedRun, NamesAllOutputsThatAreMissingAndLeavesTheRest) {
  const std::string before = file("checkpoint.h5");
  const std::vector<std::string> outputs{"history.csv", "particles.vtkhdf", "walls.vtkhdf",
                                         "profile_height.csv"};
  for (const std::string& name : outputs) std::filesystem::remove(folder_ / "run/" + name);
  const std::string message = refusal();
  for (const std::string& name : outputs) EXPECT_THAT(message, HasSubstr("run/" + name + ": is missing"));
  EXPECT_THAT(message, HasSubstr("slagflow run --from " + (folder_ / "run") + " -o NEW"));
  EXPECT_EQ(file("checkpoint.h5"), before);
}

TEST_F(ChangedRun, PointsAtItsSnapshotsWhereNoCheckpointIsLeft) {
  for (const char* name : {"checkpoint.h5", "checkpoint.previous.h5"})
    std::filesystem::remove(folder_ / "run/" + name);
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("holds no checkpoint.h5"), HasSubstr("slagflow run --from DIR@TIME")));
}

}  // namespace
}  // namespace slagflow
