// What heat makes of a case once it is read, and what it does not go with.
#include <algorithm>
#include <cmath>

#include "fluid/melt.hpp"
#include "heat/material_table.hpp"
#include "host/case/keys_thermal.hpp"
#include "host/case/suspension.hpp"

namespace slagflow {
namespace {

bool complete(const MaterialSetup& m) { return !m.heat_capacity.empty() && !m.conductivity.empty(); }

// Where all of it is solid, the liquid's viscosity does not matter.
bool solid_at(const MaterialSetup& m, double temperature) {
  return solid_fraction_at(m, temperature) >= (m.suspended ? most_fraction(m.suspension) : 1);
}

std::string unit_of_a(const LiquidViscosity& liquid) {
  const LiquidLawInfo& law = liquid_laws[static_cast<std::size_t>(liquid.law)];
  return *law.unit_of_a ? std::string(" (") + law.name + " has A in " + law.unit_of_a + ")" : "";
}

// Between its solidus and the hottest fluid the liquid is less viscous than what counts as solid.
void check_viscosity(const Case& c, const FluidSpec& fluid, CaseProblems& problems) {
  constexpr double least = 1e-6;  // [Pa s]
  const MaterialSetup& m = fluid.material;
  const std::string key =
      "fluid." + fluid.name +
      (m.liquid.a > 0 || !m.liquid.rows.empty() ? ".liquid_viscosity"
                                                : std::string(".") + fluid.info().parameters[0].key);
  if (!problems.fine_within("fluid." + fluid.name)) return;
  const double hot = c.thermal.reference_temperature;
  const double cold = m.solid_fraction.empty() ? hot : m.solid_fraction.front()[0];
  if (m.liquid.law == LiquidLaw::vft && m.liquid.t0 >= cold)
    return problems.add(key, "T0 = " + show(m.liquid.t0) +
                                 " is not below all temperatures of the liquid: allowed: < " + show(cold) +
                                 " [K]");
  if (solid_at(m, hot)) return;
  const double own = fluid.parameters[0];
  const bool given = m.liquid.a > 0 || !m.liquid.rows.empty();
  const double eta = given ? std::exp(log_liquid_viscosity(m.liquid, hot)) : own;
  if (!(eta >= least && eta <= m.max_viscosity))
    problems.add(key, "gives " + show(eta) + " Pa s at " + show(hot) + " K" + unit_of_a(m.liquid) +
                          ": allowed: " + show(least) + " to max_viscosity, from which on it is solid, " +
                          show(m.max_viscosity) + " [Pa s]");
}

void check_numerics(const Case& c, CaseProblems& problems) {
  const NumericsSetup& n = c.numerics;
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
    if (m.liquid.a > 0 || !m.liquid.rows.empty())
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
