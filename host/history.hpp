// A table of numbers as CSV, one line at a time, on disk as soon as it is written.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "simulation.hpp"

namespace slagflow {

// Throws Error naming the file when it cannot be written.
class HistoryFile {
 public:
  HistoryFile(std::string path, std::vector<std::string> columns);

  // One value for each column; numbers have 9 significant digits, not-a-number is an empty field.
  void write(const std::vector<double>& values);

 private:
  void require_written();

  std::string path_;
  std::size_t columns_;
  std::ofstream file_;
};

// The columns that every run has, units in the names, and their values now.
std::vector<std::string> history_columns();
std::vector<double> history_values(const Simulation& simulation, const Totals& totals);

}  // namespace slagflow
