// What the options of a run do, new or resumed.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/run/log.hpp"
#include "host/run/run.hpp"

namespace slagflow {

// Throws InputError when the device is to repeat iterations and cannot.
void require_loops(const Case& c);

// Throws InputError where what the case asks for does not go with several ranks yet.
void require_dealable(const Case& c);

// The end time of the case stays: the time steps before it are part of the flow.
void end_at(double until, Case& c);

// A new end time is where the run ends, whatever an earlier --until has left in the case.
void end_with_end_time(const std::vector<std::string>& overrides, Case& c);

void warn_of_threads(int threads, Log& log);

// Adds the command that goes on with a run that was interrupted.
RunOutcome with_advice(RunOutcome outcome, const RunOptions& options);

}  // namespace slagflow
