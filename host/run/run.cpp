#include "host/run/run.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/run/check.hpp"
#include "host/run/first_rank.hpp"
#include "host/run/progress.hpp"
#include "host/run/run_folder.hpp"
#include "host/run/run_interrupt.hpp"
#include "host/run/run_loop.hpp"
#include "host/run/run_options.hpp"
#include "host/run/start_state.hpp"
#include "simulation/sharing.hpp"

namespace slagflow {
namespace {

RunOutcome interrupted_before(const std::string& folder) {
  RunOutcome outcome;
  outcome.status = RunStatus::interrupted;
  outcome.results = {"interrupted before the run began; nothing in " + folder + " has been touched"};
  return outcome;
}

// Gives the case what goes on from the state, and notes in its texts which keys differ.
void take_state(StartState& start, BuiltCase& built) {
  start_from(start, built);
  const std::vector<KeyChange> changes = key_changes(start.before, built.resolved);
  require_startable(start, built, changes);
  std::string lines;
  for (const KeyChange& change : changes) lines += (lines.empty() ? "" : "\n") + text_of(change);
  start.checkpoint.texts.emplace_back("from_changes", lines);
}

void tell_of_state(const StartState& start, Log& log) {
  log.info("starts from " + start.text());
  const std::string& changes = start.checkpoint.text("from_changes");
  log.info(changes.empty() ? "no key differs" : "keys that differ:\n" + changes);
  for (const std::string& warning : start.warnings) log.warning(warning);
}

void write_start(const StartState& start, const std::string& folder) {
  const std::string path = folder + "/" + start_name;
  const std::vector<std::byte> bytes = checkpoint_bytes(start.checkpoint, path);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  flush_to_disk(path);
}

void take_folder(const std::string& folder, std::optional<FolderLock>& lock, Log& log) {
  create_folder(folder);
  lock.emplace(folder);
  clear_folder(folder);
  log.open(folder + "/log.txt");
}

// `start`: where it does not begin with the regions of the case.
RunOutcome begin(const Case& c, const RunOptions& options, StartState* start) {
  InterruptGuard signals;
  require_loops(c);
  require_dealable(c);
  Case limited = c;
  if (options.until) end_at(*options.until, limited);
  if (options.threads > 0) set_threads(options.threads);
  const std::string folder = run_folder(c, options);
  on_first_rank([&] {
    require_free_folder(folder, options.overwrite);
    require_not_the_case(folder, c.file);
  });
  BuiltCase built = [&] {
    StartProgress progress(options.verbosity);
    return build_setup(limited, progress.stage());
  }();
  if (start) take_state(*start, built);
  if (ranks().several()) require_shareable(built.setup);
  built.setup.time_parts = options.time_parts;
  const double on_device = device_info().memory * ranks().size();  // each has its part of the fluid
  require_memory(built, on_device > 0 ? on_device : available_memory());

  if (ranks().shared(signals.requested())) return interrupted_before(folder);

  Log log(options.verbosity);
  std::optional<FolderLock> lock;
  on_first_rank([&] { take_folder(folder, lock, log); });
  warn_of_threads(options.threads, log);
  for (const std::string& warning : check_case(built).warnings) log.warning(warning);
  if (start) {
    on_first_rank([&] { write_start(*start, folder); });
    tell_of_state(*start, log);
  }
  Run run(std::move(built), folder, log, signals);
  if (start) run.begin_from(start->checkpoint);
  return with_advice(run.execute(), options);
}

}  // namespace

int RunOutcome::exit_code() const {
  if (status == RunStatus::failed) return 1;
  return status == RunStatus::interrupted ? 130 : 0;
}

RunOutcome run_case(const Case& c, const RunOptions& options) { return begin(c, options, nullptr); }

RunOutcome run_from(const StartRequest& request, const RunOptions& options) {
  StartState start = find_state(request.from);
  Case c = request.file.empty()
               ? parse_case(start.checkpoint.text("case_text"),
                            start.checkpoint.text("from_folder") + "/" + start.checkpoint.text("from_file"),
                            request.overrides)
               : load_case(request.file, request.overrides);
  end_with_end_time(request.overrides, c);
  const auto sets_until = [](const std::string& set) { return set.rfind("output.until=", 0) == 0; };
  if (request.file.empty() && std::none_of(request.overrides.begin(), request.overrides.end(), sets_until))
    c.output.until = 0;  // where the other run was told to end is not this one's end
  std::error_code failed;
  const std::string folder = run_folder(c, options);
  if (std::filesystem::equivalent(folder, start.checkpoint.text("from_folder"), failed))
    throw InputError(folder + ": is the run to start from, which stays as it is; -o takes another folder");
  return begin(c, options, &start);
}

}  // namespace slagflow
