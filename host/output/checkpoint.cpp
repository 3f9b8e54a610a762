#include "host/output/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "backend/error.hpp"
#include "host/output/hdf5_handles.hpp"

namespace slagflow {
namespace {

using hdf5::File;
using hdf5::Handle;

constexpr const char* format_name = "slagflow checkpoint 3";
constexpr std::array<char, 8> seal_mark{'S', 'L', 'A', 'G', 'S', 'E', 'A', 'L'};
constexpr std::size_t seal_bytes = 16;

using Real64 = double RunRecord::*;
using Whole = std::int64_t RunRecord::*;
constexpr std::array<std::pair<const char*, Real64>, 7> reals{
    {{"time", &RunRecord::time},
     {"next_snapshot", &RunRecord::next_snapshot},
     {"next_history", &RunRecord::next_history},
     {"wall_time", &RunRecord::wall_time},
     {"setup_time", &RunRecord::setup_time},
     {"deepest_in_wall", &RunRecord::deepest_in_wall},
     {"time_of_most_in_sheets", &RunRecord::time_of_most_in_sheets}}};
constexpr std::array<std::pair<const char*, Whole>, 12> wholes{
    {{"steps", &RunRecord::steps},
     {"recorded_step", &RunRecord::recorded_step},
     {"snapshot_step", &RunRecord::snapshot_step},
     {"particles_now", &RunRecord::particles_now},
     {"particle_steps", &RunRecord::particle_steps},
     {"most_in_walls", &RunRecord::most_in_walls},
     {"most_in_sheets", &RunRecord::most_in_sheets},
     {"history_lines", &RunRecord::history_lines},
     {"history_bytes", &RunRecord::history_bytes},
     {"snapshots", &RunRecord::snapshots},
     {"resumes", &RunRecord::resumes},
     {"geometry", &RunRecord::geometry}}};

template <class T>
SavedArray array_of(const char* name, const T* values, std::size_t count) {
  SavedArray array{name, sizeof(T), std::vector<std::byte>(count * sizeof(T))};
  if (count > 0) std::memcpy(array.bytes.data(), values, array.bytes.size());
  return array;
}

SavedState arrays_of(const RunRecord& run) {
  SavedState arrays;
  for (const auto& [name, member] : reals) arrays.push_back(array_of(name, &(run.*member), 1));
  for (const auto& [name, member] : wholes) arrays.push_back(array_of(name, &(run.*member), 1));
  arrays.push_back(array_of("measures", run.measures.data(), run.measures.size()));
  arrays.push_back(array_of("profiles", run.profiles.data(), run.profiles.size()));
  return arrays;
}

const SavedArray& find(const SavedState& arrays, const std::string& name, const std::string& path) {
  for (const SavedArray& array : arrays) {
    if (array.name == name && array.element_size == 8) return array;
  }
  throw Error(path + ": the number '" + name + "' of the run is missing");
}

RunRecord record_of(const SavedState& arrays, const std::string& path) {
  RunRecord run;
  const auto take = [&](const char* name, void* to) {
    const SavedArray& array = find(arrays, name, path);
    if (array.bytes.size() != 8) throw Error(path + ": '" + name + "' of the run is no single number");
    std::memcpy(to, array.bytes.data(), 8);
  };
  for (const auto& [name, member] : reals) take(name, &(run.*member));
  for (const auto& [name, member] : wholes) take(name, &(run.*member));
  for (const std::int64_t count :
       {run.steps, run.particles_now, run.particle_steps, run.most_in_walls, run.most_in_sheets,
        run.history_lines, run.history_bytes, run.snapshots, run.resumes})
    if (count < 0) throw Error(path + ": a count of the run is negative");
  const auto take_all = [&](const char* name, auto& values) {
    const SavedArray& array = find(arrays, name, path);
    values.resize(array.bytes.size() / sizeof(values[0]));
    if (!values.empty()) std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
  };
  take_all("measures", run.measures);
  take_all("profiles", run.profiles);
  return run;
}

std::int64_t checksum_of(const SavedArray& array) {
  std::int64_t value = 0;
  const std::uint64_t sum = checksum(array.bytes.data(), array.bytes.size());
  std::memcpy(&value, &sum, sizeof value);
  return value;
}

// Gives the memory of each array back when it is written.
void write_arrays(const File& file, const std::string& group, SavedState arrays) {
  create_group(file, group);
  constexpr hsize_t longest_chunk = 8192;  // rows; the last chunk is padded
  for (SavedArray& array : arrays) {
    const hsize_t count = array.bytes.size() / array.element_size;
    hdf5::TableLayout layout;
    layout.type = H5T_NATIVE_UINT8;
    layout.components = static_cast<int>(array.element_size);
    layout.chunk_rows = std::clamp<hsize_t>(count, 1, longest_chunk);
    const Handle table = create_table(file, group + "/" + array.name, layout);
    write_rows(file, table, {0, count}, H5T_NATIVE_UINT8, array.bytes.data());
    write_integers(file, table, "element_size", {static_cast<std::int64_t>(array.element_size)});
    write_integers(file, table, "checksum", {checksum_of(array)});
    array.bytes = {};
  }
}

// `most`: the bytes of the file, so that a small file cannot ask for much memory.
SavedState read_arrays(const File& file, const std::string& group, std::uint64_t most) {
  SavedState arrays;
  for (const std::string& name : members(file, group)) {
    const Handle table = open_dataset(file, group + "/" + name);
    const std::uint64_t count = rows(file, table), size = columns(file, table);
    if (size == 0 || count > most / size)
      throw Error(file.path() + ": array '" + name + "' is larger than the file");
    SavedArray array{name, size, std::vector<std::byte>(count * size)};
    read_rows(file, table, {0, count}, H5T_NATIVE_UINT8, array.bytes.data());
    if (read_integer(file, table, "checksum") != checksum_of(array))
      throw Error(file.path() + ": array '" + name + "' is damaged: its checksum differs");
    arrays.push_back(std::move(array));
  }
  return arrays;
}

// Returns the size of the file. Throws Error unless it ends in its seal.
std::uint64_t require_sealed(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (size < 0) throw Error(path + ": cannot be read: " + std::strerror(errno));
  file.seekg(0);
  std::uint64_t sum = checksum_start;
  std::vector<char> block(std::size_t{1} << 20);
  const auto content = static_cast<std::uint64_t>(size) - std::min<std::uint64_t>(size, seal_bytes);
  for (std::uint64_t left = content; left > 0 && file;) {
    const std::uint64_t count = std::min<std::uint64_t>(left, block.size());
    file.read(block.data(), static_cast<std::streamsize>(count));
    sum = checksum(block.data(), count, sum);
    left -= count;
  }
  std::array<char, seal_bytes> seal{};
  file.read(seal.data(), seal.size());
  if (!file || std::memcmp(seal.data(), seal_mark.data(), seal_mark.size()) != 0)
    throw Error(path + ": is truncated or no checkpoint: its end is missing");
  if (std::memcmp(seal.data() + seal_mark.size(), &sum, sizeof sum) != 0)
    throw Error(path + ": is damaged: its checksum differs");
  return content;
}

}  // namespace

std::uint64_t checksum(const void* data, std::size_t bytes, std::uint64_t so_far) {
  constexpr std::uint64_t prime = 1099511628211ull;
  const auto* from = static_cast<const unsigned char*>(data);
  for (std::size_t done = 0; done < bytes; done += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + done, std::min<std::size_t>(8, bytes - done));
    so_far = (so_far ^ word) * prime;
    so_far ^= so_far >> 32;  // products carry upward only: brings the high bits back down
  }
  return so_far;
}

