#include "host/run/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace slagflow {
namespace {

constexpr std::chrono::milliseconds between_status{500};
constexpr std::chrono::seconds between_lines{30};

std::string duration(double seconds) {
  const auto s = std::lround(seconds);
  std::array<char, 48> text{};
  if (s >= 3600) {
    std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld h", s / 3600, s / 60 % 60, s % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%ld:%02ld min", s / 60, s % 60);
  }
  return text.data();
}

// A line that wraps could not be rewritten.
std::string cut_to_terminal(std::string line) {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 && line.size() >= size.ws_col)
    line.resize(size.ws_col - 1u);
  return line;
}

}  // namespace

std::string progress_line(const ProgressState& state, double wall_time) {
  const double whole = state.end_time - state.start_time;
  const double done = whole > 0 ? (state.time - state.start_time) / whole : 1;
  const double wall = wall_time > 0 ? wall_time : 1e-9;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "%5.1f %%  t %.4g s  step %lld  %.3g steps/s  %.2g particle-steps/s  %.1f iterations",
                100 * (done < 1 ? done : 1), state.time, static_cast<long long>(state.steps),
                static_cast<double>(state.steps) / wall, static_cast<double>(state.particle_steps) / wall,
                state.iterations_mean);
  std::string line = text.data();
  if (done > 0 && done < 1) line += "  " + duration(wall * (1 - done) / done) + " left";
  return line;
}

Progress::Progress(Log& log, double wall_before)
    : log_(log), wall_before_(wall_before), terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::update(const ProgressState& state) {
  const auto now = Clock::now();
  const double wall = wall_before_ + std::chrono::duration<double>(now - start_).count();
  if (now - logged_ >= between_lines) {
    logged_ = now;
    log_.info(progress_line(state, wall));
  }
  if (terminal_ && now - shown_ >= between_status) {
    shown_ = now;
    log_.status(cut_to_terminal(progress_line(state, wall)));
  }
}

StageLine::StageLine(Show show, Times times)
    : show_(std::move(show)), thread_([this, times] { tell(times); }) {}

StageLine::~StageLine() {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    ended_ = true;
  }
  ends_.notify_all();
  thread_.join();
}

void StageLine::stage(const char* what) {
  const std::lock_guard<std::mutex> guard(mutex_);
  what_ = what;
}

void StageLine::tell(const Times& times) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (auto wait = times.before; !ends_.wait_for(lock, wait, [this] { return ended_; });
       wait = times.between) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    show_(std::string(what_) + ", " + std::to_string(std::lround(seconds)) + " s");
  }
}

StartProgress::StartProgress(Verbosity verbosity) : log_(verbosity) {
  if (isatty(STDERR_FILENO) == 1 && verbosity != Verbosity::quiet)
    line_.emplace([this](const std::string& line) { log_.status(cut_to_terminal(line)); });
}

}  // namespace slagflow
