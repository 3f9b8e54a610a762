#include "host/output/vtkhdf.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <numeric>

#include "backend/error.hpp"
#include "host/output/hdf5_handles.hpp"

namespace slagflow {
namespace {

using hdf5::File;
using hdf5::Handle;
using hdf5::RowRange;
using hdf5::Storage;
using hdf5::TableLayout;

constexpr std::array<const char*, 4> topologies{"Vertices", "Lines", "Polygons", "Strips"};
constexpr hsize_t longest_chunk = 65536;  // rows
constexpr hsize_t steps_per_chunk = 512;
constexpr std::size_t bytes_of_indices = 1 << 20;  // ample for what HDF5 itself adds in one step

constexpr const char* point_offsets = "/VTKHDF/Steps/PointOffsets";
constexpr const char* times = "/VTKHDF/Steps/Values";
constexpr const char* cell_offsets = "/VTKHDF/Steps/CellOffsets";

std::string data_offsets(const ArrayInfo& info) { return "/VTKHDF/Steps/PointDataOffsets/" + info.name; }

hid_t hdf5_type(ArrayType type) {
  switch (type) {
    case ArrayType::uint8:
      return H5T_NATIVE_UINT8;
    case ArrayType::int64:
      return H5T_NATIVE_INT64;
    default:
      return H5T_NATIVE_FLOAT;
  }
}

std::size_t row_bytes(const ArrayInfo& info) {
  return H5Tget_size(hdf5_type(info.type)) * static_cast<std::size_t>(info.components);
}

// Equal chunks that hold a usual step with little left over.
hsize_t chunk_for(std::size_t points) {
  const hsize_t count = std::max<hsize_t>(points, 1);
  const hsize_t chunks = (count + longest_chunk - 1) / longest_chunk;
  return (count + chunks - 1) / chunks;
}

void create_described(const File& file, const std::string& path, const TableLayout& layout,
                      const ArrayInfo& info) {
  const Handle table = create_table(file, path, layout);
  write_text(file, table, "units", info.units);
  write_text(file, table, "description", info.meaning);
}

void create_integers(const File& file, const std::string& path, int components = 0) {
  TableLayout layout;
  layout.type = H5T_NATIVE_INT64;
  layout.components = components;
  layout.chunk_rows = steps_per_chunk;
  create_described(file, path, layout, {"", "1", "index or count", ArrayType::int64, 1});
}

void create_topologies(const File& file, std::size_t points_expected) {
  for (const char* name : topologies) {
    const std::string group = std::string("/VTKHDF/") + name;
    create_group(file, group);
    create_integers(file, group + "/NumberOfCells");
    create_integers(file, group + "/NumberOfConnectivityIds");
    if (name != topologies[0]) {
      create_integers(file, group + "/Connectivity");
      create_integers(file, group + "/Offsets");
      continue;
    }
    TableLayout layout;
    layout.type = H5T_NATIVE_INT64;
    layout.storage = Storage::compressed;
    layout.chunk_rows = chunk_for(points_expected);
    const ArrayInfo numbers{"", "1", "point numbers, the same for all steps", ArrayType::int64, 1};
    create_described(file, group + "/Connectivity", layout, numbers);
    layout.chunk_rows = chunk_for(points_expected + 2);
    const ArrayInfo offsets{"", "1", "first connectivity of each vertex", ArrayType::int64, 1};
    create_described(file, group + "/Offsets", layout, offsets);
  }
}

void create_steps(const File& file, const std::vector<ArrayInfo>& arrays) {
  const Handle steps = create_group(file, "/VTKHDF/Steps");
  write_integers(file, steps, "NSteps", {0});
  TableLayout layout;
  layout.type = H5T_NATIVE_DOUBLE;
  layout.chunk_rows = steps_per_chunk;
  create_described(file, times, layout, {"", "s", "time of each step", ArrayType::float32, 1});
  for (const char* name : {"PartOffsets", "NumberOfParts", "PointOffsets"})
    create_integers(file, std::string("/VTKHDF/Steps/") + name);
  for (const char* name : {"CellOffsets", "ConnectivityIdOffsets"})
    create_integers(file, std::string("/VTKHDF/Steps/") + name, static_cast<int>(topologies.size()));
  create_group(file, "/VTKHDF/Steps/PointDataOffsets");
  for (const ArrayInfo& info : arrays) create_integers(file, data_offsets(info));
}

void create_points(const File& file, const std::vector<ArrayInfo>& arrays, hsize_t chunk) {
  TableLayout layout;
  layout.components = 3;
  layout.chunk_rows = chunk;
  layout.storage = Storage::compressed;
  layout.type = H5T_NATIVE_DOUBLE;
  create_described(file, "/VTKHDF/Points", layout, {"", "m", "position", ArrayType::float32, 3});
  create_group(file, "/VTKHDF/PointData");
  for (const ArrayInfo& info : arrays) {
    layout.type = hdf5_type(info.type);
    layout.components = info.components == 1 ? 0 : info.components;
    create_described(file, "/VTKHDF/PointData/" + info.name, layout, info);
  }
}

// Takes the disk space before the first byte is changed: HDF5 does not survive a write that fails half-way.
// HDF5 itself cuts off what it did not need when it closes the file.
void reserve(const std::string& path, std::size_t bytes) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) throw Error("cannot write to " + path + ": " + std::strerror(errno));
  struct stat state {};
  fstat(file, &state);
  const int failure = posix_fallocate(file, state.st_size, static_cast<off_t>(bytes));
  const bool no_space = failure == ENOSPC || failure == EFBIG || failure == EDQUOT;
  const bool restored = !no_space || ftruncate(file, state.st_size) == 0;
  ::close(file);
  if (no_space)
    throw Error("cannot write to " + path + ": " + std::strerror(failure) +
                " (the next time step needs up to " + std::to_string(bytes >> 10) + " KiB)" +
                (restored ? "" : "; its end could not be restored"));
}

