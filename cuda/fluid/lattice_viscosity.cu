#include "fluid/lattice_viscosity.hpp"

namespace slagflow {

namespace {

struct Layers {
  ViscousOperator kind;
  Smoothing smoothing;  // of a support of 1
  int dimensions;

  double integrand(double along, double across) const {
    const double r2 = square(along) + square(across);
    if (!(r2 < 1)) return 0;
    const auto weight = static_cast<double>(smoothing.viscous(static_cast<Real>(r2)));
    // In 3-D a ring of the layer: its circumference, and the mean of x^2 over it.
    const double measure = dimensions == 3 ? 3.14159265358979324 * along : 1;
    const double x2 = dimensions == 3 ? square(along) / 2 : square(along);
    const double factor = kind == ViscousOperator::laplacian ? r2 : (dimensions + 2) * x2;
    return measure * weight * factor * square(across);
  }
};

}  // namespace

double lattice_viscosity(ViscousOperator kind, const PairWeighting& pairs, double support_ratio,
                         int dimensions) {
  constexpr int intervals = 2000;
  const Layers layers{kind, Smoothing(pairs.kernel, 1, dimensions, pairs.weight), dimensions};
  const double spacing = 1 / support_ratio;
  double sum = 0;
  for (int layer = 1; layer * spacing < 1; ++layer) {
    // Simpson's rule over the part of the layer within the support.
    const double across = layer * spacing, reach = std::sqrt(1 - square(across)), step = reach / intervals;
    for (int k = 0; k <= intervals; ++k) {
      const double weight = k == 0 || k == intervals ? 1 : (k % 2 == 1 ? 4 : 2);
      sum += weight * step / 3 * layers.integrand(k * step, across);
    }
  }
  // Both sides of the flow line or ring, and the layers on both sides.
  return 4 * spacing * sum;
}

}  // namespace slagflow
