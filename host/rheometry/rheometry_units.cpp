#include "host/rheometry/rheometry_units.hpp"

#include <algorithm>

#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

constexpr double turn = 6.283185307179586;  // [rad]

using Units = std::vector<UnitInfo>;

Units shear_rate_units() {
  return {{"1/s", 1, "s-1 /s 1/sec sec-1 /sec 1/second reciprocalseconds persecond pers"},
          {"1/min", 1.0 / 60, "min-1 /min"},
          {"1/ms", 1e3, "ms-1"}};
}

Units shear_stress_units() {
  return {{"Pa", 1, "N/m2 Nm-2 Pascal"},
          {"mPa", 1e-3, "mN/m2"},
          {"kPa", 1e3, "kN/m2"},
          {"MPa", 1e6, "N/mm2"},
          {"hPa", 1e2},
          {"uPa", 1e-6},
          {"dyn/cm2", 0.1, "dyne/cm2 dynes/cm2 D/cm2 dyncm-2 dynecm-2 dyn/sqcm"},
          {"lbf/100ft2", 0.47880259, "lb/100ft2 lbs/100ft2"}};
}

Units viscosity_units() {
  return {{"Pas", 1, "Pasec Ns/m2 Nsm-2 kg/(ms) Pascalsecond Pascalseconds"},
          {"mPas", 1e-3, "mPasec mNs/m2"},
          {"uPas", 1e-6},
          {"kPas", 1e3},
          {"MPas", 1e6},
          {"dPas", 0.1},
          {"cP", 1e-3, "cps cPoise centipoise"},
          {"P", 0.1, "poise g/(cms)"}};
}

Units rotation_units() {
  return {{"rad/s", 1, "rad/sec rads-1"},
          {"rpm", turn / 60, "1/min min-1 /min r/min rev/min revs/min U/min Upm tr/min revolutionsperminute"},
          {"1/s", turn, "s-1 /s rps rev/s U/s Hz 1/sec"},
          {"deg/s", turn / 360, "degrees/s"}};
}

Units torque_units() {
  return {{"Nm", 1, "newtonmeter newtonmetre"}, {"mNm", 1e-3}, {"uNm", 1e-6}, {"nNm", 1e-9}, {"Ncm", 1e-2},
          {"dyncm", 1e-7, "dynecm dynescm"}};
}

Units torque_units_and_percent() {
  Units units = torque_units();
  units.push_back({percent_unit, 0.01, "% pct %FS %FSR"});
  return units;
}

Units temperature_units() {
  constexpr double ice = 273.15, fahrenheit = 5.0 / 9;
  return {{"K", 1, "kelvin Kelvins degK"},
          {"C", 1, "degC °C ºC ˚C ℃ celsius degreesC degreescelsius GradC", ice},
          {"F", fahrenheit, "degF °F ºF ℉ fahrenheit degreesF", ice - 32 * fahrenheit}};
}

Units length_units() { return {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}}; }

Units density_units() {
  return {{"kg/m3", 1, "kgm-3 g/l g/dm3"}, {"g/cm3", 1e3, "gcm-3 g/ml g/cc kg/l kg/dm3 t/m3 Mg/m3"}};
}

std::vector<QuantityInfo> all_quantities() {
  return {{Quantity::shear_rate, "shear_rate", shear_rate_units(), 0, 1e7},
          {Quantity::shear_stress, "shear_stress", shear_stress_units(), 0, 1e6},
          {Quantity::viscosity, "viscosity", viscosity_units(), 0, 1e9},
          {Quantity::rotation, "rotation", rotation_units(), 0, 1e4},
          {Quantity::torque, "torque", torque_units_and_percent(), 0, 1e3},
          {Quantity::temperature, "temperature", temperature_units(), 200, 4000},
          {Quantity::bob_radius, "bob_radius", length_units(), 0, 0.5},
          {Quantity::cup_radius, "cup_radius", length_units(), 0, 1},
          {Quantity::height, "height", length_units(), 0, 1},
          {Quantity::full_scale_torque, "full_scale_torque", torque_units(), 0, 1e3},
          {Quantity::density, "density", density_units(), 50, 25000}};
}

