// The quantities of a viscometer's file, the units they may have, and what values are believable.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace slagflow {

struct UnitInfo {
  const char* name;
  double factor;               // to the SI unit
  const char* spellings = "";  // further ones, as plain_unit gives them, a blank between
  double offset = 0;           // [SI unit] of its zero: SI value = factor * value + offset
};

enum class Quantity {
  shear_rate,
  shear_stress,
  viscosity,
  rotation,
  torque,
  temperature,
  bob_radius,
  cup_radius,
  height,
  full_scale_torque,
  density
};

struct QuantityInfo {
  Quantity quantity;
  const char* name;
  std::vector<UnitInfo> units;  // the SI unit first
  double least, most;           // [SI unit] believable values: least < value <= most
};

inline constexpr const char* percent_unit = "percent";

// In the order of Quantity.
const std::vector<QuantityInfo>& quantities();
inline const QuantityInfo& info(Quantity q) { return quantities()[static_cast<std::size_t>(q)]; }

// Columns have these, the others are facts of the whole file.
inline bool is_measured(Quantity q) { return q <= Quantity::temperature; }

// A unit's text in one of its many forms: without brackets, blanks and signs of products and powers, u for
// micro. `[mPa·s]` gives mPas, `s^-1` and `s⁻¹` give s-1.
std::string plain_unit(const std::string& text);

// The unit of a quantity, or nothing. Letters may be of the other case where that is no other unit: mpa.s is
// mPa s, but MPA.S may be mPa s or MPa s and is nothing.
const UnitInfo* find_unit(Quantity q, const std::string& text);

// A unit of any quantity, of those not in the table too, such as temperature and time.
bool is_unit(const std::string& text);

// What a name like `shear_stress_Pa`, `Shear Stress [Pa]` or `Tau in Pa` says.
struct NamedQuantity {
  bool known = false;       // the quantity is
  bool unit_known = false;  // and the unit is
  bool percent = false;     // torque in per cent of full scale
  bool weak = false;        // a short name such as n or M that means this with a fitting unit alone
  bool angular = false;     // a rotation named as an angle: its 1/s would be rad/s
  Quantity quantity{};
  double factor = 1, offset = 0;
  std::string unit;  // as the table of units names it

  double si(double value) const { return factor * value + offset; }
};
NamedQuantity parse_name(const std::string& text);

// The same with a unit from elsewhere, as from a row below the names.
NamedQuantity with_unit(NamedQuantity named, const std::string& unit);

// "shear_stress_Pa, shear_stress_mPa, shear_stress_kPa"
std::string names_of(Quantity q);

}  // namespace slagflow
