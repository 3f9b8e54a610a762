// What heat makes of a case once it is read, and what it does not go with.
#include <algorithm>
#include <cmath>

#include "fluid/melt.hpp"
#include "heat/material_table.hpp"
#include "host/case/keys_thermal.hpp"

namespace slagflow {
namespace {

bool complete(const MaterialSetup& m) { return !m.heat_capacity.empty() && !m.conductivity.empty(); }

// The liquid is as viscous as that between its solidus and the hottest fluid.
void check_viscosity(const Case& c, const FluidSpec& fluid, CaseProblems& problems) {
  constexpr double least = 1e-6;  // [Pa s]
  const double most = fluid.material.max_viscosity;  // at the hottest, or all of it would be solid
  const LiquidViscosity& liquid = fluid.material.liquid;
  const std::string key = "fluid." + fluid.name + ".liquid_viscosity";
  if (liquid.law == LiquidLaw::constant || !problems.fine_within("fluid." + fluid.name)) return;
  const double hot = c.thermal.reference_temperature;
  const double cold = fluid.material.solid_fraction.empty() ? hot : fluid.material.solid_fraction.front()[0];
  if (liquid.law == LiquidLaw::vft && liquid.t0 >= std::min(cold, hot))
    return problems.add(key, "T0 = " + show(liquid.t0) +
                                 " is not below all temperatures of the liquid: allowed: < " +
                                 show(std::min(cold, hot)) + " [K]");
  for (const double t : {cold, hot}) {
    const double eta = std::exp(log_liquid_viscosity(liquid, t));
    if (!(eta >= least && (eta <= most || t < hot)))
      return problems.add(key, "gives " + show(eta) + " Pa s at " + show(t) + " K (" +
                                   liquid_laws[static_cast<std::size_t>(liquid.law)].name + " has A in " +
                                   liquid_laws[static_cast<std::size_t>(liquid.law)].unit_of_a +
                                   "): allowed: " + show(least) + " to " + show(most) + " [Pa s]");
  }
}

void check_numerics(const Case& c, CaseProblems& problems) {
  const NumericsSetup& n = c.numerics;
  if (n.yield == YieldModel::exact)
    problems.add("numerics.yield", "value \"exact\" with [thermal]: allowed: \"regularised\"");
  if (n.viscous_step == ViscousStepping::explicit_step)
    problems.add(
        "numerics.viscous_step",
        "value \"explicit\" with [thermal]: what freezes asks for steps of 1e-10 s: allowed: \"implicit\"");
  if (n.theta != 1)
    problems.add(
        "numerics.theta",
        "value " + show(n.theta) + " with [thermal]: what freezes would ring: allowed: 1, backward Euler");
}

void check_walls(const Case& c, CaseProblems& problems) {
  for (std::size_t k = 0; k < c.walls.size(); ++k) {
    const WallSpec& wall = c.walls[k];
    if (wall.thermal.kind == WallHeat::semi_infinite && !wall.surface.zero())
      problems.add(
          "wall." + std::to_string(k) + ".thermal",
          "value \"semi_infinite\" with a surface_velocity: the heat would stay while the wall goes on: "
          "allowed: \"temperature\", or a motion of the wall itself");
  }
}

}  // namespace

void resolve_thermal(Case& c) {
  ThermalSetup& t = c.thermal;
  if (!t.on) return;
  for (const RegionSpec& region : c.regions)
    t.reference_temperature = std::max(t.reference_temperature, region.temperature);
  for (const InletSpec& inlet : c.inlets)
    t.reference_temperature = std::max(t.reference_temperature, inlet.temperature);
  for (FluidSpec& fluid : c.fluids) {
    const MaterialSetup& m = fluid.material;
    if (!complete(m) || !(t.reference_temperature > 0)) continue;
    const double own = fluid.parameters[0];
    if (own > 0 || m.liquid.a > 0 || !m.liquid.rows.empty())
      fluid.parameters[0] = viscosity_at(m, {own, 0}, t.reference_temperature);
    const int yield = yield_stress_parameter(fluid.rheology);
    if (yield < 0 || m.yield_stress.empty()) continue;
    const double phi = solid_fraction_at(m, t.reference_temperature);
    fluid.parameters[static_cast<std::size_t>(yield)] =
        phi < m.yield_stress.front()[0] ? 0 : value_at(m.yield_stress, phi);
  }
}

void check_thermal(const Case& c, CaseProblems& problems) {
  if (!c.thermal.on) return;
  for (const FluidSpec& fluid : c.fluids) check_viscosity(c, fluid, problems);
  check_numerics(c, problems), check_walls(c, problems);
}

}  // namespace slagflow
