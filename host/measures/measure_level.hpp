// The measure `level`: where the surface of the fluid is on a line, and how much of the line is in fluid.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

class LevelMeasure : public Measure {
 public:
  LevelMeasure(const MeasureSpec& spec, std::size_t index) : Measure(spec.name), index_(index) {}

  std::vector<std::string> columns() const override { return {"surface_m", "thickness_m"}; }
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "level"; }

 private:
  std::size_t index_;  // of Totals::levels
  double surface_ = unknown, thickness_ = 0;
  double highest_ = unknown, time_of_highest_ = unknown;
};

}  // namespace slagflow
