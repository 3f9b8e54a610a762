#include "host/run/check_heat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "heat/heat.hpp"

namespace slagflow {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double zero_celsius = 273.15;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string number(double value) { return std::isnan(value) ? "-" : format("%.3g", value); }

OwnRheology own_of(const FluidSetup& f) { return {static_cast<double>(f.rheology.parameters[0]), 0}; }

double largest_diffusivity(const FluidSetup& f) {
  double most = 0;
  for (const auto& k : f.material.conductivity)
    for (const auto& c : f.material.heat_capacity) most = std::max(most, k[1] / (f.rest_density * c[1]));
  return most;
}

FluidHeat numbers_of(const SimulationSetup& s, const FluidSetup& f, double speed, double depth) {
  const MaterialSetup& m = f.material;
  const double t = s.thermal.reference_temperature, k = value_at(m.conductivity, t);
  FluidHeat heat;
  heat.name = f.name;
  heat.diffusivity = largest_diffusivity(f);
  const double radiant = s.thermal.radiation ? 4 * m.emissivity * stefan_boltzmann * t * t * t : 0;
  heat.half_cell_biot = (s.thermal.surface_heat_transfer + radiant) * s.spacing / (2 * k);
  const double solid = m.solid_fraction.empty() ? t : m.solid_fraction.front()[0];
  heat.stefan = m.latent_heat > 0 ? value_at(m.heat_capacity, t) * (t - solid) / m.latent_heat : unknown;
  constexpr double step = 1;  // [K]
  const double eta = viscosity_at(m, own_of(f), t);
  heat.nahme = eta * speed * speed * std::log(viscosity_at(m, own_of(f), t - step) / eta) / (step * k);
  heat.resolved_from = 1.4 * s.spacing * s.spacing / heat.diffusivity;
  heat.creep = f.rest_density * norm(s.gravity) * depth / m.max_viscosity;
  return heat;
}

double effusivity(double k, double density, double c) { return std::sqrt(k * density * c); }

void add_contacts(const SimulationSetup& s, HeatCheck& check) {
  const double t = s.thermal.reference_temperature;
  for (const WallBody& body : s.bodies) {
    const WallThermal& wall = body.thermal;
    if (wall.kind != WallHeat::semi_infinite) continue;
    for (const FluidSetup& f : s.fluids) {
      const double own = effusivity(value_at(f.material.conductivity, t), f.rest_density,
                                    value_at(f.material.heat_capacity, t));
      const double other = effusivity(wall.conductivity, wall.density, wall.heat_capacity);
      check.contacts.push_back({body.name, f.name, (own * t + other * wall.temperature) / (own + other)});
    }
  }
}

void add_thick_walls(const SimulationSetup& s, const std::vector<ThinnestWall>& walls, HeatCheck& check) {
  const double last = s.end_time - s.start_time;
  for (std::size_t k = 0; k < walls.size() && k < s.bodies.size(); ++k) {
    const WallThermal& wall = s.bodies[k].thermal;
    if (wall.kind != WallHeat::semi_infinite || walls[k].name.empty()) continue;
    const double thickness = walls[k].across * s.spacing;
    const double diffusivity = wall.conductivity / (wall.density * wall.heat_capacity);
    const ThickWallHeat heat{s.bodies[k].name, thickness, thickness * thickness / (4 * diffusivity)};
    check.thick_walls.push_back(heat);
    if (heat.felt < last)
      check.warnings.push_back(format(
          "wall '%s': it is semi_infinite, as if it had no back, which heat would reach: %.3g m of it, "
          "as it is drawn, are felt through from %.3g s on, before the end of the run at %.3g s",
          heat.wall.c_str(), thickness, heat.felt, last));
  }
}

void warn_of_inlets(const SimulationSetup& s, HeatCheck& check) {
  for (const InletSetup& in : s.inlets) {
    const FluidSetup& f = s.fluids[in.fluid];
    if (viscosity_at(f.material, own_of(f), in.temperature) < f.material.max_viscosity * (1 - 1e-6)) continue;
    check.warnings.push_back(
        format("inlet '%s': fluid '%s' is solid at its temperature of %g K: it comes in as a bar",
               in.name.c_str(), f.name.c_str(), in.temperature));
  }
}

void warn_of_flow(const SimulationSetup& s, HeatCheck& check) {
  const double until = s.thermal.flow_until;
  if (std::isfinite(until) && until >= s.end_time)
    check.warnings.push_back(
        format("thermal.flow_until = %g s is not before the run's end at %g s: the flow goes on "
               "to the end",
               until, s.end_time));
}

bool passes_heat(const SimulationSetup& s) {
  return std::any_of(s.bodies.begin(), s.bodies.end(),
                     [](const WallBody& b) { return b.thermal.kind != WallHeat::adiabatic; });
}

void warn_of(const SimulationSetup& s, const FluidHeat& heat, HeatCheck& check) {
  const double end = s.end_time - s.start_time;
  if (passes_heat(s) && end > 0 && heat.resolved_from > end)
    check.warnings.push_back(
        format("fluid '%s': heat to walls is right within 5 %% only from 1.4 spacing^2/alpha = %.3g s on, "
               "after the end "
               "of the run: a spacing of %.2g m would resolve it from a tenth of the run on",
               heat.name.c_str(), heat.resolved_from, std::sqrt(0.1 * end * heat.diffusivity / 1.4)));
  if (heat.half_cell_biot > 1)
    check.warnings.push_back(
        format("fluid '%s': half a spacing conducts less than its surface loses (Biot %.2g): the surface's "
               "temperature is not resolved; a spacing below %.2g m would do",
               heat.name.c_str(), heat.half_cell_biot, s.spacing / heat.half_cell_biot));
}

}  // namespace

