// The names that columns have in files of several makers and languages.
#include <algorithm>
#include <array>

#include "host/rheometry/rheometry_units.hpp"
#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

enum class Trust { strong, weak };

struct Alias {
  const char* name;  // as plain_name gives it
  Quantity quantity;
  Trust trust = Trust::strong;
  const char* unit = "";  // that the name says
  bool angular = false;
};

// Longer names before their beginnings.
constexpr std::array<Alias, 81> aliases{{
    {"full scale torque", Quantity::full_scale_torque},
    {"bob radius", Quantity::bob_radius},
    {"cup radius", Quantity::cup_radius},
    {"density", Quantity::density},
    {"dichte", Quantity::density, Trust::weak},
    {"height", Quantity::height},
    {"shear rate", Quantity::shear_rate},
    {"shearrate", Quantity::shear_rate},
    {"rate of shear", Quantity::shear_rate},
    {"scherrate", Quantity::shear_rate},
    {"schergeschwindigkeit", Quantity::shear_rate},
    {"vitesse de cisaillement", Quantity::shear_rate},
    {"taux de cisaillement", Quantity::shear_rate},
    {"gamma dot", Quantity::shear_rate},
    {"gammadot", Quantity::shear_rate},
    {"gamma punkt", Quantity::shear_rate},
    {"せん断速度", Quantity::shear_rate},
    {"ずり速度", Quantity::shear_rate},
    {"rate", Quantity::shear_rate, Trust::weak},
    {"gp", Quantity::shear_rate, Trust::weak},
    {"d", Quantity::shear_rate, Trust::weak},
    {"shear stress", Quantity::shear_stress},
    {"shearstress", Quantity::shear_stress},
    {"schubspannung", Quantity::shear_stress},
    {"scherspannung", Quantity::shear_stress},
    {"contrainte de cisaillement", Quantity::shear_stress},
    {"せん断応力", Quantity::shear_stress},
    {"ずり応力", Quantity::shear_stress},
    {"stress", Quantity::shear_stress, Trust::weak},
    {"tau", Quantity::shear_stress, Trust::weak},
    {"apparent viscosity", Quantity::viscosity},
    {"dynamic viscosity", Quantity::viscosity},
    {"shear viscosity", Quantity::viscosity},
    {"viscosity", Quantity::viscosity},
    {"viskositaet", Quantity::viscosity},
    {"viscosit\xC3\xA9", Quantity::viscosity},
    {"viskosit\xC3\xA4t", Quantity::viscosity},
    {"粘度", Quantity::viscosity},
    {"cp", Quantity::viscosity, Trust::strong, "cP"},
    {"cps", Quantity::viscosity, Trust::strong, "cP"},
    {"visc", Quantity::viscosity, Trust::weak},
    {"eta", Quantity::viscosity, Trust::weak},
    {"angular velocity", Quantity::rotation, Trust::strong, "", true},
    {"angular speed", Quantity::rotation, Trust::strong, "", true},
    {"winkelgeschwindigkeit", Quantity::rotation, Trust::strong, "", true},
    {"omega", Quantity::rotation, Trust::weak, "", true},
    {"rotational speed", Quantity::rotation},
    {"rotation speed", Quantity::rotation},
    {"rotation", Quantity::rotation},
    {"drehzahl", Quantity::rotation},
    {"回転数", Quantity::rotation},
    {"rpm", Quantity::rotation, Trust::strong, "rpm"},
    {"u/min", Quantity::rotation, Trust::strong, "rpm"},
    {"upm", Quantity::rotation, Trust::strong, "rpm"},
    {"spindle speed", Quantity::rotation},
    {"speed", Quantity::rotation, Trust::weak},
    {"n", Quantity::rotation, Trust::weak},
    {"% torque", Quantity::torque, Trust::strong, percent_unit},
    {"%torque", Quantity::torque, Trust::strong, percent_unit},
    {"percent torque", Quantity::torque, Trust::strong, percent_unit},
    {"dial reading", Quantity::torque, Trust::strong, percent_unit},
    {"dial", Quantity::torque, Trust::strong, percent_unit},
    {"skalenwert", Quantity::torque, Trust::strong, percent_unit},
    {"torque", Quantity::torque},
    {"drehmoment", Quantity::torque},
    {"トルク", Quantity::torque},
    {"md", Quantity::torque, Trust::weak},
    {"m", Quantity::torque, Trust::weak},
    {"temperature", Quantity::temperature},
    {"temperatur", Quantity::temperature},
    {"temperatura", Quantity::temperature},
    {"temp\xC3\xA9rature", Quantity::temperature},
    {"sample temperature", Quantity::temperature},
    {"melt temperature", Quantity::temperature},
    {"probentemperatur", Quantity::temperature},
    {"messtemperatur", Quantity::temperature},
    {"試料温度", Quantity::temperature},
    {"温度", Quantity::temperature},
    {"temp.", Quantity::temperature},
    {"temp", Quantity::temperature},
    {"t", Quantity::temperature, Trust::weak},
}};

// Lower case, blanks for underscores, Greek letters by name.
std::string plain_name(const std::string& text) {
  const std::string plain = lower_case(replaced(text, {{"\xCE\xB3\xCC\x87", "gammadot"},  // gamma with a dot
                                                       {"\xC6\x94\xCC\x87", "gammadot"},  // the Latin one
                                                       {"\xC9\xA3\xCC\x87", "gammadot"},
                                                       {"\xE1\xBA\x8F", "gammadot"},  // y with a dot
                                                       {"\xCF\x84", "tau"},
                                                       {"\xCE\xB7", "eta"},
                                                       {"\xCF\x89", "omega"},
                                                       {"\xCE\xA9", "omega"},
                                                       {"\xE2\x84\xA6", "omega"},
                                                       {"\xC3\x84", "\xC3\xA4"},
                                                       {"\xC2\xA0", " "},
                                                       {"_", " "},
                                                       {"-", " "},
                                                       {"\n", " "}}));
  return replaced(plain, {{"  ", " "}});
}

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

