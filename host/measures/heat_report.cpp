#include "host/measures/heat_report.hpp"

#include "host/measures/measure_text.hpp"

namespace slagflow {

HeatReport::HeatReport(const SimulationSetup& setup) : on_(setup.thermal.on) {
  for (std::size_t k = 0; k < setup.bodies.size(); ++k) {
    walls_.push_back(setup.bodies[k].name);
    if (setup.bodies[k].thermal.kind != WallHeat::adiabatic) passing_.push_back(k);
  }
}

std::vector<std::string> HeatReport::columns() const {
  if (!on_) return {};
  std::vector<std::string> names{"heat_content_J", "heat_by_surface_J"};
  for (const std::size_t k : passing_) names.push_back("heat_to_" + walls_[k] + "_J");
  for (const char* name : {"heat_fed_J", "heat_left_J", "heat_by_friction_J", "heat_error_J",
                           "min_temperature_K", "max_temperature_K"})
    names.emplace_back(name);
  return names;
}

std::vector<double> HeatReport::values(const Totals& totals) const {
  if (!on_) return {};
  const HeatBalance& heat = totals.heat;
  std::vector<double> values{heat.content, heat.surface};
  for (const std::size_t k : passing_) values.push_back(heat.walls.at(k));
  values.insert(values.end(), {heat.fed, heat.left, heat.viscous, heat.error(), heat.coolest, heat.hottest});
  return values;
}

std::vector<std::string> HeatReport::lines(const Totals& totals) const {
  if (!on_) return {};
  constexpr double zero_celsius = 273.15;
  const HeatBalance& heat = totals.heat;
  std::string lost = "heat lost: " + format("%.4g J", heat.surface) + " by surfaces";
  for (const std::size_t k : passing_) lost += format(", %.4g J", heat.walls.at(k)) + " to " + walls_[k];
  return {lost, "fluid at " + format("%.1f", heat.coolest - zero_celsius) +
                    format(" to %.1f degrees Celsius", heat.hottest - zero_celsius) +
                    format("; heat balance off by %.2g J", heat.error())};
}

void HeatReport::add_to(Json& summary, const Totals& totals) const {
  if (!on_) return;
  const HeatBalance& heat = totals.heat;
  Json walls = Json::object();
  for (const std::size_t k : passing_) walls.set(walls_[k], heat.walls.at(k));
  Json told = Json::object();
  told.set("start", heat.start).set("content", heat.content).set("by_surface", heat.surface);
  told.set("to_walls", walls).set("fed", heat.fed).set("left", heat.left).set("by_friction", heat.viscous);
  told.set("error", heat.error()).set("min_temperature", heat.coolest);
  summary.set("heat", told.set("max_temperature", heat.hottest));
}

}  // namespace slagflow
