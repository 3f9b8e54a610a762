#include "host/output/snapshot_reader.hpp"

#include <algorithm>

#include "backend/error.hpp"
#include "host/output/hdf5_handles.hpp"
#include "host/output/vtkhdf.hpp"

namespace slagflow {
namespace {

using hdf5::File;
using hdf5::Handle;

hsize_t number_at(const File& file, const std::string& table, std::size_t row) {
  std::int64_t value = 0;
  read_rows(file, open_dataset(file, table), {row, 1}, H5T_NATIVE_INT64, &value);
  if (value < 0) throw Error(file.path() + ": " + table + " holds a negative number");
  return static_cast<hsize_t>(value);
}

// The rows of one snapshot; `components` numbers each.
class Rows {
 public:
  Rows(const File& file, std::size_t number)
      : file_(file), number_(number), count_(number_at(file, "/VTKHDF/NumberOfPoints", number)) {}

  template <class T>
  void read(const std::string& name, hsize_t components, hid_t type, std::vector<T>& values) const {
    const bool points = name == "Points";
    const std::string path = points ? "/VTKHDF/Points" : "/VTKHDF/PointData/" + name;
    const Handle table = open_dataset(file_, path);
    const hsize_t first = number_at(
        file_, points ? "/VTKHDF/Steps/PointOffsets" : "/VTKHDF/Steps/PointDataOffsets/" + name, number_);
    if (columns(file_, table) != components || count_ > rows(file_, table) ||
        first > rows(file_, table) - count_)
      throw Error(file_.path() + ": " + path + " does not hold snapshot " + std::to_string(number_));
    values.resize(count_);
    read_rows(file_, table, {first, count_}, type, values.data());
  }

 private:
  const File& file_;
  std::size_t number_;
  hsize_t count_;
};

}  // namespace

SnapshotList list_snapshots(const std::string& path) {
  const hdf5::QuietErrors quiet;
  const File file = File::open(path, File::Access::read);
  SnapshotList list;
  list.times.resize(static_cast<std::size_t>(vtkhdf_steps(file)));
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/Values"), {0, list.times.size()}, H5T_NATIVE_DOUBLE,
            list.times.data());
  list.texts = read_texts(file, open_group(file, "/VTKHDF"));
  return list;
}

FluidSnapshot read_snapshot(const std::string& path, std::size_t number) {
  const hdf5::QuietErrors quiet;
  const File file = File::open(path, File::Access::read);
  FluidSnapshot snapshot;
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/Values"), {number, 1}, H5T_NATIVE_DOUBLE, &snapshot.time);
  const Rows rows(file, number);
  rows.read("Points", 3, H5T_NATIVE_DOUBLE, snapshot.position);
  rows.read("Velocity", 3, H5T_NATIVE_FLOAT, snapshot.velocity);
  rows.read("Density", 1, H5T_NATIVE_FLOAT, snapshot.density);
  rows.read("Fluid", 1, H5T_NATIVE_UINT8, snapshot.fluid);
  rows.read("ParticleId", 1, H5T_NATIVE_INT64, snapshot.id);
  const std::vector<std::string> arrays = hdf5::members(file, "/VTKHDF/PointData");
  snapshot.heat = std::find(arrays.begin(), arrays.end(), "Temperature") != arrays.end();
  if (snapshot.heat) rows.read("Temperature", 1, H5T_NATIVE_FLOAT, snapshot.temperature);
  return snapshot;
}

}  // namespace slagflow
