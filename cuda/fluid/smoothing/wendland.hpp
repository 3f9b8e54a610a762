// Wendland's functions, with q = r/h < 1:
//   C2  W h^d = sigma (1 - q)^4 (1 + 4q)
//   C4  W h^d = sigma (1 - q)^6 (1 + 6q + 35/3 q^2)
// H. Wendland, Adv. Comput. Math. 4 (1995) 389; W. Dehnen, H. Aly, Mon. Not. R. Astron. Soc. 425 (2012) 1068.
#pragma once

#include "backend/lanes.hpp"
#include "fluid/math.hpp"

namespace slagflow {

struct WendlandC2 {
  static constexpr double sigma(int dimensions) {
    return dimensions == 2 ? 7 / 3.14159265358979323846 : 21 / (2 * 3.14159265358979323846);
  }
  template <class T>
  HOST_DEVICE static T value(T q2) {
    const T q = root(q2), one = Real(1);
    return square(square(one - q)) * (one + Real(4) * q);
  }
  template <class T>
  HOST_DEVICE static T slope(T q2) {
    const T rest = T(1) - root(q2);
    return Real(-20) * rest * square(rest);
  }
};

struct WendlandC4 {
  static constexpr double sigma(int dimensions) {
    return dimensions == 2 ? 9 / 3.14159265358979323846 : 495 / (32 * 3.14159265358979323846);
  }
  template <class T>
  HOST_DEVICE static T value(T q2) {
    const T q = root(q2), one = Real(1), cube = (one - q) * square(one - q);
    return square(cube) * (one + Real(6) * q + (Real(35) / Real(3)) * q2);
  }
  template <class T>
  HOST_DEVICE static T slope(T q2) {
    const T q = root(q2), one = Real(1), rest = one - q;
    return (Real(-56) / Real(3)) * (one + Real(5) * q) * rest * square(square(rest));
  }
};

}  // namespace slagflow
