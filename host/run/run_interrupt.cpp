#include "host/run/run_interrupt.hpp"

namespace slagflow {
namespace {

// A signal handler can reach nothing else.
volatile std::sig_atomic_t stop_requested = 0, checkpoint_requested = 0;

extern "C" void request_stop(int) {
  stop_requested = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

extern "C" void request_checkpoint(int) { checkpoint_requested = 1; }

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_requested = checkpoint_requested = 0;
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &interrupt_);
  sigaction(SIGTERM, &action, &terminate_);
  sigaction(SIGHUP, nullptr, &hang_up_);
  if (hang_up_.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = request_checkpoint;
  sigaction(SIGUSR1, &action, &checkpoint_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &interrupt_, nullptr);
  sigaction(SIGTERM, &terminate_, nullptr);
  sigaction(SIGHUP, &hang_up_, nullptr);
  sigaction(SIGUSR1, &checkpoint_, nullptr);
}

bool InterruptGuard::take_checkpoint_request() {
  const bool taken = checkpoint_requested != 0;
  checkpoint_requested = 0;
  return taken;
}

bool InterruptGuard::requested() const { return stop_requested != 0; }

}  // namespace slagflow
