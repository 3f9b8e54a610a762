// The measures `solid` and `heat`.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

// Volume of the fluid in a box whose solid fraction is not below that of the measure; in two dimensions per
// metre of width.
class SolidMeasure : public Measure {
 public:
  // `index`: of Totals::solids.
  SolidMeasure(const MeasureSpec&, const SimulationSetup&, std::size_t index);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override { return {volume_, largest_}; }
  void restore(const double* state) override { volume_ = state[0], largest_ = state[1]; }
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "solid"; }

 private:
  std::size_t index_;
  double particle_volume_, fraction_;
  bool flat_;
  double volume_ = unknown, largest_ = 0;
};

// Heat that a wall has taken from the fluid since the start [J], and how fast [W] between the last two lines
// of the history; in two dimensions per metre of width.
class HeatMeasure : public Measure {
 public:
  HeatMeasure(const MeasureSpec&, const SimulationSetup&);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override { return {time_, heat_, rate_}; }
  void restore(const double* state) override { time_ = state[0], heat_ = state[1], rate_ = state[2]; }
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "heat"; }

 private:
  std::size_t body_;
  std::string wall_;
  bool flat_;
  double time_ = unknown, heat_ = 0, rate_ = unknown;
};

}  // namespace slagflow
