#include "host/measures/measure_volume.hpp"

#include <algorithm>

#include "host/measures/measure_text.hpp"

namespace slagflow {
namespace {

std::string unit(int dimensions) { return dimensions == 2 ? "m2" : "m3"; }

}  // namespace

std::vector<std::string> FlowMeasure::columns() const {
  const std::string m = unit(geometry_.dimensions);
  return {"passed_" + m, "behind_" + m, "flow_" + m + "_s"};
}

std::vector<double> FlowMeasure::update(const MeasureMoment& moment) {
  const PlaneState& state = moment.totals.planes.at(geometry_.index);
  if (moment.time > time_) rate_ = volume_of(state.passed - now_.passed) / (moment.time - time_);
  time_ = moment.time;
  now_ = state;
  return {volume_of(now_.passed), geometry_.periodic ? unknown : volume_of(now_.behind), rate_};
}

std::vector<double> FlowMeasure::state() const {
  std::vector<double> state{time_, rate_};
  for (const std::int64_t n : {now_.passed, now_.behind, now_.lost_behind, now_.start_behind})
    state.push_back(static_cast<double>(n));
  return state;
}

void FlowMeasure::restore(const double* state) {
  time_ = state[0], rate_ = state[1];
  const auto whole = [&](int k) { return static_cast<std::int64_t>(state[k]); };
  now_ = {whole(2), whole(3), whole(4), whole(5)};
}

Json FlowMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("direction", direction_name(geometry_.plane));
  result.set("position", geometry_.plane.position).set("passed_volume", volume_of(now_.passed));
  if (!geometry_.periodic) {
    result.set("behind_volume", volume_of(now_.behind));
    result.set("lost_behind_volume", volume_of(now_.lost_behind));
    result.set("balance_error", volume_of(now_.passed + now_.behind + now_.lost_behind - now_.start_behind));
  }
  return result.set("flow_rate", rate_);
}

std::string FlowMeasure::line() const {
  const std::string m = unit(geometry_.dimensions);
  return "passed " + format("%.4g ", volume_of(now_.passed)) + m + ", at last " + format("%.3g ", rate_) + m +
         "/s";
}

VolumeMeasure::VolumeMeasure(const MeasureSpec& spec, std::size_t index, double particle_volume,
                             int dimensions)
    : Measure(spec.name), index_(index), particle_volume_(particle_volume), dimensions_(dimensions) {}

std::vector<std::string> VolumeMeasure::columns() const { return {unit(dimensions_)}; }

std::vector<double> VolumeMeasure::update(const MeasureMoment& moment) {
  volume_ = static_cast<double>(moment.totals.boxes.at(index_)) * particle_volume_;
  largest_ = std::max(largest_, volume_);
  return {volume_};
}

Json VolumeMeasure::summary() const {
  return Json::object().set("type", type()).set("volume", volume_).set("largest_volume", largest_);
}

std::string VolumeMeasure::line() const { return format("%.4g ", volume_) + unit(dimensions_); }

}  // namespace slagflow
