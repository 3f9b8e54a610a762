// The measure `profile`: the fluid along lines, written to profile_NAME.csv with each snapshot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/measures/measures.hpp"
#include "host/output/history.hpp"

namespace slagflow {

class ProfileMeasure : public Measure {
 public:
  ProfileMeasure(const MeasureSpec& spec, const LineSetup& line) : Measure(spec.name), line_(line) {}

  std::vector<std::string> columns() const override { return {}; }
  std::vector<double> update(const MeasureMoment&) override { return {}; }
  std::vector<double> state() const override { return {}; }
  void restore(const double*) override {}
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "profile"; }

 private:
  LineSetup line_;
};

// "profile_NAME.csv"
std::string profile_file(const std::string& name);

// The files of a run's profiles, in the order of the case.
class ProfileFiles {
 public:
  // Begins the files in a folder, or goes on with them behind `ends` (see HistoryFile): two numbers, lines
  // and bytes, for each. Throws Error.
  ProfileFiles(const Case&, const std::string& folder);
  ProfileFiles(const Case&, const std::string& folder, const std::vector<std::int64_t>& ends);

  // Adds the profiles of now, a line for each point. Throws Error.
  void write(const Simulation&);
  // What lies in the files so far; they are on disk afterwards.
  std::vector<std::int64_t> finish();

 private:
  std::vector<HistoryFile> files_;
};

}  // namespace slagflow
