// The table of rheologies. A new one is a header in rheology/ and one entry here: the case parser, the
// dispatch on the device and the tests follow from the entry.
#pragma once

#include <array>

#include "rheology/bingham.hpp"
#include "rheology/newtonian.hpp"

namespace slagflow {

struct ParameterInfo {
  const char* key;  // in the case file
  const char* unit;
  const char* meaning;
  double lower;        // smallest value allowed
  bool lower_allowed;  // whether the limit itself is
  double fallback;     // default; negative: the key must be given
};

struct RheologyInfo {
  const char* name;  // in the case file
  const char* formula;
  int parameter_count;
  ParameterInfo parameters[4];
};

enum class RheologyKind : int { newtonian, bingham };

inline constexpr std::array<RheologyInfo, 2> rheologies{{
    {"newtonian",
     "eta = dynamic_viscosity",
     1,
     {{"dynamic_viscosity", "Pa s", "dynamic viscosity", 0, false, -1}}},
    {"bingham",
     "eta = plastic_viscosity + yield_stress (1 - exp(-m shear_rate)) / shear_rate",
     3,
     {{"plastic_viscosity", "Pa s", "viscosity of the yielded fluid", 0, false, -1},
      {"yield_stress", "Pa", "Bingham yield stress", 0, true, -1},
      {"growth_exponent", "s", "stress growth exponent m", 0, false, 1000}}},
}};

struct Rheology {
  RheologyKind kind = RheologyKind::newtonian;
  Real parameters[4] = {};

  const RheologyInfo& info() const { return rheologies[static_cast<std::size_t>(kind)]; }
};

// Calls f with the rheology as its own type.
template <class F>
HOST_DEVICE auto visit(const Rheology& r, F f) {
  switch (r.kind) {
    case RheologyKind::bingham:
      return f(Bingham(r.parameters));
    default:
      return f(Newtonian(r.parameters));
  }
}

HOST_DEVICE inline Real viscosity(const Rheology& r, Real shear_rate) {
  return visit(r, [=](auto model) { return model.viscosity(shear_rate); });
}

HOST_DEVICE inline bool yielded(const Rheology& r, Real shear_rate) {
  return visit(r, [=](auto model) { return model.yielded(shear_rate); });
}

}  // namespace slagflow
