// The command line: run, check, info.
#pragma once

namespace slagflow {

// Returns the exit code: 0 done, 1 failed, 2 bad arguments or input, 130 interrupted.
// Results go to stdout, messages to stderr. Throws nothing.
int run_program(int argc, const char* const* argv);

// The same of one of the processes that a launcher has started, as mpirun does.
int run_with_others(int argc, char** argv);

}  // namespace slagflow
