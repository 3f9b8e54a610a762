#include <malloc.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>

#include "host/program/program.hpp"

namespace {

// OpenMP's threads wait for each other by spinning, unless they were told not to when its library was loaded:
// on a busy machine they take each other's time, and a step takes ten times as long. So the program starts
// itself anew, once, with the wish in its environment; a wish that is there already stays. Goes on as it is
// where that fails.
void wait_without_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  std::array<char, 4096> self{};
  const ssize_t length = readlink("/proc/self/exe", self.data(), self.size() - 1);
  if (length <= 0 || setenv("OMP_WAIT_POLICY", "passive", 1) != 0) return;
  execv(self.data(), argv);
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  // Large buffers come from the system and go back to it, so that snapshots and checkpoints share memory.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  // A file that is as large as may be, and a pipe that nobody reads any more, are errors of a write.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  return slagflow::run_with_others(argc, argv);
}
