// One run, new or resumed: its files, the loop over the steps, how it ends.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "host/geometry/setup_builder.hpp"
#include "host/measures/heat_report.hpp"
#include "host/measures/losses.hpp"
#include "host/measures/measures.hpp"
#include "host/measures/openings.hpp"
#include "host/measures/profiles.hpp"
#include "host/measures/thin_sheets.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/output/history.hpp"
#include "host/output/provenance.hpp"
#include "host/output/snapshot_writer.hpp"
#include "host/output/summary.hpp"
#include "host/run/progress.hpp"
#include "host/run/run.hpp"
#include "host/run/run_interrupt.hpp"

namespace slagflow {

// Due at the first time at or after each multiple of an interval; time steps are not cut to meet it.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}

  bool due(double time);
  double next() const { return next_; }
  // Goes on at a time [s] at which nothing is due: with what was next, or where the interval has changed
  // meanwhile, with the next of its multiples.
  void restore(double next, double time);

 private:
  double following(double time) const;

  double interval_, next_ = 0;
};

class Run {
 public:
  // Of a case whose folder is ready. The log and the guard must outlive the run.
  Run(BuiltCase built, std::string folder, Log& log, InterruptGuard& signals);

  // Goes on from a checkpoint of the same case instead of starting. Throws Error when the particles that
  // the case starts from are others than they were. `changes`: of keys since then, a line each.
  void go_on_from(Checkpoint checkpoint, const std::string& changes);
  // Starts in the state of another run, which the built case has already; see Provenance::origin.
  void begin_from(const Checkpoint& state);

  // Runs to the end; failures are outcomes.
  RunOutcome execute();

 private:
  void note_origin();
  void start();
  void open_outputs();
  void open_profiles();
  RunStatus loop();
  RunStatus end_early(const std::string& reason);
  void record();
  void take_snapshot();
  bool checkpoint_due();
  void save_checkpoint();
  void write_checkpoint();
  void flush_outputs();
  void try_to_save_checkpoint();
  RunRecord run_record();
  void end_outputs();
  void tell_compression();
  void tell_losses();
  std::int64_t all_particles(const Totals&) const;
  void save_last_state();
  void fail(const std::string& reason);
  [[noreturn]] void end_all(const std::string& reason);
  void write_summary();
  const Totals& totals();
  void tell(const std::vector<std::string>& lines);
  ProgressState progress() const;

  using Clock = std::chrono::steady_clock;
  static double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }

  InterruptGuard& signals_;
  BuiltCase built_;
  std::string folder_;
  Log& log_;
  CheckpointStore store_;
  Provenance provenance_;
  Clock::time_point begun_ = Clock::now(), started_ = begun_, saved_ = begun_;
  RunCounts counts_;
  double wall_before_ = 0;            // [s], of earlier parts of the run
  std::optional<double> saved_time_;  // [s] simulated, of the last checkpoint
  std::int64_t geometry_ = 0, resumes_ = 0;
  RunOutcome outcome_;
  Schedule snapshot_due_, history_due_;
  std::int64_t recorded_step_ = -1, snapshot_step_ = -1, particles_now_ = 0;
  double start_time_;       // [s]
  FluidSnapshot measured_;  // buffer of the measures
  std::optional<Totals> totals_;
  std::int64_t totals_step_ = -1;  // of those
  Measures measures_;
  Losses losses_;
  Openings openings_;
  HeatReport heat_;
  ThinSheets thin_sheets_;
  std::string ended_early_;  // why, if it did
  std::optional<Checkpoint> resumed_;
  std::optional<Simulation> simulation_;
  std::optional<HistoryFile> history_;
  std::optional<SnapshotWriter> snapshots_;
  std::optional<ProfileFiles> profiles_;
};

}  // namespace slagflow
