#include "host/rheometry/rheometry_phase_names.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "host/rheometry/rheometry_units.hpp"
#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

using Words = std::vector<std::string>;

struct PhaseUnit {
  const char* name;  // as plain_unit gives it, in lower case
  double factor;
  bool per_mass;
};
constexpr std::array<PhaseUnit, 8> enthalpy_units{{{"j", 1, false},
                                                   {"kj", 1e3, false},
                                                   {"mj", 1e6, false},
                                                   {"j/kg", 1, true},
                                                   {"kj/kg", 1e3, true},
                                                   {"mj/kg", 1e6, true},
                                                   {"j/g", 1e3, true},
                                                   {"kj/g", 1e6, true}}};

bool holds(const std::string& text, const Words& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

bool is_one_of(const std::string& text, const Words& words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

// Lower case, blanks for underscores, no blank twice.
std::string plain(const std::string& text) {
  const std::string lower =
      lower_case(replaced(text, {{"Ü", "ü"}, {"Ä", "ä"}, {"_", " "}, {"\n", " "}, {"\xC2\xA0", " "}}));
  return trimmed(replaced(lower, {{"  ", " "}}));
}

// A name and the unit in brackets, or after a comma or a slash, at its end.
struct Parts {
  std::string name, unit;
};

Parts split_unit(const std::string& text) {
  const std::string all = trimmed(text);
  const std::string opening = "[(", closing = "])";
  const std::size_t kind = all.empty() ? std::string::npos : closing.find(all.back());
  if (kind != std::string::npos) {
    int depth = 0;
    for (std::size_t k = all.size(); k-- > 0;) {
      depth += (all[k] == closing[kind]) - (all[k] == opening[kind]);
      if (depth == 0) return {plain(all.substr(0, k)), trimmed(all.substr(k + 1, all.size() - k - 2))};
    }
  }
  for (const std::string joint : {" / ", ", "})
    if (const std::size_t at = all.rfind(joint); at != std::string::npos && at > 0)
      return {plain(all.substr(0, at)), trimmed(all.substr(at + joint.size()))};
  return {plain(all), ""};
}

bool is_percent(const std::string& unit) {
  return unit.find('%') != std::string::npos || lower_case(unit) == "percent";
}

bool is_liquid(const std::string& phase) { return holds(phase, {"liq", "slag", "melt", "schmelze", "液"}); }

PhaseRole role_of_phase(const std::string& phase) {
  if (is_liquid(phase)) return PhaseRole::liquid;
  return holds(phase, {"gas"}) ? PhaseRole::gas : PhaseRole::solid;
}

// Enthalpy or heat capacity; the unit of the latter is one of the former over K.
bool take_caloric(PhaseColumn& column, const Parts& parts) {
  static const Words enthalpies{
      "h",  "enthalpy",    "enthalpie", "specific enthalpy", "system enthalpy", "enthalpy of system",
      "hm", "エンタルピー"};
  static const Words capacities{"cp",
                                "c p",
                                "heat capacity",
                                "specific heat",
                                "specific heat capacity",
                                "wärmekapazität",
                                "capacité thermique",
                                "比熱"};
  const bool enthalpy = is_one_of(parts.name, enthalpies);
  if (!enthalpy && !is_one_of(parts.name, capacities)) return false;
  column.role = enthalpy ? PhaseRole::enthalpy : PhaseRole::heat_capacity;
  std::string unit = lower_case(replaced(
      plain_unit(parts.unit), {{"(", ""}, {")", ""}, {"K-1", "/K"}, {"kg-1", "/kg"}, {"g-1", "/g"}}));
  if (!enthalpy && !unit.empty() && unit.back() == 'k') unit.pop_back();
  if (!enthalpy && !unit.empty() && unit.back() == '/') unit.pop_back();
  column.unit = parts.unit, column.unit_known = false;
  for (const PhaseUnit& known : enthalpy_units)
    if (unit == known.name)
      column.unit_known = true, column.factor = known.factor, column.per_mass = known.per_mass;
  return true;
}

// Whether it is a name of all solids, or of all liquids.
bool names_solids(const std::string& name) {
  return is_one_of(name, {"fs", "f s", "phi", "φ", "solids", "solid", "solid fraction", "fraction solid",
                          "fraction of solid", "solid phase fraction", "feststoffanteil", "festanteil",
                          "fraction solide", "固相率", "all solid phases", "total solid", "solid phases"});
}
bool names_liquids(const std::string& name) {
  return is_one_of(name, {"fl", "f l", "liquid fraction", "fraction liquid", "fraction of liquid",
                          "melt fraction", "flüssiganteil", "schmelzanteil", "fraction liquide", "液相率",
                          "liquid phase fraction", "all liquid phases"});
}

// In lower case; empty: it is none of an amount.
std::string amount_unit(const std::string& text) {
  const std::string unit = lower_case(plain_unit(text));
  if (is_one_of(unit, {"g", "gram", "grams"})) return "g";
  return is_one_of(unit, {"kg", "mol"}) ? unit : "";
}

bool take_fraction(PhaseColumn& column, const Parts& parts) {
  std::string name = parts.name;
  for (const char* const word : {"mass ", "weight ", "volume ", "wt% ", "wt.% ", "vol% ", "vol.% ", "% "})
    if (begins(name, word)) {
      column.percent = column.percent || std::string(word).find('%') != std::string::npos;
      name = name.substr(std::string(word).size());
    }
  if (begins(name, "fraction of all ")) name = name.substr(12);
  const bool solid = names_solids(name), liquid = names_liquids(name);
  if ((!solid && !liquid) || !amount_unit(parts.unit).empty()) return false;
  column.role = solid ? PhaseRole::solid_fraction : PhaseRole::liquid_fraction;
  column.percent = column.percent || is_percent(parts.unit);
  column.unit = parts.unit;
  return true;
}

// `g_ASlag-liq#1`, `Spinel [g]`, `Mass fraction of LIQUID`, `NP(LIQUID)`.
bool take_amount(PhaseColumn& column, const std::string& name, const Parts& parts) {
  struct Form {
    const char *beginning, *unit;
  };
  static constexpr std::array<Form, 14> forms{{{"g_", "g"},
                                               {"gram_", "g"},
                                               {"kg_", "kg"},
                                               {"mol_", "mol"},
                                               {"mass fraction of ", "mass fraction"},
                                               {"weight fraction of ", "mass fraction"},
                                               {"volume fraction of ", "volume fraction"},
                                               {"mole fraction of ", "mol"},
                                               {"amount of ", "amount"},
                                               {"bpw(", "mass fraction"},
                                               {"vpv(", "volume fraction"},
                                               {"np(", "mol"},
                                               {"npm(", "mol"},
                                               {"bp(", "g"}}};
  const std::string lower = lower_case(trimmed(name));
  std::string unit = amount_unit(parts.unit), phase = parts.name;
  bool known = !unit.empty();
  for (const Form& form : forms)
    if (begins(lower, form.beginning))
      known = true, unit = form.unit, phase = lower.substr(std::string(form.beginning).size());
  if (!known) return false;
  column.role = role_of_phase(phase);
  column.unit = unit;
  column.percent = is_percent(parts.unit);
  column.factor = unit == "g" ? 1e-3 : 1;
  return true;
}

// Of the whole system, not of a phase.
bool is_of_system(const std::string& name) {
  static const Words beginnings{"p",    "pressure", "alpha", "v",    "g",      "s",       "u",
                                "time", "step",     "total", "sum",  "system", "density", "volume",
                                "mass", "a",        "x",     "page", "no",     "#"};
  const std::string word = name.substr(0, name.find_first_of(" (["));
  return name.empty() || is_one_of(word, beginnings) || name.find('%') != std::string::npos;
}

}  // namespace

PhaseColumn parse_phase_column(const std::string& name) {
  PhaseColumn column;
  column.name = name;
  const NamedQuantity named = parse_name(name);
  if (named.known && named.quantity == Quantity::temperature && (named.unit_known || !named.weak)) {
    column.role = PhaseRole::temperature;
    column.unit_known = named.unit_known, column.unit = named.unit;
    column.factor = named.factor, column.offset = named.offset;
    return column;
  }
  const Parts parts = split_unit(name);
  if (take_caloric(column, parts) || take_fraction(column, parts) || take_amount(column, name, parts) ||
      is_of_system(parts.name))
    return column;
  column.role = role_of_phase(plain(name));
  column.bare = true, column.unit = "amount";
  return column;
}

}  // namespace slagflow
