// The measure `surface`: the free surface along a line or over a grid, written to surface_NAME.csv with each
// snapshot.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

class SurfaceMeasure : public Measure {
 public:
  // `index`: of Totals::surfaces.
  SurfaceMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "surface"; }

 private:
  std::size_t index_;
  SurfaceSetup surface_;
  double covered_ = 0, mean_thickness_ = 0, highest_ = unknown;  // now
  double highest_so_far_ = unknown, time_of_highest_ = unknown;
};

// Where the surface is in a column: its coordinate against gravity; not-a-number without fluid [m].
double surface_of(const LineSetup& column, const LevelState& level);

// "surface_NAME.csv", and its columns.
std::string surface_file(const std::string& name);
std::vector<std::string> surface_columns();
// A line of it for each column.
std::vector<std::vector<double>> surface_lines(double time, const SurfaceSetup& surface,
                                               const std::vector<LevelState>& levels);

}  // namespace slagflow
