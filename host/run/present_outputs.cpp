#include "host/run/present_outputs.hpp"

#include <filesystem>

#include "backend/error.hpp"
#include "host/case/case_changes.hpp"
#include "host/measures/profiles.hpp"
#include "host/output/snapshot_reader.hpp"

namespace slagflow {
namespace {

std::string missing(const std::string& path) { return path + ": is missing"; }

// Empty: all is there.
std::string lack_of_table(const std::string& path, std::int64_t bytes) {
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  if (failed) return missing(path);
  if (static_cast<std::int64_t>(size) >= bytes) return "";
  return path + ": holds " + std::to_string(size) + " bytes where the checkpoint knows of " +
         std::to_string(bytes);
}

std::string lack_of_snapshots(const std::string& path, std::int64_t count) {
  if (!std::filesystem::exists(path)) return missing(path);
  try {
    const auto present = static_cast<std::int64_t>(list_snapshots(path).times.size());
    if (present >= count) return "";
    return path + ": holds " + std::to_string(present) + " time steps where the checkpoint knows of " +
           std::to_string(count);
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

void require_outputs(const std::string& folder, const RunRecord& run, const Case& c) {
  std::string lacks;
  const auto add = [&](const std::string& lack) { lacks += lack + (lack.empty() ? "" : "\n"); };
  add(lack_of_table(folder + "/history.csv", run.history_bytes));
  add(lack_of_snapshots(folder + "/particles.vtkhdf", run.snapshots));
  if (c.output.walls && !c.walls.empty()) add(lack_of_snapshots(folder + "/walls.vtkhdf", run.snapshots));
  const std::vector<MeasureFile> files = measure_files(c);
  for (std::size_t k = 0; k < files.size() && 2 * k + 1 < run.profiles.size(); ++k)
    add(lack_of_table(folder + "/" + files[k].name, run.profiles[2 * k + 1]));
  if (lacks.empty()) return;
  throw InputError(
      lacks +
      "a run goes on behind what it has written: allowed: put back what is missing, or slagflow run --from " +
      shell_word(folder) + " -o NEW, which begins a new run in the state of the checkpoint");
}

}  // namespace slagflow
