// Lucy's smoothing function, equation (1), with h the support radius and q = r/h < 1:
//   W = sigma (1 + 3q)(1 - q)^3,  sigma = 5/(pi h^2) in 2-D, 105/(16 pi h^3) in 3-D   [1/m^2, 1/m^3]
// L. B. Lucy, Astron. J. 82 (1977) 1013.
#pragma once

#include "backend/lanes.hpp"
#include "fluid/math.hpp"

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

  // T: Real or Lanes.
  template <class T>
  HOST_DEVICE T value(T r) const {
    const T q = r * inverse, one = Real(1);
    return select(q < one, normalisation * (one + Real(3) * q) * (one - q) * square(one - q), T(0));
  }

  // F = (1/r) dW/dr, so that grad W = F x_ij. Finite at r = 0; for r < h only.
  template <class T>
  HOST_DEVICE T gradient(T r) const {
    return slope * square(Real(1) - r * inverse);
  }
};

}  // namespace slagflow
