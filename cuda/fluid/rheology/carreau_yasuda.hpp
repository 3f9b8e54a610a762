// Carreau-Yasuda fluid, shear thinning between two plateaus, without a yield stress:
//   eta(gamma) = eta_inf + (eta_0 - eta_inf) (1 + (lambda gamma)^a)^((n - 1)/a)   [Pa s]
// a = 2 is Carreau's model. K. Yasuda, R. C. Armstrong and R. E. Cohen, Rheol. Acta 20 (1981) 163.
#pragma once

#include "fluid/math.hpp"

namespace slagflow {

struct CarreauYasuda {
  Real zero_shear_viscosity;      // eta_0 [Pa s]
  Real infinite_shear_viscosity;  // eta_inf [Pa s]
  Real relaxation_time;           // lambda [s]
  Real flow_index;                // n
  Real transition;                // a

  HOST_DEVICE explicit CarreauYasuda(const Real* p)
      : zero_shear_viscosity(p[0]),
        infinite_shear_viscosity(p[1]),
        relaxation_time(p[2]),
        flow_index(p[3]),
        transition(p[4]) {}

  HOST_DEVICE Real viscosity(Real shear_rate) const {
    const Real x = relaxation_time * shear_rate;
    const Real slope = (flow_index - 1) / transition;
    // For fast shear x^a is taken out of the bracket, which would overflow.
    const Real thinning = x > 1 ? std::pow(x, flow_index - 1) * std::pow(1 + std::pow(x, -transition), slope)
                                : std::pow(1 + std::pow(x, transition), slope);
    return infinite_shear_viscosity + (zero_shear_viscosity - infinite_shear_viscosity) * thinning;
  }
  HOST_DEVICE bool yielded(Real /*stress*/) const { return true; }
};

}  // namespace slagflow
