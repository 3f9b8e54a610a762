// How far a run is: one line that is rewritten on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "host/run/log.hpp"

namespace slagflow {

struct ProgressState {
  double time = 0, end_time = 0;  // [s] simulated
  std::int64_t steps = 0;
  std::int64_t particle_steps = 0;
  double iterations_mean = 0;  // of the viscous solver
  double start_time = 0;       // [s]
};

// "37.5 %  t 0.0375 s  step 402  51.2 steps/s  ..."; wall_time in seconds, rates over all of it.
std::string progress_line(const ProgressState& state, double wall_time);

class Progress {
 public:
  // `wall_before` [s]: what earlier parts of the run took.
  explicit Progress(Log& log, double wall_before = 0);

  // To be called after every step; looks at the clock and mostly does nothing.
  void update(const ProgressState& state);

 private:
  using Clock = std::chrono::steady_clock;

  Log& log_;
  double wall_before_;
  bool terminal_;
  Clock::time_point start_ = Clock::now(), shown_ = start_, logged_ = start_;
};

}  // namespace slagflow
