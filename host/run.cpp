#include "host/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <utility>

#include "backend/error.hpp"
#include "host/history.hpp"
#include "host/measures.hpp"
#include "host/progress.hpp"
#include "host/provenance.hpp"
#include "host/run_folder.hpp"
#include "host/run_interrupt.hpp"
#include "host/setup_builder.hpp"
#include "host/snapshot_writer.hpp"
#include "host/summary.hpp"

namespace slagflow {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Due at the first time at or after each multiple of an interval; time steps are not cut to meet it.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}

  bool due(double time) {
    constexpr double rounding = 1e-12;
    if (time < next_ * (1 - rounding)) return false;
    next_ = (std::floor(time / interval_ * (1 + rounding)) + 1) * interval_;
    return true;
  }

 private:
  double interval_, next_ = 0;
};

class Run {
 public:
  Run(BuiltCase built, std::string folder, Log& log);
  RunOutcome execute();

 private:
  void start();
  RunStatus loop();
  void record();
  void take_snapshot();
  void end_outputs();
  void save_last_state();
  void fail(const std::string& reason);
  void write_summary();
  ProgressState progress() const;

  BuiltCase built_;
  std::string folder_;
  Log& log_;
  Provenance provenance_;
  Clock::time_point begun_ = Clock::now(), started_ = begun_;
  RunCounts counts_;
  RunOutcome outcome_;
  Schedule snapshot_due_, history_due_;
  std::int64_t recorded_step_ = -1, snapshot_step_ = -1, particles_now_ = 0;
  FluidSnapshot measured_;  // buffer of the measures
  Measures measures_;
  std::optional<Simulation> simulation_;
  std::optional<HistoryFile> history_;
  std::optional<SnapshotWriter> snapshots_;
};

Run::Run(BuiltCase built, std::string folder, Log& log)
    : built_(std::move(built)),
      folder_(std::move(folder)),
      log_(log),
      provenance_(run_provenance(built_.resolved)),
      snapshot_due_(built_.resolved.output.interval),
      history_due_(built_.resolved.output.history_interval),
      measures_(built_.resolved, built_.setup.fronts,
                static_cast<std::int64_t>(built_.setup.particles.position.size())) {
  counts_.particles_start = static_cast<std::int64_t>(built_.setup.particles.position.size());
  counts_.walls = static_cast<std::int64_t>(built_.setup.walls.position.size());
  particles_now_ = counts_.particles_start;
  outcome_.folder = folder_;
}

