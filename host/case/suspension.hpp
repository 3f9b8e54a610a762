// A fluid given as a liquid with solid particles in it. Used by the parser alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fluid/models.hpp"
#include "fluid/rheology/suspension.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {

struct SuspensionSpec {
  Suspension law;
  double solid_fraction = 0;    // phi, of the volume
  double liquid_density = 0;    // [kg/m^3]
  double solid_density = 0;     // [kg/m^3]
  double liquid_viscosity = 0;  // [Pa s]
  bool complete = false;        // no key missing or faulty

  double density() const { return (1 - solid_fraction) * liquid_density + solid_fraction * solid_density; }
  double viscosity() const { return liquid_viscosity * relative_viscosity(law, solid_fraction); }
};

// The numbers a case file may give for a parameter.
Range range_of(const ParameterInfo& parameter);

// The solid fractions for which the law holds.
Range fractions(const Suspension& law);

// A yield stress over the solid fraction: linear between rows [phi, tau], 0 below the first.
using YieldRows = std::vector<std::array<double, 2>>;
inline constexpr const char* yield_rows_allowed =
    "in a suspension rows [solid fraction from 0 to below 1, yield stress >= 0 in Pa], the fraction "
    "increasing";

// What is wrong with the rows, and what is allowed; empty: nothing.
std::string fault_of(const YieldRows& rows, const SuspensionSpec& suspension);
std::string fault_of(const YieldRows& rows);
// The solid fraction from which on nothing flows.
double most_fraction(const Suspension&);
double yield_stress_at(double solid_fraction, const YieldRows& rows);

}  // namespace slagflow