// Bytes of `text` of which the alias is the plain name; 0: it does not begin so.
std::size_t length_of(const std::string& text, const std::string& alias) {
  if (plain_name(text.substr(0, 3 * alias.size())).compare(0, alias.size(), alias) != 0) return 0;
  for (std::size_t end = alias.size() / 3; end <= text.size() && end < 3 * alias.size(); ++end) {
    if (plain_name(text.substr(0, end)) != alias) continue;
    const std::string next = plain_name(text.substr(end, 1));
    return next.empty() || !is_word_character(next[0]) ? end : 0;
  }
  return 0;
}

// What stands in brackets at the end, and what before it.
struct Bracketed {
  std::string before, inside;
  bool found = false;
};

Bracketed split_brackets(const std::string& text) {
  const std::string opening = "[({<", closing = "])}>";
  const std::size_t kind = text.empty() ? std::string::npos : closing.find(text.back());
  if (kind == std::string::npos) return {text, "", false};
  int depth = 0;
  for (std::size_t k = text.size(); k-- > 0;) {
    depth += (text[k] == closing[kind]) - (text[k] == opening[kind]);
    if (depth == 0)
      return {trimmed(text.substr(0, k)), trimmed(text.substr(k + 1, text.size() - k - 2)), true};
  }
  return {text, "", false};
}

// Without what joins a name and its unit: _ , : / in.
std::string without_joint(const std::string& text) {
  std::string rest = trimmed(text);
  const bool slash_of_unit = rest.size() > 1 && rest[0] == '/' && rest[1] != ' ';
  if (!rest.empty() && std::string("_,:;|").find(rest[0]) != std::string::npos)
    rest = trimmed(rest.substr(1));
  if (!rest.empty() && rest[0] == '/' && !slash_of_unit) rest = trimmed(rest.substr(1));
  if (lower_case(rest.substr(0, 3)) == "in " || lower_case(rest.substr(0, 3)) == "in_")
    rest = trimmed(rest.substr(3));
  return rest;
}

// A symbol, such as the tau of `Shear stress tau [Pa]`.
bool names(const std::string& text, Quantity q) {
  const Bracketed parts = split_brackets(text);
  const std::string name = plain_name(parts.found && parts.before.empty() ? parts.inside : text);
  return name.empty() || std::any_of(aliases.begin(), aliases.end(), [&](const Alias& alias) {
           return alias.quantity == q && name == alias.name;
         });
}

// From what follows the name. Another word before the unit, as in `shear stress amplitude [Pa]`, is another
// quantity.
NamedQuantity with_rest(const NamedQuantity& named, const std::string& rest) {
  if (rest.empty()) return named;
  const Bracketed parts = split_brackets(rest);
  if (parts.found) {
    NamedQuantity remarked = with_unit(named, without_joint(parts.before));
    if (remarked.unit_known && !is_unit(parts.inside)) return remarked;  // Shear rate, 1/s (corrected)
    if (!names(without_joint(parts.before), named.quantity)) return {};
    const NamedQuantity with = with_unit(named, parts.inside);
    return !with.unit_known && names(parts.inside, named.quantity) ? named : with;
  }
  const std::string unit = without_joint(rest);
  NamedQuantity with = with_unit(named, unit);
  if (with.unit_known) return with;
  if (unit[0] == '/' && with_unit(named, unit.substr(1)).unit_known) return with_unit(named, unit.substr(1));
  const std::size_t gap = unit.find_first_of(" ,/");
  if (gap != std::string::npos && names(unit.substr(0, gap), named.quantity))
    return with_unit(named, without_joint(unit.substr(gap)));
  if (names(unit, named.quantity)) return named;
  const bool words =
      rest[0] == ' ' && unit.find_first_of("0123456789/%") == std::string::npos && unit.size() > 3;
  return words ? NamedQuantity{} : with;
}

}  // namespace

NamedQuantity with_unit(NamedQuantity named, const std::string& unit) {
  if (!named.known) return named;
  const UnitInfo* const found = find_unit(named.quantity, unit);
  const bool turns = found && named.angular && found->name == std::string("1/s");
  named.unit_known = found && !turns;
  named.unit = found ? found->name : trimmed(unit);
  named.factor = found ? found->factor : 1;
  named.offset = found ? found->offset : 0;
  named.percent = found && found->name == std::string(percent_unit);
  return named;
}

NamedQuantity parse_name(const std::string& text) {
  const std::string name = trimmed(replaced(text, {{"（", "("}, {"）", ")"}}));
  constexpr std::size_t longest = 120;  // of a name
  if (name.size() > longest) return {};
  for (const Alias& alias : aliases) {
    const std::size_t length = length_of(name, alias.name);
    if (length == 0) continue;
    NamedQuantity named;
    named.known = true;
    named.quantity = alias.quantity;
    named.weak = alias.trust == Trust::weak;
    named.angular = alias.angular;
    if (*alias.unit) named = with_unit(named, alias.unit);
    return with_rest(named, without_joint(name.substr(length)).empty() ? "" : name.substr(length));
  }
  return {};
}

}  // namespace slagflow
