#include "host/measures/measure_heat.hpp"

#include <algorithm>
#include <cmath>

#include "host/measures/measure_text.hpp"

namespace slagflow {

SolidMeasure::SolidMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index)
    : Measure(spec.name),
      index_(index),
      particle_volume_(std::pow(setup.spacing, setup.dimensions)),
      fraction_(spec.solid_fraction),
      flat_(setup.dimensions == 2) {}

std::vector<std::string> SolidMeasure::columns() const { return {flat_ ? "solid_m2" : "solid_m3"}; }

std::vector<double> SolidMeasure::update(const MeasureMoment& moment) {
  volume_ = static_cast<double>(moment.totals.solids.at(index_)) * particle_volume_;
  largest_ = std::max(largest_, volume_);
  return {volume_};
}

Json SolidMeasure::summary() const {
  return Json::object()
      .set("type", type())
      .set("solid_fraction", fraction_)
      .set("volume", volume_)
      .set("largest_volume", largest_);
}

std::string SolidMeasure::line() const {
  return format("%.4g ", volume_) + (flat_ ? "m2" : "m3") + format(" with %.3g of solids or more", fraction_);
}

HeatMeasure::HeatMeasure(const MeasureSpec& spec, const SimulationSetup& setup)
    : Measure(spec.name),
      body_(static_cast<std::size_t>(spec.wall)),
      wall_(setup.bodies.at(body_).name),
      flat_(setup.dimensions == 2) {}

std::vector<std::string> HeatMeasure::columns() const {
  const std::string width = flat_ ? "_m" : "";
  return {"taken_J" + width, "rate_W" + width};
}

std::vector<double> HeatMeasure::update(const MeasureMoment& moment) {
  const double heat = moment.totals.heat.walls.at(body_);
  if (moment.time > time_) rate_ = (heat - heat_) / (moment.time - time_);
  time_ = moment.time, heat_ = heat;
  return {heat_, rate_};
}

Json HeatMeasure::summary() const {
  return Json::object().set("type", type()).set("wall", wall_).set("heat", heat_).set("rate", rate_);
}

std::string HeatMeasure::line() const {
  const std::string width = flat_ ? "/m" : "";
  return "to " + wall_ + format(" %.4g J", heat_) + width + format(", at last %.4g W", rate_) + width;
}

}  // namespace slagflow
