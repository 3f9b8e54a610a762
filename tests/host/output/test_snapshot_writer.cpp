#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "backend/error.hpp"
#include "host/output/hdf5_handles.hpp"
#include "host/output/snapshot_writer.hpp"
#include "host/program/info.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing_tools::TempFolder;

void fill(Snapshot& s, double time, std::size_t count) {
  FluidSnapshot& p = s.particles;
  p.time = s.walls.time = time;
  p.position.assign(count, {time, 0, 0});
  p.velocity.assign(count, {1, 2, 3});
  for (auto* values : {&p.pressure, &p.density, &p.viscosity, &p.shear_rate, &p.shear_stress, &p.thickness})
    values->assign(count, static_cast<float>(time));
  p.yielded.assign(count, 1);
  p.fluid.assign(count, 0);
  p.id.assign(count, 7);
  s.walls.position.assign(3, {0, 0, -1});
  s.walls.pressure.assign(3, static_cast<float>(10 * time));
  s.walls.body.assign(3, 2);
}

TEST(SnapshotWriter, WritesAllThatWasQueuedInOrder) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {20, 3}, {{"case", "sample"}});
  for (int k = 0; k < 10; ++k)
    writer.write([k](Snapshot& s) { fill(s, k, static_cast<std::size_t>(20 - 2 * k)); });
  writer.close();
  const hdf5::File file = hdf5::File::open(folder / "particles.vtkhdf", hdf5::File::Access::read);
  std::vector<double> times(10);
  std::vector<std::int64_t> points(10);
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/Values"), {0, 10}, H5T_NATIVE_DOUBLE, times.data());
  read_rows(file, open_dataset(file, "/VTKHDF/NumberOfPoints"), {0, 10}, H5T_NATIVE_INT64, points.data());
  EXPECT_THAT(times, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(points, testing::ElementsAre(20, 18, 16, 14, 12, 10, 8, 6, 4, 2));
  EXPECT_THAT(describe_file(folder / "walls.vtkhdf"), testing::HasSubstr("Pressure      0 to 90 Pa"));
}

TEST(SnapshotWriter, StoresWallPointsOnce) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {5, 3}, {});
  for (int k = 0; k < 4; ++k) writer.write([k](Snapshot& s) { fill(s, k, 5); });
  writer.close();
  const hdf5::File file = hdf5::File::open(folder / "walls.vtkhdf", hdf5::File::Access::read);
  EXPECT_EQ(rows(file, open_dataset(file, "/VTKHDF/Points")), 3u);
}

TEST(SnapshotWriter, WritesNoWallsWhereThereAreNone) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {5, 0}, {});
  writer.write([](Snapshot& s) { fill(s, 0, 5); });
  writer.close();
  EXPECT_FALSE(writer.writes_walls());
  EXPECT_FALSE(std::filesystem::exists(folder / "walls.vtkhdf"));
}

TEST(SnapshotWriter, TellsAFailureOfItsThreadOnALaterCall) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {5, 0}, {});
  std::filesystem::remove(folder / "particles.vtkhdf");
  writer.write([](Snapshot& s) { fill(s, 0, 5); });
  try {
    for (int k = 0; k < 5; ++k) writer.write([](Snapshot& s) { fill(s, 1, 5); });
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("particles.vtkhdf"));
  }
}

TEST(SnapshotWriter, TellsAFailureOfTheLastSnapshotOnClose) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {5, 0}, {});
  std::filesystem::remove(folder / "particles.vtkhdf");
  writer.write([](Snapshot& s) { fill(s, 0, 5); });
  EXPECT_THROW(writer.close(), Error);
}

TEST(SnapshotWriter, GoesOnAfterAFillThatThrows) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {5, 0}, {});
  for (int k = 0; k < 3; ++k)
    EXPECT_THROW(writer.write([](Snapshot&) { throw std::runtime_error("device lost"); }),
                 std::runtime_error);
  writer.write([](Snapshot& s) { fill(s, 4, 5); });
  writer.close();
  EXPECT_THAT(describe_file(folder / "particles.vtkhdf"), testing::HasSubstr("time steps: 1"));
}

TEST(Info, TellsProvenanceStepsParticlesAndRanges) {
  const TempFolder folder;
  SnapshotWriter writer(folder.path(), {5, 0}, {{"case", "sample"}, {"version", "1.2.3"}});
  writer.write([](Snapshot& s) { fill(s, 0, 5); });
  writer.write([](Snapshot& s) { fill(s, 2, 4); });
  writer.close();
  const std::string text = describe_file(folder / "particles.vtkhdf");
  for (const char* part :
       {"case: sample", "version: 1.2.3", "time steps: 2, from 0 s to 2 s", "5 in the first, 4 in the last",
        "Pressure      0 to 2 Pa", "Velocity      1 to 3 m/s", "ParticleId    7 to 7"})
    EXPECT_THAT(text, testing::HasSubstr(part));
}

TEST(Info, RefusesWhatIsNoFileOfARun) {
  const TempFolder folder;
  EXPECT_THROW(describe_file(folder / "missing.vtkhdf"), InputError);
  std::ofstream(folder / "text.vtkhdf") << "no HDF5";
  EXPECT_THROW(describe_file(folder / "text.vtkhdf"), InputError);
}

}  // namespace
}  // namespace slagflow
