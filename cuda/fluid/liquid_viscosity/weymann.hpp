// Viscosity of a silicate melt by the theory of holes, as G. Urbain, Steel Res. 58 (1987) 111 and P. V.
// Riboud et al., Fachber. Huettenprax. Metallweiterverarb. 19 (1981) 859 give it for slags:
//   eta = A T exp(B / T)   [Pa s], A [Pa s/K], B [K]
// H. D. Weymann, Kolloid-Z. 138 (1954) 41.
#pragma once

#include <cmath>

namespace slagflow {

// Natural logarithm of the viscosity [Pa s] at a temperature [K].
inline double log_weymann(double log_a, double b, double temperature) {
  return log_a + std::log(temperature) + b / temperature;
}

}  // namespace slagflow
