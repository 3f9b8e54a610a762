// Lucy's function against its definition, its integral and published lattice sums.
#include <gtest/gtest.h>

#include "fluid/smoothing/lucy.hpp"
#include "reference.hpp"

namespace slagflow {
namespace {

constexpr double h = 0.026;
constexpr double epsilon = sizeof(Real) == 4 ? 1.2e-7 : 2.3e-16;

double value(const Lucy& w, double r) { return static_cast<double>(w.value(static_cast<Real>(r))); }
double gradient(const Lucy& w, double r) { return static_cast<double>(w.gradient(static_cast<Real>(r))); }

class LucyIn : public testing::TestWithParam<int> {
 protected:
  int dimensions() const { return GetParam(); }
  Lucy w_{h, GetParam()};
};

// Midpoint rule over shells, which is second order: 1000 shells give 1e-6.
TEST_P(LucyIn, IntegratesToOne) {
  const int shells = 1000;
  double integral = 0;
  for (int k = 0; k < shells; ++k) {
    const double r = (k + 0.5) * h / shells;
    const double shell = dimensions() == 2 ? 2 * reference::pi * r : 4 * reference::pi * r * r;
    integral += value(w_, r) * shell * h / shells;
  }
  EXPECT_NEAR(integral, 1, 1e-5);
}

TEST_P(LucyIn, MatchesEquationOne) {
  const double scale = value(w_, 0);
  for (double q = 0; q < 1; q += 0.01)
    EXPECT_NEAR(value(w_, q * h), reference::lucy(q * h, h, dimensions()), 8 * epsilon * scale) << q;
}

TEST_P(LucyIn, GradientIsTheDerivativeOverTheDistance) {
  const double scale = std::fabs(gradient(w_, 0));
  for (double q = 0.02; q < 0.99; q += 0.01) {
    const double r = q * h, step = 1e-5 * h;
    const double slope =
        (reference::lucy(r + step, h, dimensions()) - reference::lucy(r - step, h, dimensions())) /
        (2 * step);
    // Central differences of W / h^2: their own error is about 1e-8 of the scale.
    EXPECT_NEAR(gradient(w_, r), slope / r, (8 * epsilon + 1e-7) * scale) << q;
    // The product rule loses digits near the origin.
    EXPECT_NEAR(gradient(w_, r), reference::lucy_slope(r, h, dimensions()) / r, (8 * epsilon + 1e-14) * scale)
        << q;
  }
}

TEST_P(LucyIn, GradientIsNegativeAndFiniteAtTheOrigin) {
  const double limit = -12 / (h * h) * reference::lucy(0, h, dimensions());
  EXPECT_NEAR(gradient(w_, 0) / limit, 1, 4 * epsilon);
}

TEST_P(LucyIn, VanishesFromTheSupportOn) {
  EXPECT_EQ(value(w_, 1.0001 * h), 0);
  EXPECT_EQ(value(w_, 50 * h), 0);
  EXPECT_GT(value(w_, 0.99 * h), 0);
  EXPECT_NEAR(value(w_, h), 0, 1e-12 * value(w_, 0));
}

INSTANTIATE_TEST_SUITE_P(, LucyIn, testing::Values(2, 3),
                         [](const auto& p) { return std::to_string(p.param) + "D"; });

// The constant of LAMMPS' pair style sph/taitwater: W'/r = -25.0669035369735 (h - r)^2 / h^7.
TEST(Lucy, GradientHasTheConstantOfLammps) {
  const Lucy w(h, 3);
  for (double q : {0.0, 0.3, 0.5, 0.9}) {
    const double wanted = -25.0669035369735 * std::pow(h - q * h, 2) / std::pow(h, 7);
    EXPECT_NEAR(gradient(w, q * h) / wanted, 1, 20 * epsilon / (1 - q));
  }
}

// Sums over a cubic lattice, as tabulated for supports of 2.1 to 3.5 spacings to three decimals.
struct LatticeSums {
  double partition = 0, laplacian = 0, radial = 0;

  explicit LatticeSums(double ratio) {
    const Lucy w(ratio, 3);
    for (int x = -3; x <= 3; ++x)
      for (int y = -3; y <= 3; ++y)
        for (int z = -3; z <= 3; ++z) {
          const double r2 = x * x + y * y + z * z, r = std::sqrt(r2);
          if (r >= ratio) continue;
          partition += value(w, r);
          if (r == 0) continue;
          laplacian += -gradient(w, r) * x * x;                // of u = x^2/2 by Brookshaw's operator
          radial += -5 * gradient(w, r) * x * x * z * z / r2;  // dissipation of the shear u = z along x
        }
  }
};

TEST(Lucy, LatticeSumsMatchTheTable) {
  struct Row {
    double ratio, partition, laplacian, radial;
  };
  for (const Row& row : {Row{2.1, 1.017, 1.022, 0.906}, Row{2.6, 0.998, 0.988, 0.927},
                         Row{3.1, 1.002, 0.999, 0.972}, Row{3.5, 1.000, 0.998, 0.989}}) {
    const LatticeSums sums(row.ratio);
    EXPECT_NEAR(sums.partition, row.partition, 6e-4) << row.ratio;
    EXPECT_NEAR(sums.laplacian, row.laplacian, 6e-4) << row.ratio;
    EXPECT_NEAR(sums.radial, row.radial, 6e-4) << row.ratio;
  }
}

}  // namespace
}  // namespace slagflow
