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
  std::vector<std::string> changes;  // of a run that goes on: "key=value" each
};

// A run that starts from a state of another one.
struct StartRequest {
  std::string from;                    // DIR, for its newest checkpoint, or DIR@TIME
  std::string file;                    // its case; empty: that of the other run
  std::vector<std::string> overrides;  // "key=value" each
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

// The same from a state of another run: of a checkpoint, or of the snapshot nearest to a time. The clock goes
// on, so that walls go on with their motions; measures, counts of what left and the mass balance begin anew
// with the fluid that is there. The folder holds the state in start.h5. Throws InputError, too, when there is
// no such state, or it does not fit the case.
RunOutcome run_from(const StartRequest& request, const RunOptions& options);

// Goes on with the run in options.folder from its newest sound checkpoint, to the end of its case or
// options.until, and gives what an unbroken run gives, bit by bit. Outputs later than the checkpoint are
// written anew. A run that is at its end already stays as it is, and the first result says so. Keys that may
// change in a run are taken from options.changes and from the folder's case.toml.
// Throws InputError: no such folder, another run at work in it, a build of another precision or backend,
// outputs that are missing, changes of other keys; and Error: no sound checkpoint (with the reasons), or the
// case's STL files have changed.
RunOutcome resume_run(const RunOptions& options);

}  // namespace slagflow