RunOutcome Run::execute() {
  try {
    start();
    outcome_.status = loop();
    end_outputs();
  } catch (const std::bad_alloc&) {
    fail("out of memory (" + std::to_string(counts_.particles_start) + " fluid and " +
         std::to_string(counts_.walls) + " wall particles)");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  counts_.wall_time = seconds_since(started_);
  write_summary();
  if (simulation_) log_.info("end: " + progress_line(progress(), counts_.wall_time));
  outcome_.results = measures_.lines();
  return std::move(outcome_);
}

void Run::start() {
  write_file(folder_ + "/case.toml", provenance_.case_text);
  log_.info("slagflow " + provenance_.version + " (" + provenance_.commit + "), " + provenance_.backend +
            ", " + provenance_.precision + ", " + provenance_.device);
  log_.info("case " + built_.resolved.name + ": " + std::to_string(counts_.particles_start) + " fluid and " +
            std::to_string(counts_.walls) + " wall particles, to " + folder_);
  simulation_.emplace(built_.setup);
  built_.setup.particles = {};  // on the device now
  built_.setup.walls = {};

  std::vector<std::string> columns = history_columns();
  for (const std::string& name : measures_.columns()) columns.push_back(name);
  history_.emplace(folder_ + "/history.csv", columns);
  const SnapshotSizes sizes{static_cast<std::size_t>(counts_.particles_start),
                            built_.resolved.output.walls ? static_cast<std::size_t>(counts_.walls) : 0};
  snapshots_.emplace(folder_, sizes, provenance_.attributes());
  counts_.setup_time = seconds_since(begun_);
  started_ = Clock::now();
}

RunStatus Run::loop() {
  const InterruptGuard interrupt;
  Progress shown(log_);
  Simulation& simulation = *simulation_;
  while (true) {
    const double time = simulation.time();
    if (history_due_.due(time)) record();
    if (snapshot_due_.due(time)) take_snapshot();
    if (time >= built_.resolved.output.end_time) return RunStatus::done;
    if (interrupt.requested()) {
      log_.warning("interrupted at " + std::to_string(time) + " s");
      return RunStatus::interrupted;
    }
    simulation.step();
    counts_.particle_steps += particles_now_;
    shown.update(progress());
  }
}

// A line of the history; the measures are taken from the same totals.
void Run::record() {
  if (recorded_step_ == simulation_->steps()) return;
  recorded_step_ = simulation_->steps();
  const Totals totals = simulation_->totals();
  particles_now_ = totals.particles;
  counts_.max_density_error = std::max(counts_.max_density_error, totals.max_density_error);
  std::vector<double> values = history_values(*simulation_, totals);
  const auto read = [this]() -> const FluidSnapshot& {
    simulation_->read(measured_);
    return measured_;
  };
  for (const double value : measures_.update(simulation_->time(), totals, read)) values.push_back(value);
  history_->write(values);
}

void Run::take_snapshot() {
  if (snapshot_step_ == simulation_->steps()) return;
  snapshots_->write([this](Snapshot& snapshot) {
    simulation_->read(snapshot.particles);
    if (snapshots_->writes_walls()) simulation_->read(snapshot.walls);
  });
  snapshot_step_ = simulation_->steps();
}

void Run::end_outputs() {
  record();
  take_snapshot();
  snapshots_->close();
}

void Run::fail(const std::string& reason) {
  outcome_.status = RunStatus::failed;
  outcome_.reason = reason;
  log_.error(reason);
  if (snapshots_) save_last_state();
}

void Run::save_last_state() {
  try {
    end_outputs();
    log_.info("the last state, at " + std::to_string(simulation_->time()) + " s, is written");
  } catch (const std::exception& error) {
    log_.warning(std::string("the last state could not be written: ") + error.what());
  }
}

void Run::write_summary() {
  Json summary = summary_of_case(built_.resolved, provenance_, counts_);
  try {
    if (simulation_) add_results(summary, *simulation_, counts_);
  } catch (const std::exception& error) {
    log_.warning(std::string("the summary lacks the results: ") + error.what());
  }
  constexpr const char* names[] = {"done", "interrupted", "failed"};
  summary.set("status", names[static_cast<int>(outcome_.status)]);
  if (outcome_.status == RunStatus::failed) summary.set("reason", outcome_.reason);
  summary.set("measures", measures_.summary());
  try {
    write_file(folder_ + "/summary.json", summary.text() + "\n");
  } catch (const std::exception& error) {
    log_.error(error.what());
    outcome_.status = RunStatus::failed;
  }
}

ProgressState Run::progress() const {
  const SolverTotals solver = simulation_->solver_totals();
  const double mean =
      solver.steps > 0 ? static_cast<double>(solver.iterations) / static_cast<double>(solver.steps) : 0;
  return {simulation_->time(), built_.resolved.output.end_time, simulation_->steps(), counts_.particle_steps,
          mean};
}

}  // namespace

int RunOutcome::exit_code() const {
  if (status == RunStatus::failed) return 1;
  return status == RunStatus::interrupted ? 130 : 0;
}

RunOutcome run_case(const Case& c, const RunOptions& options) {
  Case limited = c;
  if (options.until) limited.output.end_time = *options.until;
  if (options.threads > 0) set_threads(options.threads);
  const std::string folder = run_folder(c, options);
  require_free_folder(folder, options.overwrite);
  BuiltCase built = build_setup(limited);

  Log log(options.verbosity);
  prepare_folder(folder);
  log.open(folder + "/log.txt");
  for (const std::string& warning : built.warnings) log.warning(warning);
  return Run(std::move(built), folder, log).execute();
}

}  // namespace slagflow
