// Herschel-Bulkley fluid, tau = tau_B + K gamma^n, with Papanastasiou's regularisation of the yield stress:
//   eta(gamma) = K (gamma^2 + 1/m^2)^((n - 1)/2) + tau_B (1 - exp(-m gamma)) / gamma   [Pa s]
// At rest the power law alone would be infinitely viscous for n < 1 and not viscous at all for n > 1. Here
// 1/m is added to the shear rate in quadrature: the limit at rest is K m^(1-n) + m tau_B, the stress grows
// with the shear rate for every n > 0, and from gamma = 100/m on the power law is off by less than 5e-5 |n -
// 1|. n = 1 is the Bingham fluid. W. H. Herschel and R. Bulkley, Kolloid-Z. 39 (1926) 291; P. J. Carreau,
// Trans. Soc. Rheol. 16 (1972) 99 for the sum under the root.
#pragma once

#include "fluid/math.hpp"
#include "fluid/rheology/papanastasiou.hpp"

namespace slagflow {

struct HerschelBulkley {
  Real consistency;      // K [Pa s^n]
  Real flow_index;       // n
  Real yield_stress;     // tau_B [Pa]
  Real growth_exponent;  // m [s]

  HOST_DEVICE explicit HerschelBulkley(const Real* p)
      : consistency(p[0]), flow_index(p[1]), yield_stress(p[2]), growth_exponent(p[3]) {}

  HOST_DEVICE Real viscosity(Real shear_rate) const {
    const Real rate = std::hypot(shear_rate, 1 / growth_exponent);
    return consistency * std::pow(rate, flow_index - 1) +
           yield_stress * growth_exponent * growth_ratio(growth_exponent * shear_rate);
  }
  HOST_DEVICE bool yielded(Real stress) const { return stress > yield_stress; }
};

}  // namespace slagflow
