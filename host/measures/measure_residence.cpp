#include "host/measures/measure_residence.hpp"

#include "host/measures/measure_text.hpp"

namespace slagflow {

ResidenceMeasure::ResidenceMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index)
    : Measure(spec.name), index_(index), outlet_(setup.outlets.at(setup.residences.at(index)).name) {}

std::vector<std::string> ResidenceMeasure::columns() const {
  return {"left", "mean_s", "p05_s", "p25_s", "p50_s", "p75_s", "p95_s", "inside_mean_s"};
}

std::vector<double> ResidenceMeasure::update(const MeasureMoment& moment) {
  now_ = moment.totals.residences.at(index_);
  std::vector<double> values{static_cast<double>(now_.left), now_.mean};
  values.insert(values.end(), now_.percentiles.begin(), now_.percentiles.end());
  values.push_back(now_.mean_inside);
  return values;
}

std::vector<double> ResidenceMeasure::state() const {
  std::vector<double> state{static_cast<double>(now_.left), now_.mean, now_.deviation, now_.mean_inside};
  state.insert(state.end(), now_.percentiles.begin(), now_.percentiles.end());
  return state;
}

void ResidenceMeasure::restore(const double* s) {
  now_ = {static_cast<std::int64_t>(s[0]), s[1], s[2], {s[4], s[5], s[6], s[7], s[8]}, s[3]};
}

Json ResidenceMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("outlet", outlet_).set("left", now_.left).set("mean", now_.mean);
  result.set("deviation", now_.deviation);
  Json percentiles = Json::object();
  const char* const names[] = {"5", "25", "50", "75", "95"};
  for (std::size_t k = 0; k < now_.percentiles.size(); ++k) percentiles.set(names[k], now_.percentiles[k]);
  return result.set("percentiles", percentiles).set("mean_inside", now_.mean_inside);
}

std::string ResidenceMeasure::line() const {
  if (now_.left == 0) return "nothing has left through " + outlet_;
  return format("%.0f particles left through ", static_cast<double>(now_.left)) + outlet_ +
         format(" after %.4g s in the mean", now_.mean) + format(" (deviation %.3g s), ", now_.deviation) +
         format("half of them by %.4g s; ", now_.percentiles[2]) +
         format("age of the fluid inside %.4g s", now_.mean_inside);
}

}  // namespace slagflow
