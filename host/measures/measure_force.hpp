// The measure `force`: what the fluid does to a wall.
//   force  = (impulse on the wall - impulse at the last line of the history) / time between the lines,
// the mean over the time between two lines; in parts, of pressure and of viscosity, and as a torque about a
// point that stays in space.
// In two dimensions forces are per metre of width.
#pragma once

#include "host/measures/measures.hpp"

namespace slagflow {

class ForceMeasure : public Measure {
 public:
  ForceMeasure(const MeasureSpec& spec, std::string wall, int dimensions)
      : Measure(spec.name),
        body_(static_cast<std::size_t>(spec.wall)),
        wall_(std::move(wall)),
        about_(spec.about),
        dimensions_(dimensions) {}

  std::vector<std::string> columns() const override;
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "force"; }

 private:
  struct Load {
    Vec3d pressure, viscous, torque;  // forces and torque about the point, or their integrals over time
  };

  std::size_t body_;
  std::string wall_;
  Vec3d about_;
  int dimensions_;
  double time_ = unknown, work_ = 0;
  Load impulse_;  // [N s], [N m s] so far
  Load mean_{
      {unknown, unknown, unknown}, {unknown, unknown, unknown}, {unknown, unknown, unknown}};  // [N], [N m]
  double largest_ = unknown, largest_time_ = unknown;  // size of the force
};

}  // namespace slagflow
