// Goes on with a run that was broken off.
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/run/first_rank.hpp"
#include "host/run/present_outputs.hpp"
#include "host/run/run_changes.hpp"
#include "host/run/run_folder.hpp"
#include "host/run/run_interrupt.hpp"
#include "host/run/run_loop.hpp"
#include "host/run/run_options.hpp"
#include "host/run/start_state.hpp"
#include "simulation/sharing.hpp"

namespace slagflow {
namespace {

// Throws InputError when the checkpoint's numbers cannot be continued to the same bits by this program.
void require_same_build(const FoundCheckpoint& found) {
  const Provenance here = build_provenance();
  const std::array<std::pair<const char*, std::string>, 2> needed{
      {{"backend", here.backend}, {"precision", here.precision}}};
  for (const auto& [name, value] : needed) {
    const std::string& written = found.checkpoint.text(name);
    if (written != value)
      throw InputError(found.path + ": was written by a build with " + name + " \"" + written +
                       "\", this program has \"" + value + "\": resume with a program like the first");
  }
}

void warn_of_other_version(const FoundCheckpoint& found, Log& log) {
  const Provenance here = build_provenance();
  const std::string &version = found.checkpoint.text("version"), &commit = found.checkpoint.text("commit");
  if (version != here.version || commit != here.commit)
    log.warning(found.path + ": was written by version " + version + " (" + commit + "), this is " +
                here.version + " (" + here.commit + "): the results may differ in their last digits");
}

std::string already_there(const RunRecord& run, const OutputSpec& output) {
  return "the run has reached its end of " + std::to_string(output.last_time()) + " s already, at " +
         std::to_string(run.time) + " s; --until SECONDS takes it further";
}

bool began_from_another(const Checkpoint& checkpoint) { return !origin_among(checkpoint.texts).empty(); }

}  // namespace

RunOutcome resume_run(const RunOptions& options) {
  InterruptGuard signals;
  const std::string& folder = options.folder;
  std::error_code failed;
  if (!std::filesystem::is_directory(folder, failed))
    throw InputError(folder + ": is no folder: allowed: the folder of a run");
  std::optional<FolderLock> lock;
  on_first_rank([&] { lock.emplace(folder); });
  if (options.threads > 0) set_threads(options.threads);
  const CheckpointStore store(folder);
  FoundCheckpoint found = store.read_newest();
  require_same_build(found);
  GoingCase going = going_case(found, options);
  require_loops(going.built.resolved);
  require_dealable(going.built.resolved);
  if (began_from_another(found.checkpoint)) start_from(read_start(folder), going.built);
  if (ranks().several()) require_shareable(going.built.setup);
  require_outputs(folder, found.checkpoint.run, going.built.resolved);

  Log log(options.verbosity);
  on_first_rank([&] { log.open(folder + "/log.txt", std::ios::app); });
  warn_of_threads(options.threads, log);
  going.built.setup.time_parts = options.time_parts;
  const OutputSpec output = going.built.resolved.output;
  Run run(std::move(going.built), folder, log, signals);
  for (const std::string& reason : found.damaged) log.warning(reason + "; the previous one is used");
  warn_of_other_version(found, log);
  for (const std::string& message : going.messages) log.info(message);
  const RunRecord at = found.checkpoint.run;
  run.go_on_from(std::move(found.checkpoint), going.changes);
  if (!found.damaged.empty()) on_first_rank([&] { store.set_damaged_aside(); });
  log.info("resumed from " + found.path + " at " + std::to_string(at.time) + " s, step " +
           std::to_string(at.steps));
  RunOutcome outcome = run.execute();
  if (outcome.status == RunStatus::done && at.time >= output.last_time())
    outcome.results.insert(outcome.results.begin(), already_there(at, output));
  return with_advice(std::move(outcome), options);
}

}  // namespace slagflow
