#include "host/run/start_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/output/provenance.hpp"
#include "host/output/snapshot_reader.hpp"

namespace slagflow {
namespace {

namespace fs = std::filesystem;

constexpr const char* snapshots_name = "particles.vtkhdf";

std::string text_of(double time) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g", time);
  return text.data();
}

// The first few, and the last.
std::string list_of(const std::vector<double>& times) {
  constexpr std::size_t shown = 12;
  std::string text;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times.size() > shown && k == shown - 1) text += ", ...";
    if (times.size() > shown && k >= shown - 1 && k + 1 < times.size()) continue;
    text += (text.empty() ? "" : ", ") + text_of(times[k]);
  }
  return text + " s";
}

// Where a run is, and at what time [s].
struct Request {
  std::string folder;
  std::optional<double> time;
};

Request request_of(const std::string& from) {
  std::error_code failed;
  if (fs::is_directory(from, failed)) return {from, {}};
  const auto at = from.rfind('@');
  const std::string folder = from.substr(0, at), time = at == std::string::npos ? "" : from.substr(at + 1);
  if (!fs::is_directory(folder, failed))
    throw InputError("--from " + from + ": no such folder: allowed: DIR or DIR@TIME, the folder of a run");
  char* end = nullptr;
  const double value = std::strtod(time.c_str(), &end);
  if (time.empty() || *end != 0 || !(value >= 0) || !std::isfinite(value))
    throw InputError("--from " + from + ": time \"" + time + "\": allowed: DIR@TIME, a number >= 0 [s]");
  return {folder, value};
}

struct FoundStates {
  std::vector<std::pair<std::string, Checkpoint>> checkpoints;  // newest first
  std::vector<double> checkpoint_times;
  SnapshotList snapshots;
  std::vector<std::string> damaged;  // why each of the others cannot be used
};

FoundStates look_into(const std::string& folder) {
  FoundStates found;
  const auto there = [&](const char* name) { return fs::exists(fs::path(folder) / name); };
  for (const char* name : {checkpoint_name, previous_checkpoint_name}) {
    if (!there(name)) continue;
    try {
      found.checkpoints.emplace_back(name, read_checkpoint(folder + "/" + name));
      found.checkpoint_times.push_back(found.checkpoints.back().second.run.time);
    } catch (const Error& error) {
      found.damaged.emplace_back(error.what());
    }
  }
  try {
    if (there(snapshots_name)) found.snapshots = list_snapshots(folder + "/" + snapshots_name);
  } catch (const Error& error) {
    found.damaged.emplace_back(error.what());
  }
  return found;
}

std::string what_is_there(const FoundStates& found) {
  std::string text;
  if (!found.checkpoints.empty()) text += "checkpoints at " + list_of(found.checkpoint_times);
  if (!found.snapshots.times.empty())
    text += (text.empty() ? "" : "; ") + std::string("snapshots at ") + list_of(found.snapshots.times);
  for (const std::string& reason : found.damaged) text += "\n  " + reason;
  return text.empty() ? "there is none" : text;
}

// Of texts that a run has left.
Case case_of(const Checkpoint& checkpoint, const std::string& path) {
  return parse_case(checkpoint.text("case_text"), path);
}

void add_origin(const std::string& folder, const std::string& file, Checkpoint& checkpoint) {
  auto& texts = checkpoint.texts;
  const auto is_older = [](const auto& text) { return text.first.rfind("from_", 0) == 0; };
  texts.erase(std::remove_if(texts.begin(), texts.end(), is_older), texts.end());
  texts.emplace_back("from_folder", fs::weakly_canonical(folder).string());
  texts.emplace_back("from_file", file);
  texts.emplace_back("from_time", show(checkpoint.run.time));
  if (checkpoint.run.steps >= 0) texts.emplace_back("from_step", std::to_string(checkpoint.run.steps));
}

StartState from_checkpoint(const std::string& folder, const std::string& name, Checkpoint checkpoint) {
  const std::string path = folder + "/" + name, here = build_provenance().precision;
  if (checkpoint.text("precision") != here)
    throw InputError(path + ": was written by a build with precision \"" + checkpoint.text("precision") +
                     "\", this program has \"" + here +
                     "\": allowed: a program like the first, or a snapshot");
  StartState start;
  start.before = case_of(checkpoint, path);
  Vec3d lower = start.before.domain.lower;
  if (start.before.dimensions == 2) lower.y = -0.5 * start.before.spacing;
  checkpoint.state = fluid_arrays(checkpoint.state, lower);
  start.checkpoint = std::move(checkpoint);
  add_origin(folder, name, start.checkpoint);
  return start;
}

