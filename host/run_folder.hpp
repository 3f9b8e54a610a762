// The folder of a run.
#pragma once

#include <string>

#include "host/run.hpp"

namespace slagflow {

// Where a run goes: the folder of the options, else runs/<case name>.
std::string run_folder(const Case& c, const RunOptions& options);

// Throws InputError if the folder holds anything and must not be overwritten, or is no folder.
void require_free_folder(const std::string& folder, Overwrite overwrite);

// Creates the folder, or removes what an earlier run wrote there and nothing else.
// Throws Error naming the folder or file.
void prepare_folder(const std::string& folder);

// Writes a whole file. Throws Error naming it.
void write_file(const std::string& path, const std::string& text);

}  // namespace slagflow
