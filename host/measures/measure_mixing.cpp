#include "host/measures/measure_mixing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "host/measures/measure_text.hpp"

namespace slagflow {

Mixing mixing_of(const std::vector<std::array<double, 2>>& cells, double full) {
  constexpr double enough = 0.25;
  double all = 0, own = 0, squares = 0, used = 0;
  for (const auto& [of_fluid, of_all] : cells) {
    if (of_all < std::max(enough * full, 1.0)) continue;
    own += of_fluid, all += of_all, squares += of_fluid * of_fluid / of_all, ++used;
  }
  if (all == 0) return {};
  const double p = own / all, apart = p * (1 - p), variance = squares / all - p * p;
  const double random = apart * used / all;
  if (!(apart > 0 && random < apart)) return {unknown, p};
  return {std::clamp((apart - variance) / (apart - random), 0.0, 1.0), p};
}

MixingMeasure::MixingMeasure(const MeasureSpec& spec, const SimulationSetup& setup)
    : Measure(spec.name),
      lower_(spec.min),
      upper_(spec.max),
      cell_(spec.cell > 0 ? spec.cell : 5 * setup.spacing),
      full_(std::pow(cell_ / setup.spacing, setup.dimensions)),
      kind_(static_cast<std::uint8_t>(spec.fluid)),
      fluid_(setup.fluids.at(kind_).name) {}

std::vector<double> MixingMeasure::update(const MeasureMoment& moment) {
  const FluidSnapshot& s = moment.read();
  std::map<std::array<std::int64_t, 3>, std::array<double, 2>> cells;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    std::array<std::int64_t, 3> cell{};
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      inside = inside && s.position[i][k] >= lower_[k] && s.position[i][k] < upper_[k];
      cell[static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(std::floor((s.position[i][k] - lower_[k]) / cell_));
    }
    if (!inside) continue;
    std::array<double, 2>& counts = cells[cell];
    counts[0] += s.fluid[i] == kind_ ? 1 : 0, counts[1] += 1;
  }
  std::vector<std::array<double, 2>> all;
  for (const auto& [cell, counts] : cells) all.push_back(counts);
  now_ = mixing_of(all, full_);
  return {now_.index, now_.share};
}

Json MixingMeasure::summary() const {
  return Json::object()
      .set("type", type())
      .set("fluid", fluid_)
      .set("index", now_.index)
      .set("share", now_.share);
}

std::string MixingMeasure::line() const {
  if (std::isnan(now_.share)) return format("no cell of %.3g m in its box is a quarter full", cell_);
  if (std::isnan(now_.index)) return format("nothing that mixes: %.3g %% is ", 100 * now_.share) + fluid_;
  return format("index %.3g of ", now_.index) + fluid_ +
         format(", %.3g %% of the fluid in its box", 100 * now_.share);
}

}  // namespace slagflow
