#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "backend/error.hpp"
#include "host/output/hdf5_handles.hpp"
#include "host/output/vtkhdf.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing_tools::TempFolder;

// Points and data that follow from the step and the point number; read_vtkhdf.py knows the same formulas.
struct Sample {
  std::vector<Vec3d> position;
  std::vector<Vector3<float>> velocity;
  std::vector<float> pressure;
  std::vector<std::uint8_t> fluid;
  std::vector<std::int64_t> id;

  Sample(int step, int count) {
    for (int i = 0; i < count; ++i) {
      const auto s = static_cast<float>(step), k = static_cast<float>(i);
      position.push_back({3e6 + 1e-3 * i, static_cast<double>(step), -static_cast<double>(i)});
      velocity.push_back({s, k, s + k});
      pressure.push_back(1000 * s + k);
      fluid.push_back(static_cast<std::uint8_t>(i % 3));
      id.push_back(10000000000 + i);
    }
  }
  PointStep at(double time) const { return {time, position, {velocity, pressure, fluid, id}}; }
};

std::vector<ArrayInfo> sample_arrays() {
  return {{"Velocity", "m/s", "velocity", ArrayType::float32, 3},
          {"Pressure", "Pa", "pressure", ArrayType::float32, 1},
          {"Fluid", "1", "index of the fluid", ArrayType::uint8, 1},
          {"ParticleId", "1", "number", ArrayType::int64, 1}};
}

void write_sample(const VtkhdfWriter& writer, const std::vector<int>& counts, std::size_t expected) {
  writer.create({{"case", "sample"}, {"case_text", std::string(100000, 'x')}}, expected);
  for (std::size_t s = 0; s < counts.size(); ++s)
    writer.append(Sample(static_cast<int>(s), counts[s]).at(0.5 * static_cast<double>(s)));
}

std::int64_t steps_of(const std::string& path) {
  return vtkhdf_steps(hdf5::File::open(path, hdf5::File::Access::read));
}

std::vector<float> pressure_of(const std::string& path, std::int64_t step) {
  const hdf5::File file = hdf5::File::open(path, hdf5::File::Access::read);
  std::int64_t first = 0, count = 0;
  const hdf5::RowRange row{static_cast<hsize_t>(step), 1};
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/PointDataOffsets/Pressure"), row, H5T_NATIVE_INT64,
            &first);
  read_rows(file, open_dataset(file, "/VTKHDF/NumberOfPoints"), row, H5T_NATIVE_INT64, &count);
  std::vector<float> values(static_cast<std::size_t>(count));
  read_rows(file, open_dataset(file, "/VTKHDF/PointData/Pressure"),
            {static_cast<hsize_t>(first), static_cast<hsize_t>(count)}, H5T_NATIVE_FLOAT, values.data());
  return values;
}

// As if the process had been stopped while it wrote a further step, before its number.
void set_steps(const std::string& path, std::int64_t steps) {
  hdf5::File file = hdf5::File::open(path, hdf5::File::Access::change);
  write_integers(file, open_group(file, "/VTKHDF/Steps"), "NSteps", {steps});
  const auto rows = static_cast<hsize_t>(steps);
  for (const char* name : {"/VTKHDF/Steps/Values", "/VTKHDF/NumberOfPoints"})
    H5Dset_extent(open_dataset(file, name), &rows);
  file.close();
}

// Read back by read_vtkhdf.py with VTK's reader, from the folder that the variable names.
TEST(Vtkhdf, WritesSamplesForOtherReaders) {
  const TempFolder own;
  const char* given = std::getenv("SLAGFLOW_VTK_SAMPLES");
  const std::string folder = given != nullptr ? given : own.path();
  write_sample({folder + "/small.vtkhdf", sample_arrays()}, {5, 3, 0, 7, 1}, 4);
  write_sample({folder + "/empty_start.vtkhdf", sample_arrays()}, {0, 2}, 0);
  write_sample({folder + "/one_step.vtkhdf", sample_arrays()}, {3}, 3);
  write_sample({folder + "/large.vtkhdf", sample_arrays()}, {100000, 99990, 100000}, 100000);

  write_sample({folder + "/stopped.vtkhdf", sample_arrays()}, {5, 3, 4, 2}, 4);
  set_steps(folder + "/stopped.vtkhdf", 2);
  write_sample({folder + "/stopped_early.vtkhdf", sample_arrays()}, {5, 3}, 4);
  set_steps(folder + "/stopped_early.vtkhdf", 1);

  const VtkhdfWriter fixed(folder + "/fixed.vtkhdf", {{"Pressure", "Pa", "pressure", ArrayType::float32, 1}});
  fixed.create({}, 4);
  const Sample first(0, 4), second(1, 4), third(2, 4);
  fixed.append({0, first.position, {first.pressure}});
  fixed.append_at_same_points({0.5, first.position, {second.pressure}});
  fixed.append_at_same_points({1, first.position, {third.pressure}});

  EXPECT_EQ(steps_of(folder + "/small.vtkhdf"), 5);
  EXPECT_EQ(steps_of(folder + "/fixed.vtkhdf"), 3);
}

TEST(Vtkhdf, HoldsEachStepsValues) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  write_sample(writer, {5, 3, 0, 7}, 4);
  EXPECT_THAT(pressure_of(writer.path(), 0), testing::ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(pressure_of(writer.path(), 1), testing::ElementsAre(1000, 1001, 1002));
  EXPECT_TRUE(pressure_of(writer.path(), 2).empty());
  EXPECT_EQ(pressure_of(writer.path(), 3).back(), 3006);
}

