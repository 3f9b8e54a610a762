#include "host/rheometry/rheometry_composition.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "backend/error.hpp"
#include "host/case/case_table.hpp"
#include "host/rheometry/rheometry_facts.hpp"
#include "host/text/number_text.hpp"
#include "host/text/table_text.hpp"

namespace slagflow {

using U = UrbainGroup;
using R = RiboudGroup;
const std::array<SlagComponent, 17> slag_components{{
    {"SiO2", 60.084, U::former, 0, R::former, true},
    {"P2O5", 141.945, U::former, 0, R::former, true},
    {"Al2O3", 101.961, U::amphoteric, 0, R::alumina, true},
    {"B2O3", 69.62, U::amphoteric, 0, R::alumina, false},
    {"Fe2O3", 159.688, U::amphoteric, 0, R::lime, false},
    {"Cr2O3", 151.99, U::amphoteric, 0, R::lime, false},
    {"CaO", 56.077, U::lime, 1, R::lime, true},
    {"MgO", 40.304, U::magnesia, 1, R::lime, true},
    {"FeO", 71.844, U::manganese, 1, R::lime, true},
    {"MnO", 70.937, U::manganese, 1, R::lime, true},
    {"BaO", 153.326, U::lime, 1, R::lime, false},
    {"Na2O", 61.979, U::lime, 1, R::alkali, true},
    {"K2O", 94.196, U::lime, 1, R::alkali, true},
    {"Li2O", 29.881, U::lime, 1, R::alkali, false},
    {"CaF2", 78.075, U::other, 3, R::fluoride, true},
    {"TiO2", 79.866, U::other, 2, R::former, true},
    {"ZrO2", 123.223, U::other, 2, R::former, true},
}};

namespace {

constexpr double from_decipascal = 0.1;  // Urbain's A is in dPa s/K
constexpr std::size_t count = slag_components.size();

// B_i of one modifier: sum over k of (b[k] + p[k] alpha + q[k] alpha^2) G^k, in 10^3 K.
struct Polynomial {
  std::array<double, 4> linear, square;

  double at(double alpha, double formers) const {
    constexpr std::array<double, 4> base{13.2, 30.5, -40.4, 60.8};
    double sum = 0, power = 1;
    for (std::size_t k = 0; k < base.size(); ++k) {
      sum += (base[k] + (linear[k] + square[k] * alpha) * alpha) * power;
      power *= formers;
    }
    return sum;
  }
};
constexpr Polynomial of_lime{{41.5, -117.2, 232.1, -156.4}, {-45, 130, -298.6, 213.6}};
constexpr Polynomial of_magnesia{{15.9, -54.1, 138, -99.8}, {-18.6, 33, -112, 97.6}};
constexpr Polynomial of_manganese{{20, 26, -110.3, 64.3}, {-25.6, -56, 186.2, -104.6}};

std::string names_of_components() {
  std::string all;
  for (const SlagComponent& c : slag_components) all += (all.empty() ? "" : ", ") + std::string(c.name);
  return all;
}

double moles(const Composition& c, U group) {
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (slag_components[k].urbain == group) sum += c.mole[k];
  return sum;
}

double moles(const Composition& c, R group) {
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (slag_components[k].riboud == group) sum += c.mole[k];
  return sum;
}

// G, M and Am are normalised so that their sum is 1.
LiquidViscosity urbain(const Composition& c) {
  double formers = 0, amphoterics = 0, modifiers = 0;
  for (std::size_t k = 0; k < count; ++k) {
    formers += slag_components[k].urbain == U::former ? c.mole[k] : 0;
    amphoterics += slag_components[k].urbain == U::amphoteric ? c.mole[k] : 0;
    modifiers += slag_components[k].modifiers * c.mole[k];
  }
  const double lime = moles(c, U::lime), magnesia = moles(c, U::magnesia), manganese = moles(c, U::manganese),
               weight = lime + magnesia + manganese;
  if (!(weight > 0))
    throw InputError(
        "composition: no CaO, MgO, MnO, FeO or alkali: allowed for the urbain model: one of them");
  const double alpha = modifiers / (modifiers + amphoterics);
  const double g = formers / (formers + amphoterics + modifiers);
  const double b = (lime * of_lime.at(alpha, g) + magnesia * of_magnesia.at(alpha, g) +
                    manganese * of_manganese.at(alpha, g)) /
                   weight;
  LiquidViscosity liquid;
  liquid.a = from_decipascal * std::exp(-(0.29 * b + 11.57)), liquid.b = 1e3 * b;
  return liquid;
}

LiquidViscosity riboud(const Composition& c) {
  const double lime = moles(c, R::lime), alumina = moles(c, R::alumina), alkali = moles(c, R::alkali),
               fluoride = moles(c, R::fluoride);
  LiquidViscosity liquid;
  liquid.a = std::exp(-19.81 + 1.73 * lime + 5.82 * fluoride + 7.02 * alkali - 35.76 * alumina);
  liquid.b = 31140 - 23896 * lime - 46356 * fluoride - 39159 * alkali + 68833 * alumina;
  return liquid;
}

std::size_t index_of(const std::string& name) {
  const auto found = std::find_if(slag_components.begin(), slag_components.end(),
                                  [&](const SlagComponent& c) { return name == c.name; });
  if (found == slag_components.end()) throw Error("composition: no component " + name);
  return static_cast<std::size_t>(found - slag_components.begin());
}

struct Share {
  std::size_t component;
  double value;
};

Share parse_share(const std::string& part) {
  const std::size_t sign = part.find_first_of("=:");
  const std::string name = trimmed(part.substr(0, sign)),
                    value = sign == std::string::npos ? "" : trimmed(part.substr(sign + 1));
  if (sign == std::string::npos)
    throw InputError("composition: " + quoted(part) +
                     ": allowed: NAME=VALUE, separated by commas, with decimal points");
  std::vector<std::string> names;
  for (const SlagComponent& c : slag_components) names.push_back(c.name);
  const std::string plain = lower_case(name);
  const auto found = std::find_if(names.begin(), names.end(),
                                  [&](const std::string& known) { return lower_case(known) == plain; });
  if (found == names.end())
    throw InputError("composition: " + quoted(name) + ": unknown: " + suggestion(name, names) +
                     "allowed: " + names_of_components());
  const NumberAndRest parts = split_number(value);
  const std::optional<double> number = number_of(parts.number, DecimalSign::point);
  if (!number || *number < 0 || (!parts.rest.empty() && parts.rest[0] != '%'))
    throw InputError("composition: " + *found + ": value " + quoted(value) + ": allowed: a number >= 0 in %");
  return {static_cast<std::size_t>(found - names.begin()), *number};
}

std::vector<std::string> parts_of(const std::string& text) {
  const std::string plain =
      replaced(text, {{"₀", "0"}, {"₁", "1"}, {"₂", "2"}, {"₃", "3"}, {"₄", "4"}, {"₅", "5"}});
  std::vector<std::string> parts{""};
  for (const char c : plain)
    if (c == ',' || c == ';' || c == '\n')
      parts.emplace_back();
    else
      parts.back() += c;
  for (std::string& part : parts) part = trimmed(part);
  parts.erase(std::remove(parts.begin(), parts.end(), ""), parts.end());
  return parts;
}

// In mass per cent.
struct Limits {
  std::vector<const char*> names;  // their sum
  double least, most;
};

}  // namespace

const char* name_of(SlagModel model) { return model == SlagModel::urbain ? "urbain" : "riboud"; }

double Composition::mass_of(const std::string& name) const { return mass[index_of(name)]; }
double Composition::mole_of(const std::string& name) const { return mole[index_of(name)]; }

Composition parse_composition(const std::string& text, bool mole) {
  Composition c;
  std::array<bool, count> given{};
  for (const std::string& part : parts_of(text)) {
    const Share share = parse_share(part);
    const std::string name = slag_components[share.component].name;
    if (given[share.component]) throw InputError("composition: " + name + " stands twice: allowed: once");
    given[share.component] = true;
    (mole ? c.mole : c.mass)[share.component] = share.value;
    c.total += share.value;
  }
  if (!(c.total > 0))
    throw InputError("composition " + quoted(text) + ": allowed: NAME=VALUE of at least one of " +
                     names_of_components());
  double moles = 0, masses = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double m = slag_components[k].molar_mass;
    if (mole)
      c.mass[k] = c.mole[k] * m;
    else
      c.mole[k] = c.mass[k] / m;
    moles += c.mole[k], masses += c.mass[k];
  }
  for (std::size_t k = 0; k < count; ++k) c.mole[k] /= moles, c.mass[k] /= masses;
  return c;
}

