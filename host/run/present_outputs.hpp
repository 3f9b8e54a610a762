// Whether the outputs that a checkpoint counts on are there.
#pragma once

#include <string>

#include "host/case/case.hpp"
#include "host/output/checkpoint.hpp"

namespace slagflow {

// Throws InputError naming each file in the folder of a run that is missing or shorter than the checkpoint
// knows, and how to go on.
void require_outputs(const std::string& folder, const RunRecord& run, const Case& c);

}  // namespace slagflow
