// Newtonian fluid: eta = const.
#pragma once

#include "fluid/math.hpp"

namespace slagflow {

struct Newtonian {
  Real dynamic_viscosity;  // [Pa s]

  HOST_DEVICE explicit Newtonian(const Real* p) : dynamic_viscosity(p[0]) {}
  HOST_DEVICE Real viscosity(Real /*shear_rate*/) const { return dynamic_viscosity; }
  HOST_DEVICE bool yielded(Real /*stress*/) const { return true; }
};

}  // namespace slagflow
