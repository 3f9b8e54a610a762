// Ctrl-C and SIGTERM during a run.
#pragma once

#include <csignal>

namespace slagflow {

// While it lives, a first SIGINT or SIGTERM only sets a flag and a second one ends the process at once.
// One at a time: the flag belongs to the process, as signals do.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;

 private:
  struct sigaction interrupt_ {
  }, terminate_{};
};

}  // namespace slagflow
