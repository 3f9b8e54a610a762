// The viscosity of a liquid slag from its composition, by two models of the literature:
//   eta = A T exp(B/T)   [Pa s], A [Pa s/K], B [K]
// P. V. Riboud, Y. Roux, L.-D. Lucas, H. Gaye, Fachber. Huettenpraxis Metallweiterverarb. 19 (1981) 859;
// G. Urbain, Steel Research 58 (1987) 111, in the form with B of CaO, MgO and MnO of the Slag Atlas (1995).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fluid/material.hpp"

namespace slagflow {

enum class SlagModel { urbain, riboud };
inline constexpr std::array<SlagModel, 2> slag_models{SlagModel::urbain, SlagModel::riboud};
const char* name_of(SlagModel model);

// How a model counts a component. lime, magnesia, manganese: modifiers with Urbain's B of CaO, MgO and MnO;
// other: a modifier with none of these.
enum class UrbainGroup { former, amphoteric, lime, magnesia, manganese, other };
enum class RiboudGroup { former, lime, alumina, alkali, fluoride };

struct SlagComponent {
  const char* name;
  double molar_mass;  // [g/mol]
  UrbainGroup urbain;
  double modifiers;  // that a mole counts for, of a modifier
  RiboudGroup riboud;
  bool in_riboud;  // the model names it, else it is counted by likeness
};
extern const std::array<SlagComponent, 17> slag_components;

struct Composition {
  std::array<double, slag_components.size()> mole{}, mass{};  // fractions
  double total = 0;                                           // of what was given

  double mass_of(const std::string& name) const;  // fraction
  double mole_of(const std::string& name) const;
};

// From "CaO=42, SiO2=36"; values in mass or mole per cent, of any total. Throws InputError.
Composition parse_composition(const std::string& text, bool mole);

// Throws InputError where the model gives no viscosity that falls with temperature.
LiquidViscosity slag_viscosity(SlagModel model, const Composition& composition);

// What of a composition is outside the range that a model was made for.
std::vector<std::string> outside_range(SlagModel model, const Composition& composition);

}  // namespace slagflow
