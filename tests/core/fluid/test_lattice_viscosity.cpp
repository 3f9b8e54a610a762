// The correction of the viscous operators against sums over particles.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "fluid/constants.hpp"
#include "fluid/lattice_viscosity.hpp"

namespace slagflow {
namespace {

using testing_tools::Random;

constexpr PairWeighting pairs_of[] = {{SmoothingKind::level, ViscousWeight::lattice},
                                      {SmoothingKind::level, ViscousWeight::value},
                                      {SmoothingKind::lucy, ViscousWeight::gradient}};

// Of a support of 1.
double weight_of(const PairWeighting& pairs, double r, int dimensions) {
  const auto kernel = static_cast<reference::Kernel>(pairs.kernel);
  if (pairs.weight == ViscousWeight::lattice) return reference::lattice_weight(r, 1, dimensions);
  if (pairs.weight == ViscousWeight::value) return reference::value_weight(kernel, r, 1, dimensions);
  return -reference::SmoothingFunction{kernel, 1, dimensions}.slope(r) / (r * r * r);
}

// Mean over random positions of the layers of the sum that a sheared particle sees.
double sum_over_sliding_layers(ViscousOperator kind, const PairWeighting& pairs, double ratio,
                               int dimensions) {
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
          const double weight = volume * weight_of(pairs, std::sqrt(r2), dimensions);
          sum += kind == ViscousOperator::radial ? weight * (dimensions + 2) * x * x * y * y
                                                 : weight * r2 * y * y;
        }
    }
  return sum / samples;
}

TEST(LatticeViscosity, IsTheMeanOverSlidingLayers) {
  for (const int dimensions : {2, 3})
    for (const double ratio : {2.1, 2.6, 3.1})
      for (const auto kind : {ViscousOperator::radial, ViscousOperator::laplacian})
        // Standard error of 4000 samples: below 0.1 %.
        for (const PairWeighting& pairs : pairs_of)
          EXPECT_NEAR(lattice_viscosity(kind, pairs, ratio, dimensions),
                      sum_over_sliding_layers(kind, pairs, ratio, dimensions), 0.004)
              << dimensions << "-D, support ratio " << ratio;
}

TEST(LatticeViscosity, TendsToOneAsTheSupportGrows) {
  for (const int dimensions : {2, 3})
    for (const auto kind : {ViscousOperator::radial, ViscousOperator::laplacian})
      for (const PairWeighting& pairs : pairs_of)
        EXPECT_NEAR(lattice_viscosity(kind, pairs, 20, dimensions), 1, 1e-3);
}

TEST(LatticeViscosity, GivesTheCorrectionUnlessOneIsGiven) {
  SimulationSetup setup;  // h = 2.6 spacings in 3-D
  EXPECT_NEAR(viscosity_correction(setup), 1, 0.001);
  setup.numerics.kernel = SmoothingKind::lucy, setup.numerics.viscous_weight = ViscousWeight::gradient;
  EXPECT_NEAR(viscosity_correction(setup), 1.047, 0.001);
  setup.numerics.viscosity_correction = 1.2;
  EXPECT_EQ(viscosity_correction(setup), 1.2);
}

}  // namespace
}  // namespace slagflow
