// Bingham fluid in Papanastasiou's regularisation, equation (4):
//   eta(gamma) = eta_P + tau_B (1 - exp(-m gamma)) / gamma,  limit eta_P + m tau_B   [Pa s]
// T. C. Papanastasiou, J. Rheol. 31 (1987) 385.
#pragma once

#include "math.hpp"

namespace slagflow {

struct Bingham {
  Real plastic_viscosity;  // eta_P [Pa s]
  Real yield_stress;       // tau_B [Pa]
  Real growth_exponent;    // m [s]

  HOST_DEVICE explicit Bingham(const Real* p)
      : plastic_viscosity(p[0]), yield_stress(p[1]), growth_exponent(p[2]) {}

  HOST_DEVICE Real viscosity(Real shear_rate) const {
    const Real x = growth_exponent * shear_rate;
    // expm1 keeps its digits where the exponential is close to one; below 1e-6 the limit is exact.
    const Real ratio = x > Real(1e-6) ? -std::expm1(-x) / x : Real(1);
    return plastic_viscosity + yield_stress * growth_exponent * ratio;
  }
  // Yielded where the stress magnitude eta gamma exceeds tau_B.
  HOST_DEVICE bool yielded(Real shear_rate) const {
    return viscosity(shear_rate) * shear_rate > yield_stress;
  }
};

}  // namespace slagflow
