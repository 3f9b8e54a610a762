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

// The files that a case's profiles and surfaces are written to, in the order in which a run holds them.
struct MeasureFile {
  MeasureType type;
  std::string name;
};
std::vector<MeasureFile> measure_files(const Case&);

// The files of a run's profiles and surfaces.
class ProfileFiles {
 public:
  // Begins the files in a folder, or goes on with them behind `ends` (see HistoryFile): two numbers, lines
  // and bytes, for each. Throws Error.
  ProfileFiles(const Case&, const SimulationSetup&, const std::string& folder);
  ProfileFiles(const Case&, const SimulationSetup&, const std::string& folder,
               const std::vector<std::int64_t>& ends);

  // Those of now, for each file a line a point or column. A call of all ranks.
  using Lines = std::vector<std::vector<std::vector<double>>>;
  Lines read(const Simulation&) const;
  // Adds them. Throws Error.
  void write(const Lines&);
  // What lies in the files so far; they are on disk afterwards.
  std::vector<std::int64_t> finish();

 private:
  std::vector<SurfaceSetup> surfaces_;
  bool heat_;
  std::size_t profiles_ = 0;
  std::vector<HistoryFile> files_;  // of the first rank
};

}  // namespace slagflow
