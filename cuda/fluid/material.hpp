// What a fluid is made of as far as heat goes, in plain host data: its caloric properties, and how
// temperature and the solids that it brings out change its viscosity and yield stress.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fluid/liquid_viscosity/arrhenius.hpp"
#include "fluid/liquid_viscosity/vft.hpp"
#include "fluid/liquid_viscosity/viscosity_rows.hpp"
#include "fluid/liquid_viscosity/weymann.hpp"
#include "fluid/rheology/suspension.hpp"

namespace slagflow {

// Rows of an abscissa, ascending, and a value; linear between them, constant beyond. One row: the same
// everywhere.
using ValueRows = std::vector<std::array<double, 2>>;

// How the viscosity of the liquid depends on temperature. constant: not at all. A new law is a header in
// liquid_viscosity/, an entry here and a case in log_liquid_viscosity().
enum class LiquidLaw : int { constant, arrhenius, weymann, vft, table };

struct LiquidLawInfo {
  const char* name;  // in the case file
  const char* formula;
  const char* unit_of_a;  // empty: the law has no constants
  bool has_t0;
};
inline constexpr std::array<LiquidLawInfo, 5> liquid_laws{{
    {"constant", "the same at all temperatures", "", false},
    {"arrhenius", "A exp(B/T)", "Pa s", false},
    {"weymann", "A T exp(B/T)", "Pa s/K", false},
    {"vft", "A exp(B/(T - T0))", "Pa s", true},
    {"table", "rows; ln eta linear in 1/T", "", false},
}};

struct LiquidViscosity {
  LiquidLaw law = LiquidLaw::constant;
  double a = 0;    // A, in its law's unit; of a constant the viscosity [Pa s]
  double b = 0;    // B [K]
  double t0 = 0;   // T_0 [K]
  ValueRows rows;  // [K], [Pa s]
};

// Natural logarithm of the viscosity [Pa s] at a temperature [K].
inline double log_liquid_viscosity(const LiquidViscosity& liquid, double temperature) {
  const double log_a = std::log(liquid.a);
  switch (liquid.law) {
    case LiquidLaw::arrhenius:
      return log_arrhenius(log_a, liquid.b, temperature);
    case LiquidLaw::weymann:
      return log_weymann(log_a, liquid.b, temperature);
    case LiquidLaw::vft:
      return log_vft(log_a, liquid.b, liquid.t0, temperature);
    case LiquidLaw::table:
      return log_viscosity_rows(liquid.rows, temperature);
    default:
      return log_a;
  }
}

struct MaterialSetup {
  ValueRows heat_capacity;  // [K], [J/(kg K)], without latent heat
  ValueRows conductivity;   // [K], [W/(m K)]
  ValueRows
      solid_fraction;      // [K], 1 falling to 0; two rows at one temperature: it freezes there. Empty: never
  double latent_heat = 0;  // [J/kg]
  double emissivity = 0;
  LiquidViscosity liquid;  // in place of the rheology's own viscosity
  bool suspended = false;  // whether `suspension` raises it
  Suspension suspension;
  ValueRows yield_stress;      // [solid fraction], [Pa], in place of the rheology's own; may be empty
  double max_viscosity = 1e6;  // [Pa s] eta_max: of solid fluid, and the most of any
};

}  // namespace slagflow
