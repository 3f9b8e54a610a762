#include "host/run/run_options.hpp"

#include <thread>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "host/case/case_changes.hpp"
#include "host/case/case_rules.hpp"
#include "host/case/toml_reader.hpp"

namespace slagflow {

// Throws InputError when the device is to repeat iterations and cannot.
void require_loops(const Case& c) {
  const std::string key = "numerics.solver_loop", missing = missing_for_loops();
  if (c.numerics.solver_loop == SolverLoop::conditional && !missing.empty())
    throw InputError(c.place_of(key) + ": key '" + key + "': value \"conditional\" needs " + missing +
                     ": allowed: \"batch\"");
}

// Throws InputError where what the case asks for does not go with several ranks yet.
void require_dealable(const Case& c) {
  if (!ranks().several()) return;
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& allowed) {
    throw InputError(c.place_of(key) + ": key '" + key + "': value " + value +
                     " does not go with several ranks: allowed: " + allowed);
  };
  if (c.numerics.yield == YieldModel::exact) refuse("numerics.yield", "\"exact\"", "\"regularised\"");
  if (c.numerics.solver == ViscousSolver::sor)
    refuse("numerics.solver", "\"sor\"", "\"multigrid\", \"conjugate_gradient\", \"jacobi\"");
  if (c.numerics.solver_loop == SolverLoop::conditional)
    refuse("numerics.solver_loop", "\"conditional\"", "\"batch\"");
  if (c.thermal.on) refuse("thermal", "of a case with heat", "none, or one rank");
}

// The end time of the case stays: the time steps before it are part of the flow.
void end_at(double until, Case& c) {
  if (until > longest_run(c.output))
    throw InputError("--until " + show(until) + ": allowed: up to " + show(longest_run(c.output)) +
                     " s with this output.interval and output.history_interval");
  c.output.until = until == c.output.end_time ? 0 : until;
}

void end_with_end_time(const std::vector<std::string>& overrides, Case& c) {
  bool end_time = false, until = false;
  for (const std::string& assignment : overrides) {
    end_time = end_time || assignment.rfind("output.end_time=", 0) == 0;
    until = until || assignment.rfind("output.until=", 0) == 0;
  }
  if (end_time && !until) c.output.until = 0;
}

void warn_of_threads(int threads, Log& log) {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  if (cores > 0 && threads > cores)
    log.warning("--threads " + std::to_string(threads) + ": this machine has " + std::to_string(cores) +
                " for this program; the others wait for those");
}

RunOutcome with_advice(RunOutcome outcome, const RunOptions& options) {
  if (outcome.status != RunStatus::interrupted) return outcome;
  std::string command = "slagflow resume " + shell_word(outcome.folder);
  if (options.threads > 0) command += " --threads " + std::to_string(options.threads);
  if (options.verbosity == Verbosity::quiet) command += " --quiet";
  if (options.time_parts) command += " --time-parts";
  outcome.results.push_back("to go on: " + command);
  return outcome;
}

}  // namespace slagflow
