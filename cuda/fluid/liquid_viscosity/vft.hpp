// Viscosity of a melt that turns to glass:
//   eta = A exp(B / (T - T_0))   [Pa s], A [Pa s], B, T_0 [K], for T > T_0
// H. Vogel, Phys. Z. 22 (1921) 645; G. S. Fulcher, J. Am. Ceram. Soc. 8 (1925) 339; G. Tammann and W. Hesse,
// Z. Anorg. Allg. Chem. 156 (1926) 245.
#pragma once

#include <cmath>

namespace slagflow {

// Natural logarithm of the viscosity [Pa s] at a temperature [K]; it grows without bound towards T_0.
inline double log_vft(double log_a, double b, double t0, double temperature) {
  constexpr double closest = 1e-3;  // [K]
  return log_a + b / std::fmax(temperature - t0, closest);
}

}  // namespace slagflow
