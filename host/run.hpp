// Runs a case: the folder and its files, the loop over the steps, and how a run ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/case.hpp"
#include "host/log.hpp"

namespace slagflow {

enum class Overwrite { refuse, replace };

struct RunOptions {
  std::string folder;           // empty: runs/<case name>
  std::optional<double> until;  // [s] ends the run then instead of at output.end_time
  int threads = 0;              // CPU build; 0: as OpenMP has it
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
// Throws InputError before anything is written: the folder holds a run already, the geometry is impossible;
// and Error when the folder or its first files cannot be written.
RunOutcome run_case(const Case& c, const RunOptions& options);

}  // namespace slagflow
