// The measure `mixing`: how evenly a fluid is spread among the others in a box, as Lacey's index
//   M = (s0^2 - s^2) / (s0^2 - sr^2),  s0^2 = p (1 - p),  sr^2 = p (1 - p)/n
// p: its share of the particles in the box; s^2: variance of its share over the cells, weighted by their
// particles; n: particles of a cell. 0: apart; 1: as at random.
#pragma once

#include <array>

#include "host/measures/measures.hpp"

namespace slagflow {

struct Mixing {
  double index = unknown, share = unknown;  // unknown where one of the fluids is not there, or no cell is
};

// `cells`: particles of the fluid and of all in each cell; those with less than a quarter of `full` are left
// out.
Mixing mixing_of(const std::vector<std::array<double, 2>>& cells, double full);

class MixingMeasure : public Measure {
 public:
  MixingMeasure(const MeasureSpec& spec, const SimulationSetup& setup);

  std::vector<std::string> columns() const override { return {"index", "share"}; }
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override { return {now_.index, now_.share}; }
  void restore(const double* state) override { now_ = {state[0], state[1]}; }
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "mixing"; }

 private:
  Vec3d lower_, upper_;  // [m]
  double cell_, full_;   // [m]; particles of a full one
  std::uint8_t kind_;
  std::string fluid_;
  Mixing now_;
};

}  // namespace slagflow
