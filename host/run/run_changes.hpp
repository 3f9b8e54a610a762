// Which keys of a case may change while its run goes on, and how they do.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/run/run.hpp"

namespace slagflow {

// Of a run that goes on.
struct GoingCase {
  BuiltCase built;
  std::string changes;                // for Provenance::changes
  std::vector<std::string> messages;  // of what is taken
};

// The case of the checkpoint with the changes that options.changes, options.until and the folder's case.toml
// make. Throws InputError that names each key which may not change, with the value it has and the new one.
GoingCase going_case(const FoundCheckpoint& found, const RunOptions& options);

}  // namespace slagflow
