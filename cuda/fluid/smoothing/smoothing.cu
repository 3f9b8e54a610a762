#include "fluid/smoothing/smoothing.hpp"

namespace slagflow {

namespace {

// Of Law::value q^n over the ball of radius 1.
template <class Law>
double integral(Law, int dimensions, int n) {
  constexpr int intervals = 600;  // Simpson's rule; the knots of splines of three pieces are among its points
  double sum = 0;
  for (int k = 0; k <= intervals; ++k) {
    const double q = static_cast<double>(k) / intervals;
    const double weight = k == 0 || k == intervals ? 1 : (k % 2 == 1 ? 4 : 2);
    const auto value = static_cast<double>(Law::value(static_cast<Real>(q * q)));
    sum += weight / (3 * intervals) * value * std::pow(q, n + dimensions - 1);
  }
  return 2 * (dimensions - 1) * 3.14159265358979323846 * sum;
}

// Of w r^4: d (d + 2) times that of w x^2 y^2.
double fourth_moment(SmoothingKind kind, int dimensions, ViscousWeight weight) {
  if (weight == ViscousWeight::lattice) return integral(LatticeWeight(), dimensions, 4);
  return visit(kind, [=](auto law) { return integral(law, dimensions, 4); });
}

}  // namespace

double moment(SmoothingKind kind, int dimensions, int n) {
  return visit(kind,
               [=](auto law) { return decltype(law)::sigma(dimensions) * integral(law, dimensions, n); });
}

Smoothing::Smoothing(SmoothingKind which, double h, int dimensions, ViscousWeight weight)
    : kind(which), viscous_weight(weight) {
  const double sigma = visit(kind, [=](auto law) { return decltype(law)::sigma(dimensions); });
  const double scale = sigma / std::pow(h, dimensions);
  support = static_cast<Real>(h);
  inverse_squared = static_cast<Real>(1 / (h * h));
  of_value = static_cast<Real>(scale);
  of_slope = static_cast<Real>(scale / (h * h));
  const double flat = 4 * Level::integral(3, dimensions) - 3 * Level::integral(4, dimensions);
  of_tension = static_cast<Real>(-24 / (flat * std::pow(h, dimensions + 2)));
  of_crowding = static_cast<Real>(-36 / (Level::integral(18, dimensions) * std::pow(h, dimensions + 2)));
  of_viscous =
      static_cast<Real>(dimensions / (std::pow(h, dimensions + 4) * fourth_moment(kind, dimensions, weight)));
  softening = static_cast<Real>(1e-6 * h * h);
}

}  // namespace slagflow
