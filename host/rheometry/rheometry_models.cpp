#include "host/rheometry/rheometry_models.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "backend/error.hpp"

namespace slagflow {
namespace {

constexpr double pi = 3.14159265358979323846;

double rate_at(const FlowParameters& f, double stress) {
  return stress > f.yield_stress ? std::pow((stress - f.yield_stress) / f.consistency, 1 / f.flow_index) : 0;
}

struct Workspace {
  static constexpr std::size_t intervals = 200;
  std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> memory{
      gsl_integration_workspace_alloc(intervals), &gsl_integration_workspace_free};
};

double rate_at_logarithm(double log_stress, void* parameters) {
  return rate_at(*static_cast<const FlowParameters*>(parameters), std::exp(log_stress));
}

// 1/2 int rate(tau) dtau/tau, in the logarithm of tau.
double integral(FlowParameters f, double from, double to) {
  if (!(from < to)) return 0;
  static thread_local Workspace workspace;
  const gsl_function integrand{&rate_at_logarithm, &f};
  constexpr double accuracy = 1e-10;
  double value = 0, error = 0;
  const int status = gsl_integration_qags(&integrand, std::log(from), std::log(to), 0, accuracy,
                                          Workspace::intervals, workspace.memory.get(), &value, &error);
  // Roundoff keeps a result that is as good as this from the asked accuracy.
  if (status != GSL_SUCCESS && !(error < 1e-6 * std::abs(value)))
    throw Error(std::string("the flow between the cylinders could not be integrated: ") +
                gsl_strerror(status));
  return value / 2;
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
