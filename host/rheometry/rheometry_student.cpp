#include "host/rheometry/rheometry_student.hpp"

#include <cmath>

namespace slagflow {
namespace {

constexpr double half_pi = 1.57079632679489661923;

// P(|T| < t) with t = sqrt(degrees) tan(angle); finite sums for whole degrees of freedom.
// M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 26.7.3 and 26.7.4.
double probability_within(double angle, int degrees) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double sum = 0, term = odd ? cosine : 1;
  for (int k = odd ? 3 : 2; k <= degrees; k += 2) {
    sum += term;
    term *= cosine * cosine * (k - 1) / k;
  }
  return odd ? (angle + sine * sum) / half_pi : sine * sum;
}

}  // namespace

double student_95(int degrees) {
  double low = 0, high = half_pi;
  for (int k = 0; k < 60; ++k) {
    const double angle = (low + high) / 2;
    (probability_within(angle, degrees) < 0.95 ? low : high) = angle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan((low + high) / 2);
}

}  // namespace slagflow
