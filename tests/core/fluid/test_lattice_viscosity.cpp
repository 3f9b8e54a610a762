// The correction of the viscous operators against sums over particles.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "fluid/constants.hpp"
#include "fluid/lattice_viscosity.hpp"

namespace slagflow {
namespace {

using testing_tools::Random;

// Lucy's function with h = 1: F = (1/r) dW/dr.
double slope_over_r(double r, int dimensions) {
  const double pi = 3.14159265358979323846;
  const double sigma = dimensions == 2 ? 5 / pi : 105 / (16 * pi);
  return -12 * sigma * (1 - r) * (1 - r);
}

// Mean over random positions of the layers of the sum that a sheared particle sees.
double sum_over_sliding_layers(ViscousOperator kind, double ratio, int dimensions) {
  const double dx = 1 / ratio, volume = dimensions == 3 ? dx * dx * dx : dx * dx;
  const int reach = static_cast<int>(ratio) + 2, samples = 4000;
  Random random(3);
  double sum = 0;
  for (int sample = 0; sample < samples; ++sample)
    for (int layer = -reach; layer <= reach; ++layer) {
      if (layer == 0) continue;  // no velocity difference within the own layer
      const double shift_x = random.uniform(0, dx), shift_z = random.uniform(0, dx), y = layer * dx;
      for (int i = -reach; i <= reach; ++i)
        for (int k = dimensions == 3 ? -reach : 0; k <= (dimensions == 3 ? reach : 0); ++k) {
          const double x = i * dx + shift_x, z = dimensions == 3 ? k * dx + shift_z : 0;
          const double r2 = x * x + y * y + z * z;
          if (r2 >= 1) continue;
          const double weight = -volume * slope_over_r(std::sqrt(r2), dimensions);
          sum += kind == ViscousOperator::radial ? weight * (dimensions + 2) * x * x * y * y / r2
                                                 : weight * y * y;
        }
    }
  return sum / samples;
}

TEST(LatticeViscosity, IsTheMeanOverSlidingLayers) {
  for (const int dimensions : {2, 3})
    for (const double ratio : {2.1, 2.6, 3.1})
      for (const auto kind : {ViscousOperator::radial, ViscousOperator::laplacian})
        // Standard error of 4000 samples: below 0.1 %.
        EXPECT_NEAR(lattice_viscosity(kind, ratio, dimensions),
                    sum_over_sliding_layers(kind, ratio, dimensions), 0.004)
            << dimensions << "-D, support ratio " << ratio;
}

TEST(LatticeViscosity, TendsToOneAsTheSupportGrows) {
  for (const int dimensions : {2, 3})
    for (const auto kind : {ViscousOperator::radial, ViscousOperator::laplacian})
      EXPECT_NEAR(lattice_viscosity(kind, 20, dimensions), 1, 1e-3);
}

TEST(LatticeViscosity, GivesTheCorrectionUnlessOneIsGiven) {
  SimulationSetup setup;
  EXPECT_NEAR(viscosity_correction(setup), 1.047, 0.001);  // h = 2.6 spacings in 3-D
  setup.numerics.viscosity_correction = 1.2;
  EXPECT_EQ(viscosity_correction(setup), 1.2);
}

}  // namespace
}  // namespace slagflow
