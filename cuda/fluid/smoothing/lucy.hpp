// Lucy's smoothing function, equation (1), with q = r/h < 1:  W h^d = sigma (1 + 3q)(1 - q)^3
// L. B. Lucy, Astron. J. 82 (1977) 1013.
#pragma once

#include "backend/lanes.hpp"
#include "fluid/math.hpp"

namespace slagflow {

// Every law has these three: sigma; W h^d / sigma and (1/q) d/dq of it at q^2 < 1. T: Real or Lanes.
struct Lucy {
  static constexpr double sigma(int dimensions) {
    return dimensions == 2 ? 5 / 3.14159265358979323846 : 105 / (16 * 3.14159265358979323846);
  }
  template <class T>
  HOST_DEVICE static T value(T q2) {
    const T q = root(q2), one = Real(1);
    return (one + Real(3) * q) * (one - q) * square(one - q);
  }
  template <class T>
  HOST_DEVICE static T slope(T q2) {
    return Real(-12) * square(T(1) - root(q2));
  }
};

}  // namespace slagflow