bool spells(const UnitInfo& unit, const std::string& plain, bool any_case) {
  const std::string all = " " + std::string(unit.name) + " " + unit.spellings + " ",
                    wanted = " " + plain + " ";
  return any_case ? lower_case(all).find(lower_case(wanted)) != std::string::npos
                  : all.find(wanted) != std::string::npos;
}

std::string without_brackets(const std::string& text) {
  if (text.size() < 2) return text;
  const std::string pair{text.front(), text.back()};
  const bool wrapped = pair == "[]" || pair == "()" || pair == "{}" || pair == "<>";
  return wrapped ? trimmed(text.substr(1, text.size() - 2)) : text;
}

}  // namespace

const std::vector<QuantityInfo>& quantities() {
  static const std::vector<QuantityInfo> all = all_quantities();
  return all;
}

std::string plain_unit(const std::string& text) {
  const std::string signs = replaced(without_brackets(trimmed(text)), {{"\xC2\xB5", "u"},  // micro
                                                                       {"\xCE\xBC", "u"},  // mu
                                                                       {"\xC2\xB7", "*"},  // products
                                                                       {"\xE2\x8B\x85", "*"},
                                                                       {"\xE2\x88\x99", "*"},
                                                                       {"\xE2\x80\xA2", "*"},
                                                                       {"\xC3\x97", "*"},
                                                                       {"\xE2\x81\xBB", "-"},  // powers
                                                                       {"\xC2\xB9", "1"},
                                                                       {"\xC2\xB2", "2"},
                                                                       {"\xC2\xB3", "3"},
                                                                       {"\xE2\x88\x92", "-"},
                                                                       {"\xE2\x80\x93", "-"},
                                                                       {"\xC2\xA0", " "},
                                                                       {"\xE2\x80\xAF", " "}});
  std::string plain;
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const bool digit_follows = k + 1 < signs.size() && signs[k + 1] >= '0' && signs[k + 1] <= '9';
    if (std::string(" .*^_").find(signs[k]) != std::string::npos) continue;
    if (signs[k] == '-' && !digit_follows) continue;  // N-m
    plain.push_back(signs[k]);
  }
  return plain;
}

const UnitInfo* find_unit(Quantity q, const std::string& text) {
  const std::string plain = plain_unit(text);
  if (plain.empty()) return nullptr;
  const UnitInfo* found = nullptr;
  for (const UnitInfo& unit : info(q).units)
    if (spells(unit, plain, false)) return &unit;
  for (const UnitInfo& unit : info(q).units) {
    if (!spells(unit, plain, true)) continue;
    const bool milli_and_mega = found != nullptr;
    if (milli_and_mega && plain[0] != 'm') return nullptr;
    if (!milli_and_mega || unit.name[0] == 'm') found = &unit;
  }
  return found;
}

bool is_unit(const std::string& text) {
  static const std::vector<std::string> others{
      "s",  "sec", "min", "h", "ms", "degC", "degF", "K",  "C", "%", "rad", "deg",  "N",    "mN",
      "mm", "um",  "m",   "-", "1",  "Hz",   "V",    "mA", "J", "W", "kPa", "mrad", "urad", "J/m3"};
  const std::string plain = replaced(plain_unit(text), {{"\xC2\xB0", "deg"}, {"\xE2\x84\x83", "degC"}});
  if (std::find(others.begin(), others.end(), plain) != others.end()) return true;
  return !plain.empty() && std::any_of(quantities().begin(), quantities().end(), [&](const QuantityInfo& q) {
    return find_unit(q.quantity, text) != nullptr;
  });
}

std::string names_of(Quantity q) {
  std::string all;
  for (const UnitInfo& unit : info(q).units)
    all += (all.empty() ? "" : ", ") + std::string(info(q).name) + "_" + unit.name;
  return all;
}

}  // namespace slagflow
