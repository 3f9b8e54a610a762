// Keys of heat that belong to other tables.
#pragma once

#include "host/case/case_keys.hpp"

namespace slagflow {

// A temperature [K]; one that is likely degrees Celsius is refused.
bool describe_temperature(CaseVisitor&, const Key&, double& value);
// The same of fluid that comes in or starts, where heat is on; else refused.
void describe_start_temperature(CaseVisitor&, const Case&, const Key&, double& value);

void describe_thermal(CaseVisitor&, Case&);  // [thermal]
// Once all is read: the hottest temperature, and what it makes of the rheologies.
void resolve_thermal(Case&);
// What concerns heat and other tables.
void check_thermal(const Case&, CaseProblems&);

void describe_material(CaseVisitor&, MaterialSetup&);  // inside of [fluid.NAME]
void describe_wall_heat(CaseVisitor&, const Case&, WallSpec&);
bool has_liquid_viscosity(const CaseVisitor&, const MaterialSetup&);

// The law of the relative viscosity of a suspension; its constants where it is known or `asked` for.
bool describe_suspension_law(CaseVisitor&, Suspension&, bool needed);

}  // namespace slagflow
