// [limits] of a case, and what a run leaves that exceeds one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint.hpp"
#include "host/output/hdf5_handles.hpp"
#include "host/output/vtkhdf.hpp"
#include "host/run/run.hpp"
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

TEST(Limits, AreReadWrittenAndHandedOn) {
  const Case c = parse_case(tiny_case() + R"([limits]
interval = 4
max_speed = 2.5
max_compression = 0.03
max_lost_fraction = 0.25
min_time_step_ratio = 0.01
max_energy_growth = 0.5
)",
                            "t.toml");
  for (const Case& same : {c, parse_case(to_toml(c), "u.toml")}) {
    const LimitSetup limits = build_setup(same).setup.limits;
    EXPECT_EQ(limits.interval, 4);
    EXPECT_EQ(limits.max_speed, 2.5);
    EXPECT_EQ(limits.max_compression, 0.03);
    EXPECT_EQ(limits.max_lost_fraction, 0.25);
    EXPECT_EQ(limits.min_time_step_ratio, 0.01);
    EXPECT_EQ(limits.max_energy_growth, 0.5);
  }
}

TEST(Limits, SpeedIsThreeTimesThatOfSoundUnlessGiven) {
  for (const std::string& text : {tiny_case(), tiny_case() + "[limits]\nmax_speed = 'auto'\n"}) {
    const BuiltCase built = build_setup(parse_case(text, "t.toml"));
    EXPECT_EQ(built.setup.limits.max_speed, 15);
    EXPECT_THAT(to_toml(built.resolved), HasSubstr("max_speed = 15.0"));
  }
}

// The time steps of a file, and the largest speed in the last one.
struct Written {
  std::vector<double> times;
  float fastest = 0;
};

Written written(const std::string& path) {
  const hdf5::File file = hdf5::File::open(path, hdf5::File::Access::read);
  const auto steps = static_cast<hsize_t>(vtkhdf_steps(file));
  Written result;
  result.times.resize(steps);
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/Values"), {0, steps}, H5T_NATIVE_DOUBLE,
            result.times.data());
  std::int64_t first = 0, count = 0;
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/PointDataOffsets/Velocity"), {steps - 1, 1},
            H5T_NATIVE_INT64, &first);
  read_rows(file, open_dataset(file, "/VTKHDF/NumberOfPoints"), {steps - 1, 1}, H5T_NATIVE_INT64, &count);
  std::vector<Vector3<float>> velocity(static_cast<std::size_t>(count));
  read_rows(file, open_dataset(file, "/VTKHDF/PointData/Velocity"),
            {static_cast<hsize_t>(first), static_cast<hsize_t>(count)}, H5T_NATIVE_FLOAT, velocity.data());
  for (const auto& v : velocity) result.fastest = std::max(result.fastest, norm(v));
  return result;
}

TEST(Limits, RunThatExceedsOneLeavesABadSnapshotAndAGoodCheckpoint) {
  const TempFolder folder;
  RunOptions options;
  options.folder = folder / "run", options.threads = 1, options.verbosity = Verbosity::quiet;
  testing::internal::CaptureStderr();
  const RunOutcome outcome =
      run_case(parse_case(leaving_case("remove"), "t.toml",
                          {"limits.max_speed=1.001", "limits.interval=2", "region.0.pressure=zero",
                           "output.checkpoint_interval=1e-9"}),
               options);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("limits.max_speed is 1.001 m/s; particle "));
  EXPECT_EQ(outcome.exit_code(), 1);
  const Written w = written(folder / "run/particles.vtkhdf");
  EXPECT_GT(w.fastest, 1.001f);
  // A checkpoint before every step: the last one is a step or two older than the bad state.
  const Checkpoint good = read_checkpoint(folder / "run/checkpoint.h5");
  EXPECT_GT(good.run.time, 0);
  EXPECT_LT(good.run.time, w.times.back());
  EXPECT_THAT(read_text_file(folder / "run/log.txt"), HasSubstr("the last good state, at 0.0"));
  const BuiltCase built = build_setup(parse_case(good.text("case_text"), "t.toml"));
  Simulation restored(built.setup);
  restored.restore(good.state);
  EXPECT_LE(restored.totals().max_speed, 1.001);
}

TEST(Limits, AStateBeyondOneIsNoCheckpointAtTheEndEither) {
  const TempFolder folder;
  RunOptions options;
  options.folder = folder / "run", options.threads = 1, options.verbosity = Verbosity::quiet;
  testing::internal::CaptureStderr();
  const RunOutcome outcome = run_case(parse_case(leaving_case("remove"), "t.toml",
                                                 {"limits.max_speed=1.0003", "output.end_time=0.003",
                                                  "limits.interval=1000", "output.checkpoint_interval=0"}),
                                      options);
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(outcome.exit_code(), 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "run/checkpoint.h5"));
}

}  // namespace
}  // namespace slagflow
