// Ctrl-C, SIGTERM, SIGHUP and SIGUSR1 during a run.
#pragma once

#include <csignal>

namespace slagflow {

// While it lives, a first SIGINT or SIGTERM only sets a flag and a second one ends the process at once; so
// does the SIGHUP of a terminal that is closed, unless it was ignored before (nohup). SIGUSR1 sets another
// flag. One at a time: the flag belongs to the process, as signals do.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;  // to stop
  // Whether SIGUSR1 has come since the last call.
  bool take_checkpoint_request();

 private:
  struct sigaction interrupt_ {
  }, terminate_{}, hang_up_{}, checkpoint_{};
};

}  // namespace slagflow
