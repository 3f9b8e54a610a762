// A table of numbers as CSV, one line at a time, on disk as soon as it is written.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "simulation/simulation.hpp"

namespace slagflow {

// How far a table goes.
struct HistoryEnd {
  std::int64_t lines = 0;  // without the header
  std::int64_t bytes = 0;  // of the file
};

// Throws Error naming the file when it cannot be written.
class HistoryFile {
 public:
  // Begins a table, in place of any earlier one.
  HistoryFile(std::string path, const std::vector<std::string>& columns);
  // Goes on with a table behind `end`; what lies beyond is cut off. Throws Error, too, when the file is
  // shorter than that or has other columns.
  HistoryFile(std::string path, const std::vector<std::string>& columns, const HistoryEnd& end);

  // One value for each column; numbers have 9 significant digits, not-a-number is an empty field.
  void write(const std::vector<double>& values);

  HistoryEnd end() const { return end_; }
  const std::string& path() const { return path_; }

 private:
  void put(const std::string& line);

  std::string path_;
  std::size_t columns_;
  HistoryEnd end_;
  std::ofstream file_;
};

// The columns that every run has, units in the names, and their values now.
std::vector<std::string> history_columns();
std::vector<double> history_values(const Simulation& simulation, const Totals& totals);

}  // namespace slagflow
