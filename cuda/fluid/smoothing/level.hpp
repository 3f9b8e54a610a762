// A smoothing function for which particle lattices have no energy of their own, so that they do not resist
// shear under pressure; with t = 1 - (r/h)^2:
//   W h^d = sigma (a3 t^3 + a5 t^5 + a7 t^7 + a9 t^9 + a12 t^12)
// The sum of V W over a lattice differs from one by the Fourier transform of W at its reciprocal lattice, and
// times the pressure that is an energy whose slope in shear acts as a friction (cuda/README.md).
// The coefficients make it least over sheared and stretched lattices at h = 2.6 spacings (scripts/smoothing).
#pragma once

#include "backend/lanes.hpp"
#include "fluid/math.hpp"

namespace slagflow {

struct Level {
  static constexpr double a3 = 0.0149, a5 = 0.1973, a7 = 0.3938, a9 = 0.3312, a12 = 0.0627;

  // The integral of t^k: pi/(k+1) in 2-D; 2 pi B(3/2, k+1) in 3-D.
  static constexpr double integral(int k, int dimensions) {
    const double pi = 3.14159265358979323846;
    if (dimensions == 2) return pi / (k + 1);
    double beta = 2.0 / 3;  // B(3/2, 1)
    for (int n = 1; n <= k; ++n) beta *= n / (n + 1.5);
    return 2 * pi * beta;
  }
  static constexpr double sigma(int d) {
    return 1 / (a3 * integral(3, d) + a5 * integral(5, d) + a7 * integral(7, d) + a9 * integral(9, d) +
                a12 * integral(12, d));
  }
  template <class T>
  HOST_DEVICE static T value(T q2) {
    const T t = T(1) - q2, t2 = square(t), t3 = t * t2;
    return t3 * (Real(a3) + t2 * (Real(a5) + t2 * (Real(a7) + t2 * (Real(a9) + Real(a12) * t3))));
  }
  template <class T>
  HOST_DEVICE static T slope(T q2) {
    const T t = T(1) - q2, t2 = square(t), t3 = t * t2;
    return t2 * (Real(-6 * a3) + t2 * (Real(-10 * a5) +
                                       t2 * (Real(-14 * a7) + t2 * (Real(-18 * a9) + Real(-24 * a12) * t3))));
  }
};

// A weight of velocity differences for the viscous operator: v2 t^2 + v4 t^4 + v5 t^5 + v7 t^7 + v8 t^8 times
// a constant. Lattices at rest and sliding rows have with it the viscosity of the fluid within 0.3 % in every
// direction at h = 2.6 spacings (scripts/smoothing).
struct LatticeWeight {
  static constexpr double v2 = 0.0155, v4 = 0.1471, v5 = 0.2673, v7 = 0.0897, v8 = 0.4804;

  template <class T>
  HOST_DEVICE static T value(T q2) {
    const T t = T(1) - q2, t2 = square(t);
    return t2 * (Real(v2) + t2 * (Real(v4) + t * (Real(v5) + t2 * (Real(v7) + Real(v8) * t))));
  }
};

}  // namespace slagflow
