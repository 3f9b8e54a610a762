#include "host/run/run_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <numeric>
#include <utility>

#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "fluid/constants.hpp"
#include "host/case/toml_reader.hpp"
#include "host/run/first_rank.hpp"
#include "host/run/rank_report.hpp"
#include "host/run/run_folder.hpp"

namespace slagflow {
namespace {

constexpr double rounding = 1e-12;  // of times, relative

template <class T>
std::uint64_t checksum_of(const std::vector<T>& values, std::uint64_t so_far) {
  return checksum(values.data(), values.size() * sizeof(T), so_far);
}

// Tells whether a case still starts from the same particles: its STL files are not part of it.
std::int64_t checksum_of(const SimulationSetup& setup) {
  const std::uint64_t sum =
      checksum_of(setup.walls.body,
                  checksum_of(setup.walls.position, checksum_of(setup.particles.position, checksum_start)));
  std::int64_t value = 0;
  std::memcpy(&value, &sum, sizeof value);
  return value;
}

}  // namespace

bool Schedule::due(double time) {
  if (time < next_ * (1 - rounding)) return false;
  next_ = following(time);
  return true;
}

double Schedule::following(double time) const {
  return (std::floor(time / interval_ * (1 + rounding)) + 1) * interval_;
}

void Schedule::restore(double next, double time) {
  const double own = following(time);
  next_ = std::abs(own - next) <= rounding * next ? next : own;
}

Run::Run(BuiltCase built, std::string folder, Log& log, InterruptGuard& signals)
    : signals_(signals),
      built_(std::move(built)),
      folder_(std::move(folder)),
      log_(log),
      store_(folder_),
      provenance_(run_provenance(built_.resolved)),
      geometry_(checksum_of(built_.setup)),
      snapshot_due_(built_.resolved.output.interval),
      history_due_(built_.resolved.output.history_interval),
      start_time_(built_.setup.start_time),
      measures_(built_.resolved, built_.setup),
      losses_(built_.resolved),
      openings_(built_.setup),
      heat_(built_.setup) {
  counts_.particles_start = static_cast<std::int64_t>(built_.setup.particles.position.size());
  counts_.walls = static_cast<std::int64_t>(built_.setup.walls.position.size());
  particles_now_ = counts_.particles_start;
  outcome_.folder = folder_;
}

void Run::begin_from(const Checkpoint& state) {
  provenance_.origin = origin_among(state.texts);
  note_origin();
}

void Run::note_origin() {
  if (provenance_.origin.empty()) return;
  provenance_.case_text =
      "# Began in a state of another run, start.h5: run by itself it begins with its regions.\n" +
      provenance_.case_text;
}

void Run::go_on_from(Checkpoint checkpoint, const std::string& changes) {
  const RunRecord& run = checkpoint.run;
  if (run.geometry != geometry_)
    throw Error(folder_ +
                ": the case gives other particles at the start than it did: have its STL files changed?");
  measures_.restore(run.measures);
  losses_.restore(run.most_in_walls, run.deepest_in_wall);
  thin_sheets_.restore(run.most_in_sheets, run.time_of_most_in_sheets);
  snapshot_due_.restore(run.next_snapshot, run.time);
  history_due_.restore(run.next_history, run.time);
  recorded_step_ = run.recorded_step;
  snapshot_step_ = run.snapshot_step;
  particles_now_ = run.particles_now;
  counts_.particle_steps = run.particle_steps;
  wall_before_ = run.wall_time;
  resumes_ = run.resumes + 1;
  provenance_.changes = changes;
  provenance_.begin_with(checkpoint.texts);
  note_origin();
  saved_time_ = run.time;
  resumed_ = std::move(checkpoint);
}

RunOutcome Run::execute() {
  try {
    start();
    outcome_.status = loop();
    save_checkpoint();
    end_outputs();
  } catch (const LocalError& error) {
    if (ranks().several()) end_all(error.what());
    fail(error.what());
  } catch (const std::bad_alloc&) {
    if (ranks().several()) end_all("out of memory");
    fail("out of memory (" + std::to_string(counts_.particles_start) + " fluid and " +
         std::to_string(counts_.walls) + " wall particles)");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  counts_.wall_time = wall_before_ + seconds_between(started_, Clock::now());
  write_summary();
  if (simulation_) log_.info("end: " + progress_line(progress(), counts_.wall_time));
  tell(measures_.lines());
  tell_compression();
  tell_losses();
  return std::move(outcome_);
}

void Run::start() {
  on_first_rank([&] { write_file(folder_ + "/case.toml", provenance_.case_text); });
  log_.info("slagflow " + provenance_.version + " (" + provenance_.commit + "), " + provenance_.backend +
            ", " + provenance_.precision + ", " + provenance_.device);
  log_.info("case " + built_.resolved.name + ": " + std::to_string(counts_.particles_start) + " fluid and " +
            std::to_string(counts_.walls) + " wall particles, to " + folder_);
  simulation_.emplace(built_.setup);
  built_.setup.particles = {};  // on the device now
  built_.setup.walls = {};
  if (resumed_) simulation_->restore(resumed_->state);
  on_first_rank([&] { open_outputs(); });
  open_profiles();
  counts_.setup_time = (resumed_ ? resumed_->run.setup_time : 0) + seconds_between(begun_, Clock::now());
  resumed_.reset();
  started_ = saved_ = Clock::now();
}

RunStatus Run::loop() {
  Progress shown(log_, wall_before_);
  Simulation& simulation = *simulation_;
  while (true) {
    const double time = simulation.time();
    if (history_due_.due(time)) record();
    if (snapshot_due_.due(time)) take_snapshot();
    if (time >= built_.resolved.output.last_time()) return RunStatus::done;
    const std::string& last = built_.resolved.output.stop_after;
    if (measures_.arrived(last)) return end_early(last + " has arrived, as output.stop_after asks");
    if (ranks().shared(signals_.requested())) {
      log_.warning("interrupted at " + std::to_string(time) + " s");
      return RunStatus::interrupted;
    }
    if (simulation.particles() == 0 && !openings_.feeds_after(time))
      return end_early("all fluid has left the domain and none can come");
    if (checkpoint_due()) try_to_save_checkpoint();
    simulation.step();
    counts_.particle_steps += particles_now_;
    shown.update(progress());
  }
}

RunStatus Run::end_early(const std::string& reason) {
  ended_early_ = reason + ", at " + std::to_string(simulation_->time()) + " s";
  return RunStatus::done;
}

// Of now: they are taken once, however many ask.
const Totals& Run::totals() {
  if (!totals_ || totals_step_ != simulation_->steps()) totals_ = simulation_->totals();
  totals_step_ = simulation_->steps();
  return *totals_;
}

// At the end: on stdout, where the caller puts them, and in the log.
void Run::tell(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) log_.note(line), outcome_.results.push_back(line);
}

void Run::tell_compression() {
  if (!simulation_) return;
  constexpr double much = 0.1;
  const PeakCompression largest = simulation_->largest_compression();
  const std::string line = compression_line(largest);
  tell({line});
  if (largest.value <= much) return;
  const double sound_speed = built_.resolved.numerics.sound_speed;
  std::array<char, 40> now{};
  std::snprintf(now.data(), now.size(), "%.4g", sound_speed);
  log_.warning(line + ": too much for a fluid that is to be incompressible; numerics.sound_speed = " +
               show(stiff_enough(sound_speed, largest.value, much)) + " m/s (it is " + now.data() +
               ") keeps it below " + show(much));
}

// Of the start, and what has come in since.
std::int64_t Run::all_particles(const Totals& totals) const {
  return std::accumulate(totals.fed.begin(), totals.fed.end(), counts_.particles_start);
}

void Run::tell_losses() {
  if (!ended_early_.empty()) tell({"ended early: " + ended_early_});
  if (!simulation_) return;
  try {
    tell(openings_.lines(totals())), tell(heat_.lines(totals()));
    const std::int64_t start = all_particles(totals());
    tell(losses_.lines(totals(), start));
    for (const std::string& warning : losses_.warnings(totals(), start)) log_.warning(warning);
    tell(thin_sheets_.lines(built_.resolved, start));
    for (const std::string& warning : thin_sheets_.warnings(built_.resolved, start)) log_.warning(warning);
  } catch (const std::exception& error) {
    log_.warning(std::string("the losses are not known: ") + error.what());
  }
}

// What one rank alone has seen: the others wait for it in vain.
void Run::end_all(const std::string& reason) {
  log_.note("error: rank " + std::to_string(ranks().rank()) + ": " + reason);
  ranks().abort(1, reason);
}

void Run::fail(const std::string& reason) {
  outcome_.status = RunStatus::failed;
  outcome_.reason = reason;
  totals_.reset();  // the step that failed may have moved particles
  log_.error(reason);
  if (ranks().shared(snapshots_.has_value())) save_last_state();
  if (saved_time_)
    log_.info(std::string("the last good state, at ") + std::to_string(*saved_time_) + " s, is in " +
              checkpoint_name);
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
    if (simulation_) add_results(summary, *simulation_, totals(), counts_);
    if (simulation_)
      losses_.add_to(summary, totals()), openings_.add_to(summary, totals()), heat_.add_to(summary, totals());
    thin_sheets_.add_to(summary);
    if (simulation_ && ranks().several()) summary.set("ranks", rank_report(*simulation_));
  } catch (const std::exception& error) {
    log_.warning(std::string("the summary lacks the results: ") + error.what());
  }
  constexpr const char* names[] = {"done", "interrupted", "failed"};
  summary.set("status", names[static_cast<int>(outcome_.status)]).set("resumes", resumes_);
  summary.set("ended_utc", provenance_.ended_utc.empty() ? now_utc() : provenance_.ended_utc);
  if (outcome_.status == RunStatus::failed) summary.set("reason", outcome_.reason);
  if (!ended_early_.empty()) summary.set("ended_early", ended_early_);
  summary.set("measures", measures_.summary());
  try {
    on_first_rank([&] { write_file(folder_ + "/summary.json", summary.text() + "\n"); });
  } catch (const std::exception& error) {
    log_.error(error.what());
    outcome_.status = RunStatus::failed;
  }
}

ProgressState Run::progress() const {
  const SolverTotals solver = simulation_->solver_totals();
  const double mean =
      solver.steps > 0 ? static_cast<double>(solver.iterations) / static_cast<double>(solver.steps) : 0;
  return {simulation_->time(),
          built_.resolved.output.last_time(),
          simulation_->steps(),
          counts_.particle_steps,
          mean,
          start_time_};
}

}  // namespace slagflow
