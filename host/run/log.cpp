#include "host/run/log.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "backend/error.hpp"

namespace slagflow {

Log::Log(Verbosity verbosity) : verbosity_(verbosity) {}

Log::~Log() { clear_status(); }

void Log::open(const std::string& path, std::ios::openmode mode) {
  file_.open(path, mode);
  file_ << before_open_ << std::flush;
  before_open_.clear();
  if (!file_) throw Error("cannot write to " + path + ": " + std::strerror(errno));
}

void Log::info(const std::string& message) {
  if (!quiet()) show(message);
  keep(message);
}

void Log::note(const std::string& message) { keep(message); }

void Log::warning(const std::string& message) {
  show("warning: " + message);
  keep("warning: " + message);
}

void Log::error(const std::string& message) {
  show("error: " + message);
  keep("error: " + message);
}

void Log::status(const std::string& line) {
  if (quiet()) return;
  const std::size_t blanks = status_length_ > line.size() ? status_length_ - line.size() : 0;
  std::fprintf(stderr, "\r%s%*s", line.c_str(), static_cast<int>(blanks), "");
  std::fflush(stderr);
  status_length_ = line.size();
}

void Log::show(const std::string& line) {
  clear_status();
  std::fprintf(stderr, "%s\n", line.c_str());
}

// The log is no reason to end a run: a failed write shows in the other files soon enough.
void Log::keep(const std::string& line) {
  if (file_.is_open()) {
    file_ << line << std::endl;
  } else {
    before_open_ += line + '\n';
  }
}

void Log::clear_status() {
  if (status_length_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(status_length_), "");
  status_length_ = 0;
}

}  // namespace slagflow
