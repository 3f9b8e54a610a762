// Casson fluid in Papanastasiou's regularisation:
//   sqrt(tau) = sqrt(tau_B) (1 - exp(-sqrt(m gamma))) + sqrt(eta_C gamma), so with y = sqrt(m gamma)
//   eta(gamma) = [sqrt(eta_C) + sqrt(m tau_B) (1 - exp(-y)) / y]^2,  limit (sqrt(eta_C) + sqrt(m tau_B))^2
// N. Casson, in: Rheology of Disperse Systems (1959) 84; T. C. Papanastasiou, J. Rheol. 31 (1987) 385;
// E. Mitsoulis, Rheology Reviews (2007) 135.
#pragma once

#include "fluid/math.hpp"
#include "fluid/rheology/papanastasiou.hpp"

namespace slagflow {

struct Casson {
  Real casson_viscosity;  // eta_C [Pa s]
  Real yield_stress;      // tau_B [Pa]
  Real growth_exponent;   // m [s]

  HOST_DEVICE explicit Casson(const Real* p)
      : casson_viscosity(p[0]), yield_stress(p[1]), growth_exponent(p[2]) {}

  HOST_DEVICE Real viscosity(Real shear_rate) const {
    const Real growth = growth_ratio(std::sqrt(growth_exponent * shear_rate));
    return square(std::sqrt(casson_viscosity) + std::sqrt(yield_stress * growth_exponent) * growth);
  }
  HOST_DEVICE bool yielded(Real stress) const { return stress > yield_stress; }
};

}  // namespace slagflow
