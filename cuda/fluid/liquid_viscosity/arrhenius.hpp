// Viscosity of a liquid that flows by jumps over a barrier of one height:
//   eta = A exp(B / T)   [Pa s], A [Pa s], B = E/R [K]
// S. Arrhenius, Z. Phys. Chem. 4 (1889) 226.
#pragma once

#include <cmath>

namespace slagflow {

// Natural logarithm of the viscosity [Pa s] at a temperature [K].
inline double log_arrhenius(double log_a, double b, double temperature) { return log_a + b / temperature; }

}  // namespace slagflow