// The first number of a row.
std::int64_t read_entry(const File& file, const std::string& path, std::int64_t row) {
  std::array<std::int64_t, topologies.size()> values{};
  read_rows(file, open_dataset(file, path), {static_cast<hsize_t>(row), 1}, H5T_NATIVE_INT64, values.data());
  return values[0];
}

void write_entry(const File& file, const std::string& path, std::int64_t row,
                 const std::vector<std::int64_t>& values) {
  write_table(file, path, {static_cast<hsize_t>(row), 1}, H5T_NATIVE_INT64, values.data());
}

// First row behind what the steps so far hold, at the start of a chunk.
std::int64_t next_row(const File& file, std::int64_t steps, const std::string& offsets,
                      const std::string& table) {
  if (steps == 0) return 0;
  const std::int64_t end =
      read_entry(file, offsets, steps - 1) + read_entry(file, "/VTKHDF/NumberOfPoints", steps - 1);
  const auto chunk = static_cast<std::int64_t>(chunk_rows(file, open_dataset(file, table)));
  return (end + chunk - 1) / chunk * chunk;
}

std::vector<std::int64_t> numbers(std::int64_t first, hsize_t count) {
  std::vector<std::int64_t> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

// Of all steps so far.
hsize_t most_points(const File& file, std::int64_t steps) {
  std::vector<std::int64_t> points(static_cast<std::size_t>(steps));
  read_rows(file, open_dataset(file, "/VTKHDF/NumberOfPoints"), {0, points.size()}, H5T_NATIVE_INT64,
            points.data());
  return points.empty() ? 0 : static_cast<hsize_t>(*std::max_element(points.begin(), points.end()));
}

// Returns the row of the first point.
std::int64_t write_points(const File& file, std::int64_t steps, const std::vector<Vec3d>& position) {
  const std::int64_t first = next_row(file, steps, point_offsets, "/VTKHDF/Points");
  const hsize_t count = position.size();
  write_table(file, "/VTKHDF/Points", {static_cast<hsize_t>(first), count}, H5T_NATIVE_DOUBLE,
              position.data());
  const hsize_t present = most_points(file, steps);  // there may be more rows, of a step that failed
  if (count > present) {
    const auto added = numbers(static_cast<std::int64_t>(present), count - present);
    write_table(file, "/VTKHDF/Vertices/Connectivity", {present, added.size()}, H5T_NATIVE_INT64,
                added.data());
  }
  return first;
}

// Writes 0 ... count, where each vertex begins. Returns the step's entry of Steps/CellOffsets.
// VTK looks for them at the row CellOffsets + s, s being 'the number of parts before': VTK 9.3 counts all
// of them, later ones only until their cells add up to CellOffsets. A CellOffsets beyond that sum makes the
// two agree even after a step without particles, so two rows more than there are vertices lie in a step.
std::int64_t write_vertices(const File& file, std::int64_t steps, hsize_t count) {
  const std::string path = "/VTKHDF/Vertices/Offsets";
  std::int64_t row = 0;
  if (steps > 0) {
    const std::int64_t last = steps - 1;
    const auto chunk = static_cast<std::int64_t>(chunk_rows(file, open_dataset(file, path)));
    row = read_entry(file, cell_offsets, last) + last + read_entry(file, "/VTKHDF/NumberOfPoints", last) + 2;
    row = (row + chunk - 1) / chunk * chunk;
  }
  const auto values = numbers(0, count + 1);
  write_table(file, path, {static_cast<hsize_t>(row), values.size()}, H5T_NATIVE_INT64, values.data());
  return row - steps;
}

void write_step_entries(const File& file, std::int64_t step, std::int64_t points) {
  for (const char* name : topologies) {
    const std::int64_t cells = name == topologies[0] ? points : 0;
    write_entry(file, std::string("/VTKHDF/") + name + "/NumberOfCells", step, {cells});
    write_entry(file, std::string("/VTKHDF/") + name + "/NumberOfConnectivityIds", step, {cells});
    if (name != topologies[0]) write_entry(file, std::string("/VTKHDF/") + name + "/Offsets", step, {0});
  }
  write_entry(file, "/VTKHDF/Steps/PartOffsets", step, {step});
  write_entry(file, "/VTKHDF/Steps/NumberOfParts", step, {1});
  write_entry(file, "/VTKHDF/Steps/ConnectivityIdOffsets", step, {0, 0, 0, 0});
}

// What VTK must not find for a step that is not counted. It reads all of Values into room for NSteps times
// and writes beyond it where Values is longer; with one step it takes each entry of NumberOfPoints for a part
// of it. HDF5 writes the three at once, in the order of their creation: NumberOfPoints, NSteps, Values.
void write_step_count(const File& file, std::int64_t step, std::int64_t points, double time) {
  write_entry(file, "/VTKHDF/NumberOfPoints", step, {points});
  write_integers(file, open_group(file, "/VTKHDF/Steps"), "NSteps", {step + 1});
  write_table(file, times, {static_cast<hsize_t>(step), 1}, H5T_NATIVE_DOUBLE, &time);
}

}  // namespace

