// The folder of a run.
#pragma once

#include <string>

#include "host/run/run.hpp"

namespace slagflow {

// Where a run goes: the folder of the options, else runs/<case name>.
std::string run_folder(const Case& c, const RunOptions& options);

// Throws InputError if the folder holds anything and must not be overwritten, or is no folder.
void require_free_folder(const std::string& folder, Overwrite overwrite);

// Throws InputError if the run would put its case.toml in the place of the case file, which no run has left.
void require_not_the_case(const std::string& folder, const std::string& case_file);

// Holds an existing folder for one run at a time, also against other programs; the system ends it with the
// process. File systems without locks are trusted.
class FolderLock {
 public:
  // Throws InputError when another run holds the folder.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_;
};

// Creates the folder. Throws Error naming it.
void create_folder(const std::string& folder);

// Removes what an earlier run wrote there and nothing else. Throws Error naming the file.
void clear_folder(const std::string& folder);

// Writes a whole file, beside an earlier one, and then puts it in its place. Throws Error naming it; an
// earlier one is then as it was.
void write_file(const std::string& path, const std::string& text);

}  // namespace slagflow
