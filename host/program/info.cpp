#include "host/program/info.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <vector>

#include "backend/error.hpp"
#include "host/output/checkpoint.hpp"
#include "host/output/hdf5_handles.hpp"
#include "host/output/vtkhdf.hpp"

namespace slagflow {
namespace {

using hdf5::File;
using hdf5::Handle;

std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.5g", value);
  return text.data();
}

std::vector<std::int64_t> integers(const File& file, const std::string& path, std::int64_t count) {
  std::vector<std::int64_t> values(static_cast<std::size_t>(count));
  read_rows(file, open_dataset(file, path), {0, values.size()}, H5T_NATIVE_INT64, values.data());
  return values;
}

struct Steps {
  std::vector<double> times;
  std::vector<std::int64_t> points;
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range range_of(const File& file, const std::string& table, const std::string& offsets, const Steps& steps) {
  const Handle dataset = open_dataset(file, table);
  const auto components = static_cast<std::size_t>(columns(file, dataset));
  const auto first = integers(file, offsets, static_cast<std::int64_t>(steps.times.size()));
  Range range;
  std::vector<double> values;
  const auto present = rows(file, dataset);
  for (std::size_t s = 0; s < first.size(); ++s) {
    const auto count = static_cast<std::size_t>(steps.points[s]);
    if (count > present) throw Error(table + ": a time step is longer than the data");
    values.resize(components * count);
    read_rows(file, dataset, {static_cast<hsize_t>(first[s]), count}, H5T_NATIVE_DOUBLE, values.data());
    for (const double value : values) {
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  }
  return range;
}

std::string array_line(const File& file, const std::string& name, const std::string& path,
                       const std::string& offsets, const Steps& steps) {
  std::string units;
  for (const auto& [key, value] : read_texts(file, open_dataset(file, path))) {
    if (key == "units" && value != "1") units = " " + value;
  }
  const Range range = range_of(file, path, offsets, steps);
  const std::string values =
      range.low <= range.high ? number(range.low) + " to " + number(range.high) + units : "no values";
  return "  " + name + std::string(std::max<std::size_t>(14, name.size() + 1) - name.size(), ' ') + values +
         "\n";
}

std::string steps_line(const Steps& steps) {
  if (steps.times.empty()) return "time steps: none\n";
  const auto [fewest, most] = std::minmax_element(steps.points.begin(), steps.points.end());
  return "time steps: " + std::to_string(steps.times.size()) + ", from " + number(steps.times.front()) +
         " s to " + number(steps.times.back()) + " s\nparticles: " + std::to_string(steps.points.front()) +
         " in the first, " + std::to_string(steps.points.back()) + " in the last, " +
         std::to_string(*fewest) + " to " + std::to_string(*most) + " in all\n";
}

// All texts but the case itself, which is long.
std::string provenance_lines(const std::vector<std::pair<std::string, std::string>>& texts) {
  std::string text;
  for (const auto& [name, value] : texts) {
    if (name != "case_text" && name != "Type" && !value.empty()) text += name + ": " + value + "\n";
  }
  return text;
}

std::string describe(const File& file) {
  Steps steps;
  const std::int64_t count = vtkhdf_steps(file);
  steps.points = integers(file, "/VTKHDF/NumberOfPoints", count);
  steps.times.resize(static_cast<std::size_t>(count));
  read_rows(file, open_dataset(file, "/VTKHDF/Steps/Values"), {0, steps.times.size()}, H5T_NATIVE_DOUBLE,
            steps.times.data());

  std::string text = file.path() + "\n" + provenance_lines(read_texts(file, open_group(file, "/VTKHDF"))) +
                     steps_line(steps) + "arrays:\n";
  text += array_line(file, "Points", "/VTKHDF/Points", "/VTKHDF/Steps/PointOffsets", steps);
  for (const std::string& name : members(file, "/VTKHDF/PointData"))
    text +=
        array_line(file, name, "/VTKHDF/PointData/" + name, "/VTKHDF/Steps/PointDataOffsets/" + name, steps);
  return text;
}

bool is_checkpoint(const File& file) { return H5Lexists(file.id(), "simulation", H5P_DEFAULT) > 0; }

std::string describe_checkpoint(const std::string& path) {
  const Checkpoint checkpoint = read_checkpoint(path);
  const RunRecord& run = checkpoint.run;
  std::string text = path + "\n" + provenance_lines(checkpoint.texts);
  text += "time: " + number(run.time) + " s, step " + std::to_string(run.steps) +
          "\nwall time: " + number(run.wall_time) + " s, resumed " + std::to_string(run.resumes) +
          " times\nwritten by then: " + std::to_string(run.history_lines) + " lines of history, " +
          std::to_string(run.snapshots) + " time steps\narrays, all sound:\n";
  for (const SavedArray& array : checkpoint.state)
    text += "  " + array.name +
            std::string(std::max<std::size_t>(14, array.name.size() + 1) - array.name.size(), ' ') +
            std::to_string(array.bytes.size() / array.element_size) + " of " +
            std::to_string(array.element_size) + " bytes\n";
  return text;
}

}  // namespace

std::string describe_file(const std::string& path) {
  const hdf5::QuietErrors quiet;
  if (!std::filesystem::exists(path)) throw InputError(path + ": no such file");
  try {
    const File file = File::open(path, File::Access::read);
    return is_checkpoint(file) ? describe_checkpoint(path) : describe(file);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(path + ": is no sound .vtkhdf file or checkpoint of a run: " + error.what());
  }
}

}  // namespace slagflow