std::int64_t vtkhdf_steps(const File& file) {
  const std::int64_t steps = read_integer(file, open_group(file, "/VTKHDF/Steps"), "NSteps");
  return std::min(steps, static_cast<std::int64_t>(rows(file, open_dataset(file, times))));
}

VtkhdfWriter::VtkhdfWriter(std::string path, std::vector<ArrayInfo> arrays)
    : path_(std::move(path)), arrays_(std::move(arrays)) {}

void VtkhdfWriter::create(const Attributes& attributes, std::size_t points_expected) const {
  const hdf5::QuietErrors quiet;
  File file = File::create(path_);
  {
    const Handle root = create_group(file, "/VTKHDF");
    write_integers(file, root, "Version", {2, 0});
    write_fixed_text(file, root, "Type", "PolyData");
    for (const auto& [name, value] : attributes) write_text(file, root, name.c_str(), value);
  }
  create_integers(file, "/VTKHDF/NumberOfPoints");
  create_points(file, arrays_, chunk_for(points_expected));
  create_topologies(file, points_expected);
  create_steps(file, arrays_);
  file.close();
}

void VtkhdfWriter::describe(const Attributes& attributes) const {
  const hdf5::QuietErrors quiet;
  Attributes changed;
  {
    const File file = File::open(path_, File::Access::read);
    const auto present = read_texts(file, open_group(file, "/VTKHDF"));
    for (const auto& text : attributes)
      if (std::find(present.begin(), present.end(), text) == present.end()) changed.push_back(text);
  }
  if (changed.empty()) return;
  reserve(path_, bytes_of_indices);
  File file = File::open(path_, File::Access::change);
  {
    const Handle root = open_group(file, "/VTKHDF");
    for (const auto& [name, value] : changed) write_text(file, root, name.c_str(), value);
  }
  file.close();
}

