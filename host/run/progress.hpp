// How far a run is: one line that is rewritten on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

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

// What is being done, and for how long, when that takes longer than about a second.
class StageLine {
 public:
  using Show = std::function<void(const std::string&)>;
  struct Times {
    std::chrono::milliseconds before, between;
  };

  // `show` is called from a thread of its own, until this ends.
  explicit StageLine(Show show, Times times = {std::chrono::seconds(1), std::chrono::milliseconds(500)});
  ~StageLine();
  StageLine(const StageLine&) = delete;
  StageLine& operator=(const StageLine&) = delete;

  void stage(const char* what);

 private:
  using Clock = std::chrono::steady_clock;
  void tell(const Times& times);

  Show show_;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable ends_;
  const char* what_ = "";
  bool ended_ = false;
  std::thread thread_;  // last: it uses the others
};

// The same on stderr where that is a terminal; cleared at the end.
class StartProgress {
 public:
  explicit StartProgress(Verbosity verbosity);
  std::function<void(const char*)> stage() {
    return [this](const char* what) {
      if (line_) line_->stage(what);
    };
  }

 private:
  Log log_;
  std::optional<StageLine> line_;
};

}  // namespace slagflow
