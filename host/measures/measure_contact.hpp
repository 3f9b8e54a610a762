// The measure `contact`: how much of a wall the fluid touches, and its pressure there.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

class ContactMeasure : public Measure {
 public:
  // `index`: of Totals::contacts.
  ContactMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "contact"; }

 private:
  // The most so far, and when and where.
  struct Largest {
    double pressure = unknown, time = unknown;
    Vec3d place{unknown, unknown, unknown};
  };
  double share() const { return now_.area > 0 ? now_.wetted / now_.area : 0; }

  std::size_t index_;
  std::string wall_, unit_;
  ContactState now_;
  Largest largest_;
  double largest_share_ = 0;
};

}  // namespace slagflow
