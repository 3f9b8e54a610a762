// The quintic B-spline, with s = 3 r/h < 3 and x+ = max(x, 0):
//   W h^d = sigma [(3 - s)^5 - 6 (2 - s)+^5 + 15 (1 - s)+^5]
// I. J. Schoenberg, Q. Appl. Math. 4 (1946) 45; J. P. Morris, PhD thesis, Monash University (1996).
#pragma once

#include "backend/lanes.hpp"
#include "fluid/math.hpp"

namespace slagflow {

struct QuinticSpline {
  static constexpr double sigma(int dimensions) {
    return dimensions == 2 ? 63 / (478 * 3.14159265358979323846) : 27 / (120 * 3.14159265358979323846);
  }
  template <class T>
  HOST_DEVICE static T value(T q2) {
    const T s = Real(3) * root(q2), a = T(3) - s, b = larger(T(2) - s, T(0)), c = larger(T(1) - s, T(0));
    return a * square(square(a)) - Real(6) * b * square(square(b)) + Real(15) * c * square(square(c));
  }
  // The derivative vanishes at the origin as -120 s: within s < 1 the polynomial is divided by s.
  template <class T>
  HOST_DEVICE static T slope(T q2) {
    const T s = Real(3) * root(q2), a = T(3) - s, b = larger(T(2) - s, T(0));
    const T outside = Real(-45) * (square(square(a)) - Real(6) * square(square(b))) / larger(s, T(1));
    const T inside = Real(9) * (T(-120) + square(s) * (T(120) - Real(50) * s));
    return select(s < T(1), inside, outside);
  }
};

}  // namespace slagflow
