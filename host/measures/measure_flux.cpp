#include "host/measures/measure_flux.hpp"

#include <cmath>

#include "host/measures/measure_text.hpp"

namespace slagflow {

FluxMeasure::FluxMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index)
    : Measure(spec.name),
      index_(index),
      particle_volume_(std::pow(setup.spacing, setup.dimensions)),
      unit_(setup.dimensions == 2 ? "m2" : "m3") {
  for (const FluidSetup& fluid : setup.fluids)
    fluids_.push_back(fluid.name), density_.push_back(fluid.rest_density);
  now_.forward.resize(fluids_.size()), now_.backward.resize(fluids_.size());
}

FluxMeasure::Passed FluxMeasure::passed(const std::vector<std::int64_t>& counts) const {
  Passed all;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double volume = static_cast<double>(counts[k]) * particle_volume_;
    all.volume += volume, all.mass += density_[k] * volume;
  }
  return all;
}

// Of each fluid too where there are more than one.
std::vector<std::string> FluxMeasure::columns() const {
  const std::string kg = unit_ == "m2" ? "_kg_m" : "_kg";
  std::vector<std::string> names{"forward_" + unit_, "backward_" + unit_, "flow_" + unit_ + "_s",
                                 "forward" + kg, "backward" + kg};
  if (fluids_.size() > 1)
    for (const std::string& fluid : fluids_)
      for (const char* way : {"_forward_", "_backward_"}) names.push_back(fluid + way + unit_);
  return names;
}

std::vector<double> FluxMeasure::update(const MeasureMoment& moment) {
  const double before = passed(now_.forward).volume - passed(now_.backward).volume;
  now_ = moment.totals.fluxes.at(index_);
  const Passed forward = passed(now_.forward), backward = passed(now_.backward);
  if (moment.time > time_) flow_ = (forward.volume - backward.volume - before) / (moment.time - time_);
  time_ = moment.time;
  std::vector<double> values{forward.volume, backward.volume, flow_, forward.mass, backward.mass};
  if (fluids_.size() > 1)
    for (std::size_t k = 0; k < fluids_.size(); ++k)
      for (const std::int64_t n : {now_.forward[k], now_.backward[k]})
        values.push_back(static_cast<double>(n) * particle_volume_);
  return values;
}

std::vector<double> FluxMeasure::state() const {
  std::vector<double> state{time_, flow_};
  for (const auto* counts : {&now_.forward, &now_.backward})
    for (const std::int64_t n : *counts) state.push_back(static_cast<double>(n));
  return state;
}

void FluxMeasure::restore(const double* state) {
  time_ = state[0], flow_ = state[1];
  const double* next = state + 2;
  for (auto* counts : {&now_.forward, &now_.backward})
    for (std::int64_t& n : *counts) n = static_cast<std::int64_t>(*next++);
}

Json FluxMeasure::summary() const {
  const Passed forward = passed(now_.forward), backward = passed(now_.backward);
  Json result = Json::object();
  result.set("type", type()).set("forward_volume", forward.volume).set("backward_volume", backward.volume);
  result.set("forward_mass", forward.mass).set("backward_mass", backward.mass).set("flow_rate", flow_);
  Json fluids = Json::object();
  for (std::size_t k = 0; k < fluids_.size(); ++k)
    fluids.set(
        fluids_[k],
        Json::object().set("forward_particles", now_.forward[k]).set("backward_particles", now_.backward[k]));
  return result.set("fluids", fluids);
}

std::string FluxMeasure::line() const {
  const Passed forward = passed(now_.forward), backward = passed(now_.backward);
  return "forward " + format("%.4g ", forward.volume) + unit_ + format(", %.4g kg", forward.mass) +
         (unit_ == "m2" ? "/m" : "") + "; backward " + format("%.4g ", backward.volume) + unit_ +
         format("; at last %.3g ", flow_) + unit_ + "/s";
}

}  // namespace slagflow
