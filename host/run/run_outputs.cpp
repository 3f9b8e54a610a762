// What a run writes: history, snapshots, profiles, checkpoints.
#include <utility>

#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "host/run/first_rank.hpp"
#include "host/run/run_loop.hpp"

namespace slagflow {

void Run::open_outputs() {
  std::vector<std::string> columns = history_columns();
  for (const std::string& name : openings_.columns()) columns.push_back(name);
  for (const std::string& name : heat_.columns()) columns.push_back(name);
  for (const std::string& name : measures_.columns()) columns.push_back(name);
  const std::string history = folder_ + "/history.csv";
  const SnapshotSizes sizes{static_cast<std::size_t>(counts_.particles_start),
                            built_.resolved.output.walls ? static_cast<std::size_t>(counts_.walls) : 0,
                            built_.resolved.thermal.on};
  if (!resumed_) {
    history_.emplace(history, columns);
    snapshots_.emplace(folder_, sizes, provenance_.attributes());
    return;
  }
  const RunRecord& run = resumed_->run;
  history_.emplace(history, columns, HistoryEnd{run.history_lines, run.history_bytes});
  snapshots_.emplace(folder_, sizes, PresentSnapshots(run.snapshots));
  snapshots_->describe(provenance_.attributes());  // another end time, perhaps
}

// The other ranks have them without files.
void Run::open_profiles() {
  const auto open = [&] {
    resumed_ ? profiles_.emplace(built_.resolved, built_.setup, folder_, resumed_->run.profiles)
             : profiles_.emplace(built_.resolved, built_.setup, folder_);
  };
  on_first_rank(open);
  if (!ranks().first()) open();
}

// A line of the history; the measures are taken from the same totals.
void Run::record() {
  if (recorded_step_ == simulation_->steps()) return;
  recorded_step_ = simulation_->steps();
  const Totals& totals = this->totals();
  particles_now_ = totals.particles;
  losses_.look(*simulation_);
  thin_sheets_.look(totals, simulation_->time());
  std::vector<double> values = history_values(*simulation_, totals);
  for (const double value : openings_.values(totals)) values.push_back(value);
  for (const double value : heat_.values(totals)) values.push_back(value);
  const auto read = [this]() -> const FluidSnapshot& {
    simulation_->read(measured_);
    return measured_;
  };
  for (const double value : measures_.update(simulation_->time(), totals, read)) values.push_back(value);
  on_first_rank([&] { history_->write(values); });
}

void Run::take_snapshot() {
  if (snapshot_step_ == simulation_->steps()) return;
  const Reading what =
      built_.resolved.output.walls && counts_.walls > 0 ? Reading::fluid_and_walls : Reading::fluid;
  if (ranks().several()) {
    StateTransfer all;
    simulation_->start_reading(all, what);
    on_first_rank([&] {
      snapshots_->write([&](Snapshot& snapshot) { all.finish(snapshot.particles, snapshot.walls); });
    });
  } else {
    snapshots_->write([&](Snapshot& snapshot) { simulation_->start_reading(snapshot.arriving, what); });
  }
  const ProfileFiles::Lines lines = profiles_->read(*simulation_);
  on_first_rank([&] { profiles_->write(lines); });
  snapshot_step_ = simulation_->steps();
}

// What a clock or a signal asks for, the first rank asks for all.
bool Run::checkpoint_due() {
  const bool asked = signals_.take_checkpoint_request();
  const double interval = built_.resolved.output.checkpoint_interval;
  const bool due = interval > 0 && (!saved_time_ || seconds_between(saved_, Clock::now()) >= interval);
  return ranks().shared(asked || due);
}

// What the loop remembers now. The outputs must be on disk before a checkpoint counts on them.
void Run::flush_outputs() {
  snapshots_->finish_queue();
  flush_to_disk(history_->path());
  profiles_->finish();
}

RunRecord Run::run_record() {
  RunRecord run;
  run.snapshots = snapshots_->finish_queue();
  flush_to_disk(history_->path());
  run.history_lines = history_->end().lines;
  run.history_bytes = history_->end().bytes;
  run.time = simulation_->time();
  run.steps = simulation_->steps();
  run.next_snapshot = snapshot_due_.next();
  run.next_history = history_due_.next();
  run.recorded_step = recorded_step_;
  run.snapshot_step = snapshot_step_;
  run.particles_now = particles_now_;
  run.particle_steps = counts_.particle_steps;
  run.most_in_walls = losses_.in_walls().most;
  run.deepest_in_wall = losses_.in_walls().deepest;
  run.most_in_sheets = thin_sheets_.most();
  run.time_of_most_in_sheets = thin_sheets_.time_of_most();
  run.wall_time = wall_before_ + seconds_between(started_, Clock::now());
  run.setup_time = counts_.setup_time;
  run.resumes = resumes_;
  run.geometry = geometry_;
  run.measures = measures_.state();
  run.profiles = profiles_->finish();
  return run;
}

// Comes before the outputs of the end, which are not of the schedule: a resumed run drops them and gives
// what an unbroken one gives. A state that the watch would not let pass is no checkpoint.
void Run::save_checkpoint() {
  simulation_->require_sound();
  write_checkpoint();
}

void Run::write_checkpoint() {
  SavedState state = simulation_->save();
  on_first_rank([&] { store_.write({provenance_.attributes(), run_record(), std::move(state)}); });
  saved_time_ = simulation_->time();
}

// A run is worth more than a checkpoint: it goes on without one, but not without its other outputs.
void Run::try_to_save_checkpoint() {
  simulation_->require_sound();
  on_first_rank([&] { flush_outputs(); });
  try {
    write_checkpoint();
    log_.info("checkpoint at " + std::to_string(*saved_time_) + " s");
  } catch (const Error& error) {
    log_.warning(std::string("no checkpoint, the last one stays: ") + error.what());
  }
  saved_ = Clock::now();
}

void Run::end_outputs() {
  record();
  take_snapshot();
  losses_.look_at_all(*simulation_);
  thin_sheets_.look(totals(), simulation_->time());  // also where the last line was there before
  provenance_.ended_utc = now_utc();
  on_first_rank([&] {
    snapshots_->close();
    snapshots_->describe(provenance_.attributes());
  });
}

}  // namespace slagflow