const std::string& Checkpoint::text(const std::string& name) const {
  for (const auto& [key, value] : texts) {
    if (key == name) return value;
  }
  throw Error("checkpoint: the text '" + name + "' is missing");
}

std::vector<std::byte> checkpoint_bytes(Checkpoint checkpoint, const std::string& path) {
  const hdf5::QuietErrors quiet;
  const File file = File::create_in_memory(path);
  {
    const Handle root = open_group(file, "/");
    write_text(file, root, "format", format_name);
    for (const auto& [name, value] : checkpoint.texts) write_text(file, root, name.c_str(), value);
  }
  write_arrays(file, "/run", arrays_of(checkpoint.run));
  write_arrays(file, "/simulation", std::move(checkpoint.state));
  std::vector<std::byte> bytes = file.image(seal_bytes);
  const std::uint64_t sum = checksum(bytes.data(), bytes.size());
  const std::size_t content = bytes.size();
  bytes.resize(content + seal_bytes);
  std::memcpy(&bytes[content], seal_mark.data(), seal_mark.size());
  std::memcpy(&bytes[content + seal_mark.size()], &sum, sizeof sum);
  return bytes;
}

Checkpoint read_checkpoint(const std::string& path) {
  const hdf5::QuietErrors quiet;
  const std::uint64_t bytes = require_sealed(path);
  const File file = File::open(path, File::Access::read);
  Checkpoint checkpoint;
  checkpoint.texts = read_texts(file, open_group(file, "/"));
  if (checkpoint.text("format") != format_name)
    throw Error(path + ": is of the format '" + checkpoint.text("format") + "', this program reads '" +
                format_name + "'");
  const auto is_format = [](const auto& text) { return text.first == "format"; };
  checkpoint.texts.erase(std::find_if(checkpoint.texts.begin(), checkpoint.texts.end(), is_format));
  checkpoint.run = record_of(read_arrays(file, "/run", bytes), path);
  checkpoint.state = read_arrays(file, "/simulation", bytes);
  return checkpoint;
}

}  // namespace slagflow