// The tables of data may go on behind the last step: appending writes over that.
void VtkhdfWriter::truncate(std::int64_t steps) const {
  const hdf5::QuietErrors quiet;
  reserve(path_, bytes_of_indices);  // also for a file that a kill has left shorter than it says
  File file = File::open(path_, File::Access::change);
  file.claim_all_bytes();
  const std::int64_t present = vtkhdf_steps(file);
  if (present < steps)
    throw Error(path_ + ": holds " + std::to_string(present) + " time steps where the checkpoint knows of " +
                std::to_string(steps));
  const RowRange end{static_cast<hsize_t>(steps), 0};
  // In an order that leaves each step readable that is still counted: see write_step_count.
  write_table(file, times, end, H5T_NATIVE_DOUBLE, nullptr);
  file.flush();
  write_integers(file, open_group(file, "/VTKHDF/Steps"), "NSteps", {steps});
  file.flush();
  write_table(file, "/VTKHDF/NumberOfPoints", end, H5T_NATIVE_INT64, nullptr);
  file.close();
}

void VtkhdfWriter::append(const PointStep& step) const { append(step, Points::own); }

void VtkhdfWriter::append_at_same_points(const PointStep& step) const { append(step, Points::of_first_step); }

std::size_t VtkhdfWriter::bytes_of(const PointStep& step) const {
  const std::size_t count = step.position.size();
  std::size_t row = sizeof(Vec3d) + 2 * sizeof(std::int64_t);
  for (std::size_t k = 0; k < arrays_.size(); ++k) {
    const ArrayView& view = step.arrays.at(k);
    if (view.size != count || view.type != arrays_[k].type || view.components != arrays_[k].components)
      throw Error("cannot write to " + path_ + ": array " + arrays_[k].name + " has the wrong type or " +
                  std::to_string(view.size) + " rows for " + std::to_string(count) + " points");
    row += row_bytes(arrays_[k]);
  }
  return row * std::max<std::size_t>(count, longest_chunk);
}

VtkhdfWriter::FirstRows VtkhdfWriter::write_bulk(const PointStep& step, Points points) const {
  File file = File::open(path_, File::Access::change);
  FirstRows first;
  first.step = vtkhdf_steps(file);
  if (points == Points::own) first.point = write_points(file, first.step, step.position);
  first.cell = write_vertices(file, first.step, step.position.size());
  for (std::size_t k = 0; k < arrays_.size(); ++k) {
    const std::string table = "/VTKHDF/PointData/" + arrays_[k].name;
    const std::int64_t row = next_row(file, first.step, data_offsets(arrays_[k]), table);
    write_table(file, table, {static_cast<hsize_t>(row), step.position.size()}, hdf5_type(arrays_[k].type),
                step.arrays[k].data);
    first.data.push_back(row);
  }
  file.close();
  return first;
}

void VtkhdfWriter::write_indices(const PointStep& step, const FirstRows& first) const {
  File file = File::open(path_, File::Access::change);
  write_entry(file, point_offsets, first.step, {first.point});
  write_entry(file, cell_offsets, first.step, {first.cell, 0, 0, 0});
  for (std::size_t k = 0; k < arrays_.size(); ++k)
    write_entry(file, data_offsets(arrays_[k]), first.step, {first.data[k]});
  write_step_entries(file, first.step, static_cast<std::int64_t>(step.position.size()));
  file.close();
}

// Three openings, as HDF5 writes what changed in an order of its own: until the last one nothing is changed
// that a reader of the steps so far looks at.
void VtkhdfWriter::append(const PointStep& step, Points points) const {
  const hdf5::QuietErrors quiet;
  reserve(path_, bytes_of(step) + bytes_of_indices);
  const FirstRows first = write_bulk(step, points);
  reserve(path_, bytes_of_indices);
  write_indices(step, first);
  File file = File::open(path_, File::Access::change);
  write_step_count(file, first.step, static_cast<std::int64_t>(step.position.size()), step.time);
  file.close();
}

}  // namespace slagflow