HeatCheck check_heat(const BuiltCase& built, double speed, double depth,
                     const std::vector<ThinnestWall>& walls) {
  const SimulationSetup& s = built.setup;
  HeatCheck check;
  check.on = s.thermal.on;
  if (!check.on) return check;
  check.time_step = conduction_time_step(s), check.flow_until = s.thermal.flow_until;
  for (const FluidSetup& f : s.fluids) {
    check.fluids.push_back(numbers_of(s, f, speed, depth));
    warn_of(s, check.fluids.back(), check);
  }
  add_contacts(s, check), add_thick_walls(s, walls, check), warn_of_inlets(s, check), warn_of_flow(s, check);
  return check;
}

std::string to_text(const HeatCheck& check) {
  if (!check.on) return "";
  std::string text = format("heat             conduction is stable up to steps of %.3g s\n", check.time_step);
  if (std::isfinite(check.flow_until))
    text += format(
        "                 such steps, or max_time_step, are taken from %.6g s on, when nothing moves any "
        "more\n",
        check.flow_until);
  for (const FluidHeat& f : check.fluids) {
    text += format("heat of %-8s alpha %.3g m^2/s, Biot of half a spacing %s, Stefan %s, Nahme %s\n",
                   f.name.c_str(), f.diffusivity, number(f.half_cell_biot).c_str(), number(f.stefan).c_str(),
                   number(f.nahme).c_str());
    text += format(
        "                 heat to walls is right within 5 %% from %.3g s on (1.4 spacing^2/alpha); "
        "a crust creeps at up to %.2g 1/s\n",
        f.resolved_from, f.creep);
  }
  for (const WallContactHeat& c : check.contacts)
    text += format("                 '%s' touches '%s' at %.0f K (%.0f degrees Celsius) in perfect contact\n",
                   c.fluid.c_str(), c.wall.c_str(), c.temperature, c.temperature - zero_celsius);
  for (const ThickWallHeat& w : check.thick_walls)
    text += format("                 '%s', %.3g m thick, is felt through after %.3g s\n", w.wall.c_str(),
                   w.thickness, w.felt);
  return text;
}

Json to_json(const HeatCheck& check) {
  Json fluids = Json::object(), contacts = Json::object(), felt = Json::object();
  for (const FluidHeat& f : check.fluids)
    fluids.set(f.name, Json::object()
                           .set("diffusivity", f.diffusivity)
                           .set("half_cell_biot", f.half_cell_biot)
                           .set("stefan", f.stefan)
                           .set("nahme", f.nahme)
                           .set("resolved_from", f.resolved_from)
                           .set("creep_rate", f.creep));
  for (const WallContactHeat& c : check.contacts) contacts.set(c.wall + "/" + c.fluid, c.temperature);
  for (const ThickWallHeat& w : check.thick_walls) felt.set(w.wall, w.felt);
  return Json::object()
      .set("time_step", check.time_step)
      .set("fluids", fluids)
      .set("contacts", contacts)
      .set("walls_felt_through", felt);
}

}  // namespace slagflow
