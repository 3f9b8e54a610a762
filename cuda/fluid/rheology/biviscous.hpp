// Bi-viscous fluid: Newtonian with R eta_P up to the stress tau_B, with the slope eta_P beyond:
//   tau = R eta_P gamma                    up to gamma_c = tau_B / (R eta_P)
//   tau = tau_B + eta_P (gamma - gamma_c)  beyond
//   eta(gamma) = eta_P + (R - 1) eta_P min(1, gamma_c / gamma)   [Pa s]
// E. J. O'Donovan and R. I. Tanner, J. Non-Newtonian Fluid Mech. 15 (1984) 75, with R = 1000.
#pragma once

#include "fluid/math.hpp"

namespace slagflow {

struct Biviscous {
  Real plastic_viscosity;    // eta_P [Pa s]
  Real yield_stress;         // tau_B [Pa]
  Real viscosity_ratio;      // R
  Real critical_shear_rate;  // gamma_c [1/s]

  HOST_DEVICE explicit Biviscous(const Real* p)
      : plastic_viscosity(p[0]),
        yield_stress(p[1]),
        viscosity_ratio(p[2]),
        critical_shear_rate(p[1] / (p[2] * p[0])) {}

  HOST_DEVICE Real viscosity(Real shear_rate) const {
    // Without a yield stress the fluid is Newtonian at rest too.
    const Real at_rest = yield_stress > 0 ? Real(1) : Real(0);
    const Real share = shear_rate > critical_shear_rate ? critical_shear_rate / shear_rate : at_rest;
    return plastic_viscosity + (viscosity_ratio - 1) * plastic_viscosity * share;
  }
  HOST_DEVICE bool yielded(Real stress) const { return stress > yield_stress; }
};

}  // namespace slagflow
