// The table of rheologies. A new one is a header in rheology/ and one entry here: the case parser, the
// dispatch on the device and the tests follow from the entry.
#pragma once

#include <array>

#include "fluid/rheology/bingham.hpp"
#include "fluid/rheology/biviscous.hpp"
#include "fluid/rheology/carreau_yasuda.hpp"
#include "fluid/rheology/casson.hpp"
#include "fluid/rheology/herschel_bulkley.hpp"
#include "fluid/rheology/newtonian.hpp"

namespace slagflow {

// viscosity: the parameter that the solids of a suspension raise, and that stands for eta in dimensionless
// numbers. yield_stress: the one that may be given as a table over the solid fraction.
enum class ParameterRole { other, viscosity, yield_stress };

struct ParameterInfo {
  const char* key = "";  // in the case file
  const char* unit = "";
  const char* meaning = "";
  double lower = 0;            // smallest value allowed
  bool lower_allowed = false;  // whether the limit itself is
  double fallback = -1;        // default; negative: the key must be given
  ParameterRole role = ParameterRole::other;
  double upper = 1e30;  // largest value allowed; single precision holds little more
};

inline constexpr int most_parameters = 5;

struct RheologyInfo {
  const char* name;  // in the case file
  const char* formula;
  int parameter_count;
  ParameterInfo parameters[most_parameters];
};

enum class RheologyKind : int { newtonian, bingham, herschel_bulkley, casson, biviscous, carreau_yasuda };

namespace parameter {
inline constexpr ParameterInfo plastic_viscosity{
    "plastic_viscosity", "Pa s", "viscosity of the yielded fluid", 0, false, -1, ParameterRole::viscosity};
inline constexpr ParameterInfo yield_stress{
    "yield_stress", "Pa", "yield stress", 0, true, -1, ParameterRole::yield_stress};
inline constexpr ParameterInfo growth_exponent{
    "growth_exponent", "s", "stress growth exponent m", 0, false, 1000};
}  // namespace parameter

inline constexpr std::array<RheologyInfo, 6> rheologies{{
    {"newtonian",
     "eta = dynamic_viscosity",
     1,
     {{"dynamic_viscosity", "Pa s", "dynamic viscosity", 0, false, -1, ParameterRole::viscosity}}},
    {"bingham",
     "eta = plastic_viscosity + yield_stress (1 - exp(-m shear_rate)) / shear_rate",
     3,
     {parameter::plastic_viscosity, parameter::yield_stress, parameter::growth_exponent}},
    {"herschel-bulkley",
     "eta = consistency (shear_rate^2 + 1/m^2)^((flow_index - 1)/2)"
     " + yield_stress (1 - exp(-m shear_rate)) / shear_rate",
     4,
     {{"consistency", "Pa s^n", "stress of the power law at 1/s", 0, false, -1, ParameterRole::viscosity},
      {"flow_index", "", "exponent n of the power law", 0, false, -1, ParameterRole::other, 2},
      parameter::yield_stress,
      parameter::growth_exponent}},
    {"casson",
     "eta = [sqrt(casson_viscosity)"
     " + sqrt(yield_stress / shear_rate) (1 - exp(-sqrt(m shear_rate)))]^2",
     3,
     {{"casson_viscosity", "Pa s", "viscosity of fast shear", 0, false, -1, ParameterRole::viscosity},
      parameter::yield_stress,
      parameter::growth_exponent}},
    {"bi-viscous",
     "eta = plastic_viscosity [1 + (viscosity_ratio - 1) min(1, critical_rate / shear_rate)],"
     " critical_rate = yield_stress / (viscosity_ratio plastic_viscosity)",
     3,
     {parameter::plastic_viscosity,
      parameter::yield_stress,
      {"viscosity_ratio", "", "unyielded over plastic viscosity", 1, true, 1000, ParameterRole::other, 1e9}}},
    {"carreau-yasuda",
     "eta = infinite_shear_viscosity + (zero_shear_viscosity - infinite_shear_viscosity)"
     " (1 + (relaxation_time shear_rate)^transition)^((flow_index - 1)/transition)",
     5,
     {{"zero_shear_viscosity", "Pa s", "viscosity at rest", 0, false, -1, ParameterRole::viscosity},
      {"infinite_shear_viscosity", "Pa s", "viscosity of fast shear", 0, true, 0},
      {"relaxation_time", "s", "one over the shear rate where thinning begins", 0, true, -1},
      {"flow_index", "", "exponent n of the power law between the plateaus", 0, false, -1,
       ParameterRole::other, 1},
      {"transition", "", "sharpness a of the bend", 0.1, true, 2, ParameterRole::other, 10}}},
}};

struct Rheology {
  RheologyKind kind = RheologyKind::newtonian;
  Real parameters[most_parameters] = {};

  const RheologyInfo& info() const { return rheologies[static_cast<std::size_t>(kind)]; }
};

// Calls f with the rheology as its own type.
template <class F>
HOST_DEVICE auto visit(const Rheology& r, F f) {
  switch (r.kind) {
    case RheologyKind::bingham:
      return f(Bingham(r.parameters));
    case RheologyKind::herschel_bulkley:
      return f(HerschelBulkley(r.parameters));
    case RheologyKind::casson:
      return f(Casson(r.parameters));
    case RheologyKind::biviscous:
      return f(Biviscous(r.parameters));
    case RheologyKind::carreau_yasuda:
      return f(CarreauYasuda(r.parameters));
    default:
      return f(Newtonian(r.parameters));
  }
}

HOST_DEVICE inline Real viscosity(const Rheology& r, Real shear_rate) {
  return visit(r, [=](auto model) { return model.viscosity(shear_rate); });
}

// Whether a stress [Pa] exceeds the yield stress.
HOST_DEVICE inline bool yielded(const Rheology& r, Real stress) {
  return visit(r, [=](auto model) { return model.yielded(stress); });
}

}  // namespace slagflow