LiquidViscosity slag_viscosity(SlagModel model, const Composition& composition) {
  LiquidViscosity liquid = model == SlagModel::urbain ? urbain(composition) : riboud(composition);
  liquid.law = LiquidLaw::weymann;
  if (!(liquid.b > 0 && liquid.a > 0))
    throw InputError(std::string("composition: the ") + name_of(model) + " model gives B = " +
                     text_of(liquid.b) + " K: allowed: a composition for which it is above 0");
  return liquid;
}

std::vector<std::string> outside_range(SlagModel model, const Composition& composition) {
  static const std::vector<Limits> riboud_limits{{{"SiO2"}, 27, 56},
                                                 {{"CaO"}, 8, 46},
                                                 {{"Al2O3"}, 0, 12},
                                                 {{"Na2O", "K2O", "Li2O"}, 0, 22},
                                                 {{"CaF2"}, 0, 18}};
  static const std::vector<Limits> common{{{"FeO", "Fe2O3", "MnO"}, 0, 15}, {{"TiO2", "ZrO2"}, 0, 10}};
  std::vector<std::string> found;
  const auto check = [&](const std::vector<Limits>& all) {
    for (const Limits& limits : all) {
      double sum = 0;
      std::string names;
      for (const char* const name : limits.names) {
        sum += 100 * composition.mass_of(name);
        names += (names.empty() ? "" : " + ") + std::string(name);
      }
      if (sum < limits.least - 1e-9 || sum > limits.most + 1e-9)
        found.push_back(names + " " + text_of(std::round(10 * sum) / 10) + " mass %, made for " +
                        text_of(limits.least) + " to " + text_of(limits.most));
    }
  };
  if (model == SlagModel::riboud) check(riboud_limits);
  check(common);
  for (std::size_t k = 0; k < count; ++k)
    if (model == SlagModel::riboud && composition.mole[k] > 0 && !slag_components[k].in_riboud)
      found.push_back(std::string(slag_components[k].name) +
                      " is not of the model, it is counted by likeness");
  return found;
}

}  // namespace slagflow
