#include <malloc.h>

#include "host/program/program.hpp"

int main(int argc, char** argv) {
  // Large buffers come from the system and go back to it, so that snapshots and checkpoints share memory.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  return slagflow::run_program(argc, argv);
}
