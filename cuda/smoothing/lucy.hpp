// Lucy's smoothing function, equation (1), with h the support radius and q = r/h < 1:
//   W = sigma (1 + 3q)(1 - q)^3,  sigma = 5/(pi h^2) in 2-D, 105/(16 pi h^3) in 3-D   [1/m^2, 1/m^3]
// L. B. Lucy, Astron. J. 82 (1977) 1013.
#pragma once

#include "math.hpp"

namespace slagflow {

struct Lucy {
  Real support;        // h [m]
  Real inverse;        // 1/h
  Real normalisation;  // sigma
  Real slope;          // -12 sigma / h^2

  Lucy(double h, int dimensions) {
    const double pi = 3.14159265358979323846;
    const double sigma = dimensions == 2 ? 5 / (pi * h * h) : 105 / (16 * pi * h * h * h);
    support = static_cast<Real>(h);
    inverse = static_cast<Real>(1 / h);
    normalisation = static_cast<Real>(sigma);
    slope = static_cast<Real>(-12 * sigma / (h * h));
  }

  HOST_DEVICE Real value(Real r) const {
    const Real q = r * inverse;
    return q < 1 ? normalisation * (1 + 3 * q) * (1 - q) * square(1 - q) : Real(0);
  }

  // F = (1/r) dW/dr, so that grad W = F x_ij. Finite at r = 0; for r < h only.
  HOST_DEVICE Real gradient(Real r) const { return slope * square(1 - r * inverse); }
};

}  // namespace slagflow
