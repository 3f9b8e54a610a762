// Runs a case, or goes on with a run that was broken off.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/run/log.hpp"

namespace slagflow {

enum class Overwrite { refuse, replace };

struct RunOptions {
  std::string folder;           // empty: runs/<case name>
  std::optional<double> until;  // [s] ends the run then instead of at output.end_time
  int threads = 0;              // CPU build; 0: as OpenMP has it
  bool time_parts = false;      // CUDA build: kernel by kernel, so that summary.json tells each part's time
  Verbosity verbosity = Verbosity::normal;
  Overwrite overwrite = Overwrite::refuse;
};

enum class RunStatus { done, interrupted, failed };

struct RunOutcome {
  RunStatus status = RunStatus::done;
  std::string reason;  // why it failed
  std::string folder;
  std::vector<std::string> results;  // for people: a line for each measure and the like

  int exit_code() const;  // 0, 130 or 1
};

// Runs a case to its end, to an interrupt (SIGINT, SIGTERM) or to a failure, which is an outcome and not an
// exception: the files are closed, the last state and the summary are written as far as that can be done.
// Throws InputError before anything is written: the folder holds a run already or one is at work in it, the
// geometry is impossible; and Error when the folder or its first files cannot be written.
RunOutcome run_case(const Case& c, const RunOptions& options);

// Goes on with the run in options.folder from its newest sound checkpoint, to the end of its case or
// options.until, and gives what an unbroken run gives, bit by bit. Outputs later than the checkpoint are
// written anew. A run that is at its end already stays as it is, and the first result says so.
// Throws InputError: no such folder, another run at work in it, a build of another precision or backend; and
// Error: no sound checkpoint (with the reasons), or the case's STL files have changed.
RunOutcome resume_run(const RunOptions& options);

}  // namespace slagflow
