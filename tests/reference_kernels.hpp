// The smoothing functions of the oracle, by their definitions and the product rule, in double precision; what
// normalises them is integrated numerically.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace reference {

constexpr double pi = 3.14159265358979323846;

enum class Kernel { level, lucy, wendland_c2, wendland_c4, quintic_spline };
enum class Weight { lattice, value, gradient };  // of the viscous operator

// A function of q = r/h before it is normalised, and its derivative.
struct Shape {
  double value = 0, slope = 0;
};

// Sum of a t^k, t = 1 - q^2.
template <std::size_t n>
Shape polynomial(double q, const std::pair<int, double> (&terms)[n]) {
  Shape s;
  const double t = 1 - q * q;
  for (const auto& [k, a] : terms) {
    s.value += a * std::pow(t, k);
    s.slope += -2 * q * a * k * std::pow(t, k - 1);
  }
  return s;
}

inline Shape shape(Kernel kernel, double q) {
  if (q >= 1) return {};
  const double p = 1 - q;
  switch (kernel) {
    case Kernel::lucy:
      return {(1 + 3 * q) * std::pow(p, 3), 3 * std::pow(p, 3) - 3 * (1 + 3 * q) * std::pow(p, 2)};
    case Kernel::wendland_c2:
      return {std::pow(p, 4) * (4 * q + 1), 4 * std::pow(p, 4) - 4 * std::pow(p, 3) * (4 * q + 1)};
    case Kernel::wendland_c4: {
      const double c = 1 + 6 * q + 35 * q * q / 3;
      return {std::pow(p, 6) * c, std::pow(p, 6) * (6 + 70 * q / 3) - 6 * std::pow(p, 5) * c};
    }
    case Kernel::quintic_spline: {
      Shape s;
      const double factors[3] = {1, -6, 15};
      for (int k = 0; k < 3; ++k) {
        const double rest = std::max(0.0, 3 - k - 3 * q);
        s.value += factors[k] * std::pow(rest, 5), s.slope -= 15 * factors[k] * std::pow(rest, 4);
      }
      return s;
    }
    case Kernel::level:
      break;
  }
  return polynomial(q, {{3, 0.0149}, {5, 0.1973}, {7, 0.3938}, {9, 0.3312}, {12, 0.0627}});
}

// 4 t^3 - 3 t^4, of pairs under tension.
inline Shape flat_shape(double q) { return q < 1 ? polynomial(q, {{3, 4.0}, {4, -3.0}}) : Shape{}; }
inline double lattice_shape(double q) {
  return q < 1 ? polynomial(q, {{2, 0.0155}, {4, 0.1471}, {5, 0.2673}, {7, 0.0897}, {8, 0.4804}}).value : 0;
}

// Integral of f(q) q^power over the ball of radius 1, by the midpoint rule.
template <class F>
double over_ball(F f, int dimensions, int power) {
  constexpr int shells = 4000;
  double sum = 0;
  for (int k = 0; k < shells; ++k) {
    const double q = (k + 0.5) / shells;
    sum += f(q) * std::pow(q, power + dimensions - 1) / shells;
  }
  return sum * (dimensions == 2 ? 2 * pi : 4 * pi);
}

// `number` stands for the function among those that are kept.
template <class F>
double kept_integral(int number, int dimensions, int power, F f) {
  static std::map<std::pair<int, int>, double> known;
  const std::pair<int, int> key{number, 10 * dimensions + power};
  if (known.count(key) == 0) known[key] = over_ball(f, dimensions, power);
  return known[key];
}

// W and dW/dr; zero from r = h on.
struct SmoothingFunction {
  Kernel kernel;
  double h;
  int dimensions;

  double value(double r) const { return shape(kernel, r / h).value / (norm() * std::pow(h, dimensions)); }
  double slope(double r) const { return shape(kernel, r / h).slope / (norm() * std::pow(h, dimensions + 1)); }
  double norm() const {
    return kept_integral(static_cast<int>(kernel), dimensions, 0,
                         [&](double q) { return shape(kernel, q).value; });
  }
};

// dW/dr of pairs under tension.
inline double flat_slope(double r, double h, int dimensions) {
  const double norm = kept_integral(-1, dimensions, 0, [](double q) { return flat_shape(q).value; });
  return flat_shape(r / h).slope / (norm * std::pow(h, dimensions + 1));
}

// w, normalised so that (d + 2) times the integral of w x^2 y^2 is one.
inline double lattice_weight(double r, double h, int dimensions) {
  const double fourth = kept_integral(-2, dimensions, 4, lattice_shape);
  return lattice_shape(r / h) * dimensions / (fourth * std::pow(h, dimensions + 4));
}
inline double value_weight(Kernel kernel, double r, double h, int dimensions) {
  const auto function = [&](double q) { return shape(kernel, q).value; };
  const double fourth = kept_integral(static_cast<int>(kernel), dimensions, 4, function);
  return function(r / h) * dimensions / (fourth * std::pow(h, dimensions + 4));
}

}  // namespace reference