StartState from_snapshot(const std::string& folder, const SnapshotList& snapshots, std::size_t number) {
  const std::string path = folder + "/" + snapshots_name;
  StartState start;
  start.checkpoint.texts = snapshots.texts;
  start.before = case_of(start.checkpoint, path);
  std::vector<FluidSetup> fluids;
  for (const FluidSpec& fluid : start.before.fluids)
    fluids.push_back({fluid.name, fluid.density, fluid.law()});
  const FluidSnapshot snapshot = read_snapshot(path, number);
  for (const std::uint8_t kind : snapshot.fluid)
    if (kind >= fluids.size()) throw InputError(path + ": holds a fluid that its case does not have");
  start.checkpoint.state = fluid_arrays(snapshot, fluids);
  start.checkpoint.run.time = snapshot.time, start.checkpoint.run.steps = -1;
  add_origin(folder, snapshots_name, start.checkpoint);
  start.warnings.push_back(
      "the run starts from a snapshot, which knows neither how much void particles have "
      "left behind nor their last step: fluid that has parted closes too early; a "
      "checkpoint knows both");
  return start;
}

// Of equal distance the checkpoint.
StartState nearest(const Request& request, FoundStates found, double tolerance) {
  std::size_t best = 0;
  double least = HUGE_VAL;
  const auto look = [&](double time, std::size_t number) {
    const double distance = std::abs(time - *request.time);
    if (distance < least - 1e-9 * std::abs(time)) least = distance, best = number;
  };
  const std::size_t checkpoints = found.checkpoints.size();
  for (std::size_t k = 0; k < checkpoints; ++k) look(found.checkpoint_times[k], k);
  for (std::size_t k = 0; k < found.snapshots.times.size(); ++k)
    look(found.snapshots.times[k], checkpoints + k);
  if (!(least <= tolerance))
    throw InputError(
        "--from " + request.folder + "@" + text_of(*request.time) +
        ": there is no state within half of output.interval of it: allowed: " + what_is_there(found));
  if (best < checkpoints)
    return from_checkpoint(request.folder, found.checkpoints[best].first,
                           std::move(found.checkpoints[best].second));
  return from_snapshot(request.folder, found.snapshots, best - checkpoints);
}

}  // namespace

std::string StartState::text() const {
  std::string text = checkpoint.text("from_file") + " of " + checkpoint.text("from_folder") + " at " +
                     text_of(checkpoint.run.time) + " s";
  if (checkpoint.run.steps >= 0) text += ", step " + std::to_string(checkpoint.run.steps);
  return text;
}

StartState find_state(const std::string& from) {
  const Request request = request_of(from);
  FoundStates found = look_into(request.folder);
  if (found.checkpoints.empty() && (!request.time || found.snapshots.times.empty()))
    throw InputError(request.folder + ": holds no checkpoint to start from: allowed: " +
                     (found.snapshots.times.empty() ? "" : "--from DIR@TIME, with ") + what_is_there(found));
  StartState start;
  if (request.time) {
    const bool by_snapshot = found.checkpoints.empty();
    Checkpoint known;
    known.texts = by_snapshot ? found.snapshots.texts : found.checkpoints.front().second.texts;
    const double interval = case_of(known, request.folder).output.interval;
    start = nearest(request, found, 0.5 * interval * (1 + 1e-6));
  } else {
    start = from_checkpoint(request.folder, found.checkpoints.front().first,
                            std::move(found.checkpoints.front().second));
  }
  for (const std::string& reason : found.damaged) start.warnings.push_back(reason + "; it is left out");
  return start;
}

StartState read_start(const std::string& folder) {
  const std::string path = folder + "/" + start_name;
  StartState start;
  try {
    start.checkpoint = read_checkpoint(path);
  } catch (const Error& error) {
    throw InputError(std::string(error.what()) +
                     "; the run began with this state and cannot go on without it: allowed: put it back, or "
                     "slagflow run --from " +
                     shell_word(folder) + " -o NEW, a new run from its checkpoint");
  }
  start.before = case_of(start.checkpoint, path);
  return start;
}

}  // namespace slagflow
