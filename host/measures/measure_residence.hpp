// The measure `residence`: how long the fluid that leaves through an outlet was in the domain.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

class ResidenceMeasure : public Measure {
 public:
  // `index`: of Totals::residences.
  ResidenceMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "residence"; }

 private:
  std::size_t index_;
  std::string outlet_;
  ResidenceState now_;
};

}  // namespace slagflow