TEST(Vtkhdf, CarriesUnitsAndProvenance) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  write_sample(writer, {2}, 2);
  const hdf5::File file = hdf5::File::open(writer.path(), hdf5::File::Access::read);
  EXPECT_THAT(read_texts(file, open_dataset(file, "/VTKHDF/PointData/Pressure")),
              testing::Contains(testing::Pair("units", "Pa")));
  EXPECT_THAT(read_texts(file, open_dataset(file, "/VTKHDF/Points")),
              testing::Contains(testing::Pair("units", "m")));
  EXPECT_THAT(read_texts(file, open_group(file, "/VTKHDF")),
              testing::IsSupersetOf({testing::Pair("case", "sample"), testing::Pair("Type", "PolyData")}));
}

TEST(Vtkhdf, OverwritesRowsBeyondTheLastStep) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  write_sample(writer, {5, 6, 7}, 4);
  set_steps(writer.path(), 1);
  writer.append(Sample(8, 2).at(4));
  EXPECT_EQ(steps_of(writer.path()), 2);
  EXPECT_EQ(pressure_of(writer.path(), 0).size(), 5u);
  EXPECT_THAT(pressure_of(writer.path(), 1), testing::ElementsAre(8000, 8001));
  const hdf5::File file = hdf5::File::open(writer.path(), hdf5::File::Access::read);
  EXPECT_EQ(rows(file, open_dataset(file, "/VTKHDF/Steps/Values")), 2u);
  EXPECT_EQ(rows(file, open_dataset(file, "/VTKHDF/NumberOfPoints")), 2u);
}

TEST(Vtkhdf, DoesNotCountAStepWithoutItsTime) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  write_sample(writer, {5, 6}, 4);
  {
    hdf5::File file = hdf5::File::open(writer.path(), hdf5::File::Access::change);
    write_integers(file, open_group(file, "/VTKHDF/Steps"), "NSteps", {3});
    EXPECT_EQ(vtkhdf_steps(file), 2);
    file.close();
  }
  writer.append(Sample(8, 2).at(4));
  EXPECT_EQ(steps_of(writer.path()), 3);
  EXPECT_THAT(pressure_of(writer.path(), 2), testing::ElementsAre(8000, 8001));
}

TEST(Vtkhdf, StaysReadableWhenTheProcessIsKilled) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  writer.create({}, 1000);
  for (int round = 0; round < 5; ++round) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
      for (int s = 0; s < 3; ++s) writer.append(Sample(3 * round + s, 1000 - s).at(3 * round + s));
      const char done = 1;
      if (write(ready[1], &done, 1) != 1) _exit(1);
      pause();
    }
    char done = 0;
    ASSERT_EQ(read(ready[0], &done, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(ready[0]);
    close(ready[1]);
    ASSERT_EQ(steps_of(writer.path()), 3 * (round + 1));
  }
  for (int s = 0; s < 15; ++s) {
    ASSERT_EQ(pressure_of(writer.path(), s).size(), static_cast<std::size_t>(1000 - s % 3));
    EXPECT_EQ(pressure_of(writer.path(), s)[7], 1000.0f * static_cast<float>(s) + 7);
  }
}

TEST(Vtkhdf, StaysSmall) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  write_sample(writer, std::vector<int>(10, 20000), 20000);
  const double raw = 10 * 20000.0 * (24 + 12 + 4 + 1 + 8);
  EXPECT_LT(static_cast<double>(std::filesystem::file_size(writer.path())), raw);
}

TEST(Vtkhdf, NamesFileAndReasonWhenTheFolderIsMissing) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "missing/p.vtkhdf", sample_arrays());
  try {
    writer.create({}, 1);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("missing/p.vtkhdf"));
    EXPECT_THAT(error.what(), testing::HasSubstr("No such file or directory"));
  }
}

TEST(Vtkhdf, NamesFileAndReasonWhenTheFolderIsNotWritable) {
  if (geteuid() == 0) GTEST_SKIP() << "root writes everywhere";
  const TempFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read);
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  try {
    writer.create({}, 1);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("p.vtkhdf"));
    EXPECT_THAT(error.what(), testing::HasSubstr("Permission denied"));
  }
}

// A limit on the size of files stands for a full disk: a write beyond it fails.
int append_until_full(const VtkhdfWriter& writer) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{6 << 20, 6 << 20};
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    for (int s = 0; s < 1000; ++s) writer.append(Sample(s, 5000).at(s));
  } catch (const Error& error) {
    const std::string message = error.what();
    return message.find("p.vtkhdf") != std::string::npos &&
                   message.find("File too large") != std::string::npos
               ? 0
               : (std::fprintf(stderr, "%s\n", error.what()), 1);
  }
  return 2;
}

TEST(Vtkhdf, KeepsEarlierStepsWhenTheDiskIsFull) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", sample_arrays());
  writer.create({}, 5000);
  const pid_t child = fork();
  if (child == 0) std::exit(append_until_full(writer));
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const std::int64_t steps = steps_of(writer.path());
  ASSERT_GT(steps, 2);
  for (std::int64_t s = 0; s < steps; ++s)
    EXPECT_EQ(pressure_of(writer.path(), s).back(), 1000.0f * static_cast<float>(s) + 4999);
}

TEST(Vtkhdf, RefusesArraysOfTheWrongLength) {
  const TempFolder folder;
  const VtkhdfWriter writer(folder / "p.vtkhdf", {{"Pressure", "Pa", "pressure", ArrayType::float32, 1}});
  writer.create({}, 2);
  const Sample two(0, 2), three(0, 3);
  EXPECT_THROW(writer.append({0, two.position, {three.pressure}}), Error);
  EXPECT_EQ(steps_of(writer.path()), 0);
}

}  // namespace
}  // namespace slagflow
