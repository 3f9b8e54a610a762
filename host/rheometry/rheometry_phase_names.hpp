// The names that columns have in tables of thermodynamics software: FactSage's `T(C)`, `g_ASlag-liq#1`,
// Thermo-Calc's `Mass fraction of all solid phases`, and what people make of them.
#pragma once

#include <string>

namespace slagflow {

enum class PhaseRole {
  none,
  temperature,
  solid_fraction,  // of all solids together
  liquid_fraction,
  solid,  // amount of one phase
  liquid,
  gas,
  enthalpy,
  heat_capacity
};

struct PhaseColumn {
  std::string name;
  PhaseRole role = PhaseRole::none;
  bool unit_known = true;
  bool percent = false;
  bool per_mass = false;  // of an enthalpy or a heat capacity: of a kilogram, else of the whole system
  bool bare = false;      // nothing but its name says that it is a phase
  std::string unit;
  double factor = 1, offset = 0;  // to K, kg, J or J/kg and what has K in it

  bool is_amount() const {
    return role == PhaseRole::solid || role == PhaseRole::liquid || role == PhaseRole::gas;
  }
  bool is_fraction() const { return role == PhaseRole::solid_fraction || role == PhaseRole::liquid_fraction; }
};

PhaseColumn parse_phase_column(const std::string& name);

}  // namespace slagflow
