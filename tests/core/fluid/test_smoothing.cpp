// The smoothing functions against their definitions, their integrals, Fourier transforms and lattice sums.
#include <gtest/gtest.h>

#include <algorithm>

#include "fluid/smoothing/smoothing.hpp"
#include "reference_kernels.hpp"

namespace slagflow {
namespace {

constexpr double h = 0.026;
constexpr double epsilon = sizeof(Real) == 4 ? 1.2e-7 : 2.3e-16;

struct Which {
  SmoothingKind kind;
  int dimensions;
};

class SmoothingIn : public testing::TestWithParam<Which> {
 protected:
  int dimensions() const { return GetParam().dimensions; }
  double value(double r) const { return static_cast<double>(w_.value(static_cast<Real>(r * r))); }
  double gradient(double r) const { return static_cast<double>(w_.gradient(static_cast<Real>(r * r))); }
  reference::SmoothingFunction wanted() const {
    return {static_cast<reference::Kernel>(GetParam().kind), h, dimensions()};
  }
  Smoothing w_{GetParam().kind, h, GetParam().dimensions};
};

// Rounding of q^2 grows by the slope of W; the coefficients of a law are given to their last digit.
TEST_P(SmoothingIn, MatchesItsDefinition) {
  const double scale = value(0);
  for (double q = 0.005; q < 1; q += 0.01)
    EXPECT_NEAR(value(q * h), wanted().value(q * h), (60 * epsilon + 1e-6) * scale) << q;
}

TEST_P(SmoothingIn, GradientIsTheDerivativeOverTheDistance) {
  const double scale = std::fabs(gradient(0.1 * h));
  for (double q = 0.01; q < 1; q += 0.01)
    EXPECT_NEAR(gradient(q * h), wanted().slope(q * h) / (q * h), (200 * epsilon + 1e-6) * scale) << q;
}

TEST_P(SmoothingIn, GradientIsNegativeAndFiniteAtTheOrigin) {
  EXPECT_LT(gradient(0), 0);
  EXPECT_NEAR(gradient(0) / gradient(1e-3 * h), 1, 0.02);
}

TEST_P(SmoothingIn, VanishesFromTheSupportOn) {
  for (const double q : {1.0001, 2.0, 50.0, 1e6}) {
    EXPECT_EQ(value(q * h), 0) << q;
    EXPECT_EQ(gradient(q * h), 0) << q;
    EXPECT_EQ(w_.viscous(static_cast<Real>(q * h * q * h)), 0) << q;
    EXPECT_EQ(w_.tension_gradient(static_cast<Real>(q * h * q * h)), 0) << q;
  }
  EXPECT_GT(value(0.95 * h), 0);
}

TEST_P(SmoothingIn, MomentsAreThoseOfTheDefinition) {
  EXPECT_NEAR(moment(GetParam().kind, dimensions(), 0), 1, 2e-6);
  const auto kernel = static_cast<reference::Kernel>(GetParam().kind);
  const double fourth =
      reference::over_ball([&](double q) { return reference::shape(kernel, q).value; }, dimensions(), 4) /
      wanted().norm();
  EXPECT_NEAR(moment(GetParam().kind, dimensions(), 4), fourth, 2e-6);
}

// All weights of velocity differences carry the viscosity: (d + 2) int w x^2 y^2 = 1.
TEST_P(SmoothingIn, ViscousWeightsAreNormalised) {
  for (const auto weight : {ViscousWeight::lattice, ViscousWeight::value, ViscousWeight::gradient}) {
    const Smoothing w(GetParam().kind, 1, dimensions(), weight);
    const double fourth = reference::over_ball(
        [&](double q) { return static_cast<double>(w.viscous(static_cast<Real>(q * q))); }, dimensions(), 4);
    EXPECT_NEAR(fourth / dimensions(), 1, 2e-5) << static_cast<int>(weight);
  }
}

std::vector<Which> all_functions() {
  std::vector<Which> all;
  for (std::size_t k = 0; k < smoothing_names.size(); ++k)
    for (const int d : {2, 3}) all.push_back({static_cast<SmoothingKind>(k), d});
  return all;
}

INSTANTIATE_TEST_SUITE_P(, SmoothingIn, testing::ValuesIn(all_functions()), [](const auto& p) {
  std::string name = smoothing_names[static_cast<std::size_t>(p.param.kind)];
  std::replace(name.begin(), name.end(), '-', '_');
  return name + "_" + std::to_string(p.param.dimensions) + "D";
});

// Fourier transform at wave number k, of a support of 1: a sum over shells.
template <class F>
double transform(F value, int dimensions, double k) {
  return reference::over_ball(
      [&](double q) {
        const double x = k * q;
        return value(q) * (dimensions == 2 ? std::cyl_bessel_j(0, x) : (x > 0 ? std::sin(x) / x : 1));
      },
      dimensions, 0);
}

double law_transform(SmoothingKind kind, int dimensions, double ratio, double k_spacing) {
  const Smoothing w(kind, 1, dimensions);
  return transform([&](double q) { return static_cast<double>(w.value(static_cast<Real>(q * q))); },
                   dimensions, k_spacing * ratio);
}

// At a wave of two spacings with h = 2.6 spacings; figures by the integrals of another program
// (scripts/smoothing).
TEST(Smoothing, TransformsAreThoseOfTheFunctions) {
  EXPECT_NEAR(law_transform(SmoothingKind::lucy, 2, 2.6, reference::pi), 0.018, 1e-3);
  EXPECT_NEAR(law_transform(SmoothingKind::wendland_c2, 2, 2.6, reference::pi), 0.079, 1e-3);
  EXPECT_NEAR(law_transform(SmoothingKind::quintic_spline, 2, 2.6, reference::pi), 0.148, 1e-3);
  EXPECT_NEAR(law_transform(SmoothingKind::level, 2, 2.6, reference::pi), 0.126, 1e-3);
}

// Nowhere below zero, or particles would pair; Lucy's is.
TEST(Smoothing, LevelDoesNotPair) {
  for (const int d : {2, 3}) {
    double least = 1, lucy = 1;
    for (double k = 1; k < 12; k += 0.05) {
      least = std::min(least, law_transform(SmoothingKind::level, d, 2.6, k));
      lucy = std::min(lucy, law_transform(SmoothingKind::lucy, d, 2.6, k));
    }
    EXPECT_GT(least, -3e-5) << d;
    if (d == 3) {
      EXPECT_LT(lucy, -1e-3);
    }
  }
}

// Particles under tension are drawn together by waves of two spacings where the transform is positive there.
TEST(Smoothing, PairsUnderTensionSpread) {
  for (const int d : {2, 3}) {
    const Smoothing w(SmoothingKind::level, 1, d);

    const double norm =
        1 / reference::kept_integral(-1, d, 0, [](double q) { return reference::flat_shape(q).value; });
    const double at_two =
        transform([&](double q) { return norm * reference::flat_shape(q).value; }, d, 2.6 * reference::pi);
    EXPECT_LT(at_two, -0.03) << d;
    for (double q = 0.05; q < 1; q += 0.1)
      EXPECT_NEAR(static_cast<double>(w.tension_gradient(static_cast<Real>(q * q))),
                  reference::flat_slope(q, 1, d) / q, 1e-4)
          << q;
  }
}

// The constant of LAMMPS' pair style sph/taitwater: W'/r = -25.0669035369735 (h - r)^2 / h^7.
TEST(Smoothing, LucysGradientHasTheConstantOfLammps) {
  const Smoothing w(SmoothingKind::lucy, h, 3);
  for (double q : {0.0, 0.3, 0.5, 0.9}) {
    const double wanted = -25.0669035369735 * std::pow(h - q * h, 2) / std::pow(h, 7);
    const double found = static_cast<double>(w.gradient(static_cast<Real>(q * h * q * h)));
    EXPECT_NEAR(found / wanted, 1, 20 * epsilon / (1 - q));
  }
}

// What particles on a lattice of spacing 1 make of one, of a gradient and of the energy of compression, as it
// is sheared by g: S = sum W, x the direction of the flow.
struct LatticeSums {
  double partition = 0, gradient = 0, radial = 0;

