// A fluid given as a liquid with solid particles in it. Used by the parser alone.
#pragma once

#include "fluid/rheology/suspension.hpp"
#include "host/case/case.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {

struct SuspensionSpec {
  Suspension law;
  double solid_fraction = 0;    // phi, of the volume
  double liquid_density = 0;    // [kg/m^3]
  double solid_density = 0;     // [kg/m^3]
  double liquid_viscosity = 0;  // [Pa s]
  bool complete = false;        // no key missing or faulty
};

// The numbers a case file may give for a parameter.
Range range_of(const ParameterInfo& parameter);

// Whether a table of a fluid describes a suspension: it has any key that only a suspension has.
bool is_suspension(const CaseTable& fluid);

// Reads the keys that describe the suspension, and sets the density of the mixture.
SuspensionSpec read_suspension(CaseTable& t, FluidSpec& fluid);

// The parameter that the solids raise: that of the liquid times the relative viscosity.
void read_raised(CaseTable& t, const SuspensionSpec& suspension, const ParameterInfo& parameter,
                 double& value);

// A yield stress as a number, or as a table [[phi, tau], ...]: linear between its rows, 0 below the first.
void read_yield_stress(CaseTable& t, const SuspensionSpec& suspension, const ParameterInfo& parameter,
                       double& value);

}  // namespace slagflow
