// The measures `flow_rate` and `volume`. The volume of a particle is spacing^d, that of its mass at rest
// density; in two dimensions volumes are per metre of width.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

// Flow through a plane.
//   passed    = volume that passed along the direction less what came back, since the start
//   behind    = volume in the domain that is not beyond the plane
//   flow rate = (passed - passed at the last line of the history) / time between the lines
// What left the domain while behind the plane, `lost_behind`, has not passed:
//   passed + behind + lost_behind = behind at the start
class FlowMeasure : public Measure {
 public:
  struct Geometry {
    FrontSetup plane;
    std::size_t index;  // of Totals::planes
    double volume;      // of a particle [m^d]
    int dimensions;
    bool periodic;  // the axis is: then nothing is behind the plane
  };
  FlowMeasure(const MeasureSpec& spec, const Geometry& geometry) : Measure(spec.name), geometry_(geometry) {}

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "flow_rate"; }

 private:
  double volume_of(std::int64_t particles) const { return static_cast<double>(particles) * geometry_.volume; }

  Geometry geometry_;
  PlaneState now_;
  double time_ = unknown, rate_ = unknown;
};

// Volume of the fluid in a box.
class VolumeMeasure : public Measure {
 public:
  // `index`: of Totals::boxes; `particle_volume` [m^d].
  VolumeMeasure(const MeasureSpec& spec, std::size_t index, double particle_volume, int dimensions);

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override { return {volume_, largest_}; }
  void restore(const double* state) override { volume_ = state[0], largest_ = state[1]; }
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "volume"; }

 private:
  std::size_t index_;
  double particle_volume_;
  int dimensions_;
  double volume_ = unknown, largest_ = 0;
};

}  // namespace slagflow
