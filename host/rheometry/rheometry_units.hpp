// The quantities of a viscometer's file, the units they may have, and what values are believable.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace slagflow {

struct UnitInfo {
  const char* name;
  double factor;  // to the SI unit
};

struct QuantityInfo {
  const char* name;
  std::vector<UnitInfo> units;  // the SI unit first
  double least, most;           // [SI unit] believable values: least < value <= most
};

enum class Quantity {
  shear_rate,
  shear_stress,
  rotation,
  torque,
  bob_radius,
  cup_radius,
  height,
  full_scale_torque,
  density
};

// In the order of Quantity.
const std::vector<QuantityInfo>& quantities();
inline const QuantityInfo& info(Quantity q) { return quantities()[static_cast<std::size_t>(q)]; }

// What a name like `shear_stress_Pa` says.
struct NamedQuantity {
  bool known = false;       // the quantity is
  bool unit_known = false;  // and the unit is
  bool percent = false;     // torque in per cent of full scale
  Quantity quantity{};
  double factor = 1;
};
NamedQuantity parse_name(const std::string& name);

// "shear_stress_Pa, shear_stress_mPa, shear_stress_kPa"
std::string names_of(Quantity q);

}  // namespace slagflow
