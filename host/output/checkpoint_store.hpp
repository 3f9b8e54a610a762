// The checkpoints in the folder of a run: the newest one and the one before.
#pragma once

#include <string>
#include <vector>

#include "host/output/checkpoint.hpp"

namespace slagflow {

constexpr const char* checkpoint_name = "checkpoint.h5";
constexpr const char* previous_checkpoint_name = "checkpoint.previous.h5";
constexpr const char* unfinished_checkpoint_name = "checkpoint.h5.tmp";
constexpr const char* damaged_checkpoint_name = "checkpoint.damaged.h5";  // set aside by a resumed run

// Waits until a file's content, or a folder's list of files, is on the disk. Throws Error naming it.
void flush_to_disk(const std::string& path);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::string path;
  std::vector<std::string> damaged;  // why each newer one cannot be used
};

class CheckpointStore {
 public:
  explicit CheckpointStore(std::string folder) : folder_(std::move(folder)) {}

  // Writes beside the present checkpoint, flushes it to disk and only then puts it in its place; the present
  // one becomes the previous. Throws Error naming file and reason; the present ones are then as they were.
  void write(Checkpoint checkpoint) const;

  // The newest that is sound. Throws Error with the reasons if none is.
  FoundCheckpoint read_newest() const;

  // Renames a newest checkpoint that turned out damaged, so that it never replaces the previous one.
  void set_damaged_aside() const;

 private:
  std::string path_of(const char* name) const { return folder_ + "/" + name; }

  std::string folder_;
};

}  // namespace slagflow
