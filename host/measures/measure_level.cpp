#include "host/measures/measure_level.hpp"

#include <cmath>

#include "host/measures/measure_text.hpp"

namespace slagflow {

std::vector<double> LevelMeasure::update(const MeasureMoment& moment) {
  const LevelState& now = moment.totals.levels.at(index_);
  surface_ = now.surface, thickness_ = now.thickness;
  if (std::isfinite(surface_) && !(surface_ <= highest_)) highest_ = surface_, time_of_highest_ = moment.time;
  return {surface_, thickness_};
}

std::vector<double> LevelMeasure::state() const { return {surface_, thickness_, highest_, time_of_highest_}; }

void LevelMeasure::restore(const double* state) {
  surface_ = state[0], thickness_ = state[1], highest_ = state[2], time_of_highest_ = state[3];
}

Json LevelMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("surface", surface_).set("thickness", thickness_);
  return result.set("highest_surface", highest_).set("time_of_highest_surface", time_of_highest_);
}

std::string LevelMeasure::line() const {
  if (!std::isfinite(highest_)) return "no fluid came to it";
  const std::string now = std::isfinite(surface_) ? format("surface at %.4g m of its line, ", surface_) +
                                                        format("%.4g m of fluid", thickness_)
                                                  : std::string("no fluid");
  return now + format("; farthest %.4g m", highest_) + format(" at %.4g s", time_of_highest_);
}

}  // namespace slagflow
