// Every rheology of the table, and Papanastasiou's form in its limits.
#include <gtest/gtest.h>

#include <algorithm>

#include "fluid/models.hpp"
#include "reference.hpp"

namespace slagflow {
namespace {

constexpr double epsilon = sizeof(Real) == 4 ? 1.2e-7 : 2.3e-16;

double eta(const Rheology& r, double rate) {
  return static_cast<double>(viscosity(r, static_cast<Real>(rate)));
}

// A model of the table with plausible parameters: defaults where there are, else a number within the limits,
// which is the middle between them where the one asked for is too large.
Rheology sample(std::size_t kind, double without_default) {
  Rheology r;
  r.kind = static_cast<RheologyKind>(kind);
  const RheologyInfo& info = rheologies[kind];
  for (int k = 0; k < info.parameter_count; ++k) {
    const ParameterInfo& p = info.parameters[k];
    const double above = p.lower + without_default;
    const double inside = above <= p.upper ? above : (p.lower + p.upper) / 2;
    r.parameters[k] = static_cast<Real>(p.fallback >= 0 ? p.fallback : inside);
  }
  return r;
}

class AnyRheology : public testing::TestWithParam<std::size_t> {};

TEST_P(AnyRheology, HasANameAFormulaAndDocumentedParameters) {
  const RheologyInfo& info = rheologies[GetParam()];
  EXPECT_FALSE(std::string(info.name).empty());
  EXPECT_NE(std::string(info.formula).find("eta ="), std::string::npos);
  ASSERT_GE(info.parameter_count, 1);
  ASSERT_LE(info.parameter_count, most_parameters);
  for (int k = 0; k < info.parameter_count; ++k) {
    const ParameterInfo& p = info.parameters[k];
    const std::string key = p.key;
    EXPECT_FALSE(key.empty());
    EXPECT_FALSE(std::string(p.meaning).empty());
    EXPECT_NE(std::string(info.formula).find(key == "growth_exponent" ? "m shear_rate" : key),
              std::string::npos)
        << key;
    EXPECT_LT(p.lower, p.upper);
    if (p.fallback >= 0) {
      EXPECT_GE(p.fallback, p.lower);
      EXPECT_LE(p.fallback, p.upper);
    }
  }
  EXPECT_STREQ(sample(GetParam(), 1).info().name, info.name);
}

// A suspension raises exactly one parameter, and a yield stress is found by its role alone.
TEST_P(AnyRheology, HasOneViscosityAndAtMostOneYieldStress) {
  const RheologyInfo& info = rheologies[GetParam()];
  int viscosities = 0, yield_stresses = 0;
  for (int k = 0; k < info.parameter_count; ++k) {
    const ParameterRole role = info.parameters[k].role;
    viscosities += role == ParameterRole::viscosity;
    yield_stresses += role == ParameterRole::yield_stress;
    EXPECT_EQ(role == ParameterRole::yield_stress, std::string(info.parameters[k].key) == "yield_stress");
  }
  EXPECT_EQ(viscosities, 1);
  EXPECT_LE(yield_stresses, 1);
}

TEST_P(AnyRheology, ViscosityIsPositiveAndFiniteFromRestToFastShear) {
  for (double parameter : {1e-3, 1.0, 100.0})
    for (double rate : {0.0, 1e-30, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      const double viscous = eta(sample(GetParam(), parameter), rate);
      EXPECT_GT(viscous, 0) << rate;
      EXPECT_TRUE(std::isfinite(viscous)) << rate;
    }
}

TEST_P(AnyRheology, StressGrowsWithTheShearRate) {
  for (double parameter : {0.3, 2.0}) {
    const Rheology r = sample(GetParam(), parameter);
    double before = 0;
    for (double rate = 1e-9; rate < 1e6; rate *= 1.3) {
      const double stress = eta(r, rate) * rate;
      EXPECT_GT(stress, before * (1 - 4 * epsilon)) << rate;
      before = stress;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, AnyRheology, testing::Range(std::size_t(0), rheologies.size()), [](const auto& p) {
  std::string name = rheologies[p.param].name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

constexpr double eta_p = 0.5, tau = 5, m = 1000;

Rheology bingham(double yield_stress) {
  return {RheologyKind::bingham,
          {static_cast<Real>(eta_p), static_cast<Real>(yield_stress), static_cast<Real>(m)}};
}

TEST(Bingham, AtRestHasTheLimit) {
  EXPECT_EQ(eta(bingham(tau), 0), eta_p + m * tau);
  EXPECT_NEAR(eta(bingham(tau), 1e-30), eta_p + m * tau, 1e-3);
}

TEST(Bingham, MatchesLongDoubleOverTwentyDecades) {
  const reference::Fluid fluid{1000, eta_p, tau, m};
  for (double rate = 1e-15; rate < 1e6; rate *= 1.1) {
    const auto exact = static_cast<double>(reference::viscosity(fluid, static_cast<Real>(rate)));
    EXPECT_NEAR(eta(bingham(tau), rate) / exact, 1, 6 * epsilon) << rate;  // a handful of roundings
  }
}

TEST(Bingham, FastShearHasTheIdealBinghamStress) {
  for (double rate : {1.0, 10.0, 1e4, 1e6})
    EXPECT_NEAR(eta(bingham(tau), rate) * rate / (tau + eta_p * rate), 1, 6 * epsilon);
}

TEST(Bingham, WithoutYieldStressIsNewtonian) {
  for (double rate : {0.0, 1e-9, 1.0, 1e6}) EXPECT_EQ(eta(bingham(0), rate), eta_p);
}

// The stress eta_P gamma + tau (1 - e^(-m gamma)) passes tau where eta_P gamma = tau e^(-m gamma).
TEST(Bingham, YieldsWhereTheStressExceedsTheYieldStress) {
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (eta_p * middle < tau * std::exp(-m * middle) ? low : high) = middle;
  }
  auto yields_at = [](double rate) {
    return yielded(bingham(tau), viscosity(bingham(tau), static_cast<Real>(rate)) * static_cast<Real>(rate));
  };
  EXPECT_FALSE(yields_at(0));
  EXPECT_FALSE(yields_at(0.98 * low));
  EXPECT_TRUE(yields_at(1.02 * low));
  EXPECT_TRUE(yields_at(100));
}

TEST(Newtonian, KeepsItsViscosityAndIsAlwaysYielded) {
  const Rheology r{RheologyKind::newtonian, {Real(0.25)}};
  for (double rate : {0.0, 1.0, 1e6}) {
    EXPECT_EQ(eta(r, rate), 0.25);
    EXPECT_TRUE(yielded(r, static_cast<Real>(rate)));
  }
}

}  // namespace
}  // namespace slagflow
