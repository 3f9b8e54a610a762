// Bingham fluid in Papanastasiou's regularisation, equation (4):
//   eta(gamma) = eta_P + tau_B (1 - exp(-m gamma)) / gamma,  limit eta_P + m tau_B   [Pa s]
// T. C. Papanastasiou, J. Rheol. 31 (1987) 385.
#pragma once

#include "fluid/math.hpp"
#include "fluid/rheology/papanastasiou.hpp"

namespace slagflow {

struct Bingham {
  Real plastic_viscosity;  // eta_P [Pa s]
  Real yield_stress;       // tau_B [Pa]
  Real growth_exponent;    // m [s]

  HOST_DEVICE explicit Bingham(const Real* p)
      : plastic_viscosity(p[0]), yield_stress(p[1]), growth_exponent(p[2]) {}

  HOST_DEVICE Real viscosity(Real shear_rate) const {
    return plastic_viscosity + yield_stress * growth_exponent * growth_ratio(growth_exponent * shear_rate);
  }
  HOST_DEVICE bool yielded(Real stress) const { return stress > yield_stress; }
};

}  // namespace slagflow