  LatticeSums(const Smoothing& w, double ratio, int dimensions, double g = 0) {
    const int y = dimensions == 3 ? 4 : 0;
    for (int i = -6; i <= 6; ++i)
      for (int j = -y; j <= y; ++j)
        for (int k = -4; k <= 4; ++k) {
          const double x = i + g * k, r2 = x * x + j * j + k * k;
          if (r2 >= ratio * ratio) continue;
          partition += static_cast<double>(w.value(static_cast<Real>(r2)));
          gradient -= static_cast<double>(w.gradient(static_cast<Real>(r2))) * x * x;
          radial += (dimensions + 2) * static_cast<double>(w.viscous(static_cast<Real>(r2))) * x * x * k * k;
        }
  }
};

// Sums of Lucy's function over a cubic lattice, as tabulated for supports of 2.1 to 3.5 spacings.
TEST(Smoothing, LucysLatticeSumsMatchTheTable) {
  struct Row {
    double ratio, partition, gradient, radial;
  };
  for (const Row& row : {Row{2.1, 1.017, 1.022, 0.906}, Row{2.6, 0.998, 0.988, 0.927},
                         Row{3.1, 1.002, 0.999, 0.972}, Row{3.5, 1.000, 0.998, 0.989}}) {
    const Smoothing w(SmoothingKind::lucy, row.ratio, 3, ViscousWeight::gradient);
    const LatticeSums sums(w, row.ratio, 3);
    EXPECT_NEAR(sums.partition, row.partition, 6e-4) << row.ratio;
    EXPECT_NEAR(sums.gradient, row.gradient, 6e-4) << row.ratio;
    EXPECT_NEAR(sums.radial, row.radial, 6e-4) << row.ratio;
  }
}

// Friction of a lattice under pressure, tau/p = dS/dg at its largest over a period of shear: films on slopes
// below it stand still. Lucy's is 0.75 % in two dimensions.
double friction(SmoothingKind kind, int dimensions) {
  const Smoothing w(kind, 2.6, dimensions);
  double most = 0;
  const double step = 0.01;
  for (double g = 0; g < 1; g += step)
    most = std::max(most, std::fabs(LatticeSums(w, 2.6, dimensions, g + step).partition -
                                    LatticeSums(w, 2.6, dimensions, g).partition) /
                              step);
  return most;
}

TEST(Smoothing, LevelHasNoFriction) {
  EXPECT_NEAR(friction(SmoothingKind::lucy, 2), 0.00755, 2e-4);
  EXPECT_NEAR(friction(SmoothingKind::lucy, 3), 0.00667, 2e-4);
  EXPECT_LT(friction(SmoothingKind::level, 2), 0.0002);
  EXPECT_LT(friction(SmoothingKind::level, 3), 0.0002);
}

// Pressure at rest errs by the lattice's sum of the gradient less one, viscosity by that of the weight.
TEST(Smoothing, LevelAndTheLatticeWeightAreRightOnLattices) {
  for (const int d : {2, 3}) {
    const Smoothing w(SmoothingKind::level, 2.6, d);
    const LatticeSums rest(w, 2.6, d);
    EXPECT_NEAR(rest.gradient, 1, 5e-4) << d;
    EXPECT_NEAR(rest.radial, 1, 4e-3) << d;
    double mean = 0;
    for (int k = 0; k < 20; ++k) mean += LatticeSums(w, 2.6, d, k / 20.0).radial / 20;
    EXPECT_NEAR(mean, 1, 4e-3) << d;
  }
}

}  // namespace
}  // namespace slagflow
