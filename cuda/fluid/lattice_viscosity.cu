#include "fluid/lattice_viscosity.hpp"
#include "fluid/smoothing/lucy.hpp"

namespace slagflow {

namespace {

// Lengths in support radii.
double integrand(ViscousOperator kind, int dimensions, double along, double across) {
  const double r2 = square(along) + square(across);
  if (!(r2 < 1)) return 0;
  const double weight = -static_cast<double>(Lucy(1, dimensions).gradient(static_cast<Real>(std::sqrt(r2))));
  // In 3-D a ring of the layer: its circumference, and the mean of x^2 over it.
  const double measure = dimensions == 3 ? 3.14159265358979324 * along : 1;
  const double x2 = dimensions == 3 ? square(along) / 2 : square(along);
  if (kind == ViscousOperator::laplacian) return measure * weight * square(across);
  return measure * weight * (dimensions + 2) * x2 * square(across) / larger(r2, 1e-300);
}

}  // namespace

double lattice_viscosity(ViscousOperator kind, double support_ratio, int dimensions) {
  constexpr int intervals = 2000;
  const double spacing = 1 / support_ratio;
  double sum = 0;
  for (int layer = 1; layer * spacing < 1; ++layer) {
    // Simpson's rule over the part of the layer within the support.
    const double across = layer * spacing, reach = std::sqrt(1 - square(across)), step = reach / intervals;
    for (int k = 0; k <= intervals; ++k) {
      const double weight = k == 0 || k == intervals ? 1 : (k % 2 == 1 ? 4 : 2);
      sum += weight * step / 3 * integrand(kind, dimensions, k * step, across);
    }
  }
  // Both sides of the flow line or ring, and the layers on both sides.
  return 4 * spacing * sum;
}

}  // namespace slagflow
