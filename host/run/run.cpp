#include "host/run/run.hpp"

#include <array>
#include <filesystem>
#include <thread>
#include <utility>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "host/case/case_rules.hpp"
#include "host/geometry/geometry.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/run/check.hpp"
#include "host/run/run_folder.hpp"
#include "host/run/run_interrupt.hpp"
#include "host/run/run_loop.hpp"

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

// Throws InputError when the device is to repeat iterations and cannot.
void require_loops(const Case& c) {
  const std::string key = "numerics.solver_loop", missing = missing_for_loops();
  if (c.numerics.solver_loop == SolverLoop::conditional && !missing.empty())
    throw InputError(c.place_of(key) + ": key '" + key + "': value \"conditional\" needs " + missing +
                     ": allowed: \"batch\"");
}

// The end time of the case stays: the time steps before it are part of the flow.
void end_at(double until, Case& c) {
  if (until > longest_run(c.output))
    throw InputError("--until " + show(until) + ": allowed: up to " + show(longest_run(c.output)) +
                     " s with this output.interval and output.history_interval");
  c.output.until = until == c.output.end_time ? 0 : until;
}

std::string already_there(const RunRecord& run, const Case& c) {
  return "the run has reached its end of " + std::to_string(c.output.last_time()) + " s already, at " +
         std::to_string(run.time) + " s; --until SECONDS takes it further";
}

void warn_of_threads(int threads, Log& log) {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  if (cores > 0 && threads > cores)
    log.warning("--threads " + std::to_string(threads) + ": this machine has " + std::to_string(cores) +
                " for this program; the others wait for those");
}

RunOutcome interrupted_before(const std::string& folder) {
  RunOutcome outcome;
  outcome.status = RunStatus::interrupted;
  outcome.results = {"interrupted before the run began; nothing in " + folder + " has been touched"};
  return outcome;
}

}  // namespace

int RunOutcome::exit_code() const {
  if (status == RunStatus::failed) return 1;
  return status == RunStatus::interrupted ? 130 : 0;
}

RunOutcome run_case(const Case& c, const RunOptions& options) {
  InterruptGuard signals;
  require_loops(c);
  Case limited = c;
  if (options.until) end_at(*options.until, limited);
  if (options.threads > 0) set_threads(options.threads);
  const std::string folder = run_folder(c, options);
  require_free_folder(folder, options.overwrite);
  require_not_the_case(folder, c.file);
  BuiltCase built = build_setup(limited);
  built.setup.time_parts = options.time_parts;
  const double on_device = device_info().memory;
  require_memory(built, on_device > 0 ? on_device : available_memory());

  if (signals.requested()) return interrupted_before(folder);

  Log log(options.verbosity);
  create_folder(folder);
  const FolderLock lock(folder);
  clear_folder(folder);
  log.open(folder + "/log.txt");
  warn_of_threads(options.threads, log);
  for (const std::string& warning : check_case(built).warnings) log.warning(warning);
  return Run(std::move(built), folder, log, signals).execute();
}

RunOutcome resume_run(const RunOptions& options) {
  InterruptGuard signals;
  const std::string& folder = options.folder;
  std::error_code failed;
  if (!std::filesystem::is_directory(folder, failed))
    throw InputError(folder + ": is no folder: allowed: the folder of a run");
  const FolderLock lock(folder);
  if (options.threads > 0) set_threads(options.threads);
  const CheckpointStore store(folder);
  FoundCheckpoint found = store.read_newest();
  require_same_build(found);
  Case c = parse_case(found.checkpoint.text("case_text"), found.path);
  require_loops(c);
  if (options.until) end_at(*options.until, c);

  Log log(options.verbosity);
  log.open(folder + "/log.txt", std::ios::app);
  warn_of_threads(options.threads, log);
  BuiltCase built = build_setup(c);
  built.setup.time_parts = options.time_parts;
  Run run(std::move(built), folder, log, signals);
  for (const std::string& reason : found.damaged) log.warning(reason + "; the previous one is used");
  warn_of_other_version(found, log);
  const RunRecord at = found.checkpoint.run;
  run.go_on_from(std::move(found.checkpoint));
  if (!found.damaged.empty()) store.set_damaged_aside();
  log.info("resumed from " + found.path + " at " + std::to_string(at.time) + " s, step " +
           std::to_string(at.steps));
  RunOutcome outcome = run.execute();
  if (outcome.status == RunStatus::done && at.time >= c.output.last_time())
    outcome.results.insert(outcome.results.begin(), already_there(at, c));
  return outcome;
}

}  // namespace slagflow
