#include "host/output/checkpoint_store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "backend/error.hpp"

namespace slagflow {
namespace {

[[noreturn]] void fail(const std::string& path, const char* action) {
  throw Error(std::string("cannot ") + action + " " + path + ": " + std::strerror(errno));
}

// An open file; closing tells whether all went well.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags)
      : path_(path), file_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (file_ < 0) fail(path_, "open");
  }
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(const std::vector<std::byte>& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(file_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno != EINTR) fail(path_, "write to");
      if (count > 0) done += static_cast<std::size_t>(count);
    }
  }
  // File systems that cannot do it say EINVAL; there is nothing to wait for then.
  void flush() {
    if (::fsync(file_) != 0 && errno != EINVAL && errno != EROFS) fail(path_, "flush");
  }
  void close() {
    const int file = file_;
    file_ = -1;
    if (::close(file) != 0) fail(path_, "close");
  }

 private:
  std::string path_;
  int file_;
};

void write_new(const std::string& path, const std::vector<std::byte>& bytes) {
  try {
    Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(bytes);
    file.flush();
    file.close();
  } catch (const Error&) {
    ::unlink(path.c_str());
    throw;
  }
}

void rename_file(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) fail(from, ("rename to " + to + " the file").c_str());
}

bool exists(const std::string& path) { return ::access(path.c_str(), F_OK) == 0; }

}  // namespace

void flush_to_disk(const std::string& path) {
  Descriptor file(path, O_RDONLY);
  file.flush();
}

void CheckpointStore::write(Checkpoint checkpoint) const {
  const std::string path = path_of(checkpoint_name), unfinished = path_of(unfinished_checkpoint_name);
  write_new(unfinished, checkpoint_bytes(std::move(checkpoint), path));
  if (exists(path)) rename_file(path, path_of(previous_checkpoint_name));
  rename_file(unfinished, path);
  flush_to_disk(folder_);
}

FoundCheckpoint CheckpointStore::read_newest() const {
  FoundCheckpoint found;
  for (const char* name : {checkpoint_name, previous_checkpoint_name}) {
    found.path = path_of(name);
    if (!exists(found.path)) continue;
    try {
      found.checkpoint = read_checkpoint(found.path);
      return found;
    } catch (const Error& error) {
      found.damaged.emplace_back(error.what());
    }
  }
  if (found.damaged.empty())
    throw InputError(folder_ + ": holds no " + checkpoint_name +
                     " to resume from: allowed: the folder of a run" +
                     (exists(path_of("particles.vtkhdf"))
                          ? "; slagflow run --from DIR@TIME -o NEW begins a new run with one of its snapshots"
                          : ""));
  std::string reasons = folder_ + ": holds no checkpoint that can be used";
  for (const std::string& reason : found.damaged) reasons += "\n  " + reason;
  throw Error(reasons);
}

void CheckpointStore::set_damaged_aside() const {
  const std::string path = path_of(checkpoint_name);
  if (exists(path)) rename_file(path, path_of(damaged_checkpoint_name));
}

}  // namespace slagflow
