#include "host/rheometry/rheometry_models.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "backend/error.hpp"

namespace slagflow {
namespace {

constexpr double pi = 3.14159265358979323846;

double rate_at(const FlowParameters& f, double stress) {
  return stress > f.yield_stress ? std::pow((stress - f.yield_stress) / f.consistency, 1 / f.flow_index) : 0;
}

// A point of the tanh-sinh rule on (0, 1): x = 1/(1 + e^(-pi sinh t)), dx/dt. The map takes away the singular
// slope where a fluid begins to yield, at x = 0.
struct Node {
  double x, slope;
};
// Those at steps of 1/4 in t, then those half-way between, and so on.
constexpr double first_step = 0.25, end = 3.25;  // e^(-pi sinh 3.25) = 3e-18
constexpr int levels = 7;
using Rule = std::array<std::vector<Node>, levels>;

Rule tanh_sinh() {
  Rule rule;
  for (int level = 0; level < levels; ++level) {
    const double step = std::ldexp(first_step, -level);
    for (int k = 1; k * step < 2 * end; k += level == 0 ? 1 : 2) {
      const double t = k * step - end, e = std::exp(-pi * std::sinh(t));
      rule[static_cast<std::size_t>(level)].push_back(
          {1 / (1 + e), pi * std::cosh(t) * e / ((1 + e) * (1 + e))});
    }
  }
  return rule;
}

// 1/2 int rate(tau) dtau/tau, over x in tau = from (to/from)^x. A level doubles the digits of the one before.
double integral(const FlowParameters& f, double from, double to) {
  if (!(from < to)) return 0;
  static const Rule rule = tanh_sinh();
  constexpr double enough = 1e-6;  // leaves some 1e-12 to the last level
  const double length = std::log(to / from), to_yield = from - f.yield_stress;
  double sum = 0, value = 0, change = 0, step = first_step;
  for (const std::vector<Node>& level : rule) {
    for (const Node& node : level) {
      const double excess = to_yield + from * std::expm1(length * node.x);
      sum += node.slope * std::pow(excess / f.consistency, 1 / f.flow_index);
    }
    change = std::abs(sum * step - value), value = sum * step, step /= 2;
    if (change <= enough * value) return length * value / 2;
  }
  throw Error("the flow between the cylinders could not be integrated");
}

}  // namespace

const char* name_of(FlowModel model) {
  constexpr std::array<const char*, 3> names{"newtonian", "bingham", "herschel-bulkley"};
  return names[static_cast<std::size_t>(model)];
}

double Cylinders::bob_stress(double torque) const {
  return torque / (2 * pi * bob_radius * bob_radius * height);
}

double Cylinders::nominal_rate(double omega) const { return 2 * omega / (1 - ratio() * ratio()); }

double shear_stress(const FlowParameters& f, double rate) {
  return f.yield_stress + f.consistency * std::pow(rate, f.flow_index);
}

double rotation(const FlowParameters& f, const Cylinders& c, double bob_stress) {
  const double cup_stress = bob_stress * c.ratio() * c.ratio();
  const double least = std::max(cup_stress, f.yield_stress);
  if (f.flow_index == 1)
    return (bob_stress - least - f.yield_stress * std::log(bob_stress / least)) / (2 * f.consistency);
  return integral(f, least, bob_stress);
}

// Newton's method, kept within a bracket. The rotation grows with the stress.
double bob_stress(const FlowParameters& f, const Cylinders& c, double omega) {
  double low = std::max(f.yield_stress, 0.0), high = 2 * low + f.consistency;
  while (rotation(f, c, high) < omega) low = high, high *= 2;
  const double kappa2 = c.ratio() * c.ratio();
  double stress = (low + high) / 2;
  for (int k = 0; k < 200; ++k) {
    const double excess = rotation(f, c, stress) - omega;
    (excess < 0 ? low : high) = stress;
    const double slope = (rate_at(f, stress) - rate_at(f, kappa2 * stress)) / (2 * stress);
    double next = stress - excess / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - stress) <= 1e-12 * stress) return next;
    stress = next;
  }
  return stress;
}

}  // namespace slagflow
