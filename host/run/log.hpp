// Messages of a run: to stderr, and to log.txt once the run has a folder.
#pragma once

#include <fstream>
#include <string>

namespace slagflow {

enum class Verbosity { normal, quiet };  // quiet: only warnings and errors on stderr; the file has all

class Log {
 public:
  explicit Log(Verbosity verbosity);
  // Ends a line that a status left open.
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // From now on also into this file, what was said so far first; with std::ios::app behind what it holds.
  // Throws Error when it cannot be opened.
  void open(const std::string& path, std::ios::openmode mode = std::ios::trunc);

  void info(const std::string& message);
  void warning(const std::string& message);  // "warning: ..."
  void error(const std::string& message);    // "error: ..."

  void note(const std::string& message);  // for the file alone: what stdout has at the end

  // A line that the next one replaces; for terminals, never in the file.
  void status(const std::string& line);
  bool quiet() const { return verbosity_ == Verbosity::quiet; }

 private:
  void show(const std::string& line);
  void keep(const std::string& line);
  void clear_status();

  Verbosity verbosity_;
  std::ofstream file_;
  std::string before_open_;
  std::size_t status_length_ = 0;
};

}  // namespace slagflow
