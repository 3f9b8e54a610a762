#include "host/run/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>

#include "backend/error.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/run/start_state.hpp"

namespace slagflow {
namespace {

namespace fs = std::filesystem;

constexpr const char* unfinished_suffix = ".tmp";

// Checkpoints first: once the files that they count on begin to go, nothing must be left to resume from.
constexpr std::array<const char*, 10> run_files{
    checkpoint_name,    previous_checkpoint_name, damaged_checkpoint_name, start_name,     "case.toml",
    "particles.vtkhdf", "walls.vtkhdf",           "history.csv",           "summary.json", "log.txt"};

}  // namespace

std::string run_folder(const Case& c, const RunOptions& options) {
  return options.folder.empty() ? "runs/" + c.name : options.folder;
}

void require_free_folder(const std::string& folder, Overwrite overwrite) {
  std::error_code failed;
  if (!fs::exists(folder, failed)) return;
  if (!fs::is_directory(folder, failed)) throw InputError(folder + ": is a file; give a folder with -o");
  if (overwrite == Overwrite::refuse && !fs::is_empty(folder, failed))
    throw InputError(folder +
                     ": holds files already; --overwrite replaces an earlier run, -o takes another folder");
}

void require_not_the_case(const std::string& folder, const std::string& case_file) {
  const fs::path path = fs::path(folder) / "case.toml";
  std::error_code failed;
  if (!fs::equivalent(path, case_file, failed) || fs::exists(fs::path(folder) / "log.txt", failed)) return;
  throw InputError(path.string() +
                   ": is the case itself, which the run would replace; -o takes another folder");
}

FolderLock::FolderLock(const std::string& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0 || flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(folder_);
  throw InputError(folder + ": another run is writing to this folder");
}

FolderLock::~FolderLock() {
  if (folder_ >= 0) ::close(folder_);
}

void create_folder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed == std::errc::no_space_on_device)
    throw Error("cannot create the folder " + folder + ": " + failed.message());
  if (failed)
    throw InputError("cannot create the folder " + folder + ": " + failed.message() +
                     ": allowed: -o with a folder that can be written to");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(folder + ": cannot be written to: " + std::strerror(errno) +
                     ": allowed: -o with a folder that can be");
}

void clear_folder(const std::string& folder) {
  std::error_code failed;
  for (const std::string name : run_files) {
    for (const std::string& file : {name, name + unfinished_suffix}) {
      fs::remove(fs::path(folder) / file, failed);
      if (failed) throw Error("cannot remove " + folder + "/" + file + ": " + failed.message());
    }
  }
  const std::regex profile("(profile|surface)_.*\\.csv");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!std::regex_match(entry.path().filename().string(), profile)) continue;
    fs::remove(entry.path(), failed);
    if (failed) throw Error("cannot remove " + entry.path().string() + ": " + failed.message());
  }
}

void write_file(const std::string& path, const std::string& text) {
  const std::string unfinished = path + unfinished_suffix;
  std::ofstream file(unfinished, std::ios::trunc);
  file << text << std::flush;
  if (file && std::rename(unfinished.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(unfinished.c_str());
  throw Error("cannot write to " + path + ": " + reason);
}

}  // namespace slagflow
