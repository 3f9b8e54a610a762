// The measure `flux`: what passes a rectangle, each way, by fluid.
//   forward, backward = volume that has gone through along the normal and against it, since the start
//   flow              = (net volume - that at the last line of the history) / time between the lines
// The volume of a particle is spacing^d, that of its mass at rest density; in two dimensions a metre of
// width.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

class FluxMeasure : public Measure {
 public:
  // `index`: of Totals::fluxes.
  FluxMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "flux"; }

 private:
  struct Passed {
    double volume = 0, mass = 0;  // [m^d], [kg]
  };
  Passed passed(const std::vector<std::int64_t>& counts) const;

  std::size_t index_;
  double particle_volume_;
  std::string unit_;
  std::vector<std::string> fluids_;
  std::vector<double> density_;
  FluxState now_;
  double time_ = unknown, flow_ = unknown;
};

}  // namespace slagflow
