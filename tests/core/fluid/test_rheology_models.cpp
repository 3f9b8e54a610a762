// The rheologies beside Newtonian and Bingham, each against its formula in long double and in its limits.
#include <gtest/gtest.h>

#include "fluid/models.hpp"

namespace slagflow {
namespace {

constexpr double epsilon = sizeof(Real) == 4 ? 1.2e-7 : 2.3e-16;

Rheology make(RheologyKind kind, std::initializer_list<double> parameters) {
  Rheology r;
  r.kind = kind;
  int k = 0;
  for (const double p : parameters) r.parameters[k++] = static_cast<Real>(p);
  return r;
}

double eta(const Rheology& r, double rate) {
  return static_cast<double>(viscosity(r, static_cast<Real>(rate)));
}

// Calls check(rate as the model sees it, exact arithmetic) over twenty decades.
template <class F>
void over_rates(F check) {
  for (double rate = 1e-14; rate < 1e6; rate *= 1.37)
    check(static_cast<long double>(static_cast<Real>(rate)));
}

// (1 - e^-x) / x by its power series where the difference would cancel.
long double growth(long double x) {
  return x < 1e-4L ? 1 - x / 2 + x * x / 6 - x * x * x / 24 : (1 - std::exp(-x)) / x;
}

// The parameters that follow are the same number in single and double precision.
constexpr double k_consistency = 0.75, tau = 5, m = 1024;

Rheology herschel_bulkley(double index, double yield_stress = tau) {
  return make(RheologyKind::herschel_bulkley, {k_consistency, index, yield_stress, m});
}

TEST(HerschelBulkley, MatchesLongDoubleOverTwentyDecades) {
  for (const double index : {0.25, 0.5, 1.0, 1.75})
    over_rates([&](long double rate) {
      const long double power =
          std::pow(rate * rate + 1 / (static_cast<long double>(m) * m), (index - 1) / 2);
      const auto exact = static_cast<double>(k_consistency * power + tau * m * growth(m * rate));
      EXPECT_NEAR(eta(herschel_bulkley(index), static_cast<double>(rate)) / exact, 1, 8 * epsilon)
          << index << " " << static_cast<double>(rate);
    });
}

TEST(HerschelBulkley, AtRestHasTheLimit) {
  for (const double index : {0.25, 0.5, 1.75}) {
    const double limit = k_consistency * std::pow(m, 1 - index) + m * tau;
    EXPECT_NEAR(eta(herschel_bulkley(index), 0) / limit, 1, 8 * epsilon);
  }
}

TEST(HerschelBulkley, FastShearHasTheIdealStress) {
  for (const double index : {0.25, 0.5, 1.75})
    for (const double rate : {0.125, 1.0, 64.0, 1e5}) {
      const double ideal = tau + k_consistency * std::pow(rate, index);
      const double minimum_rate = 0.5 * std::abs(index - 1) / (m * rate * m * rate);
      EXPECT_NEAR(eta(herschel_bulkley(index), rate) * rate / ideal, 1, 10 * epsilon + minimum_rate);
    }
}

TEST(HerschelBulkley, WithIndexOneIsBingham) {
  const Rheology bingham = make(RheologyKind::bingham, {k_consistency, tau, m});
  for (const double rate : {0.0, 1e-9, 1e-3, 1.0, 1e6})
    EXPECT_EQ(eta(herschel_bulkley(1), rate), eta(bingham, rate));
}

TEST(HerschelBulkley, YieldsWithTheYieldStress) {
  const auto below = static_cast<Real>(0.99 * tau), above = static_cast<Real>(1.01 * tau);
  EXPECT_FALSE(yielded(herschel_bulkley(0.5), 0));
  EXPECT_FALSE(yielded(herschel_bulkley(0.5), below));
  EXPECT_TRUE(yielded(herschel_bulkley(0.5), above));
  EXPECT_TRUE(yielded(herschel_bulkley(0.5, 0), Real(1e-5)));
}

Rheology casson(double yield_stress) { return make(RheologyKind::casson, {0.75, yield_stress, m}); }

TEST(Casson, MatchesLongDoubleOverTwentyDecades) {
  over_rates([](long double rate) {
    const long double root = std::sqrt(0.75L) + std::sqrt(5.0L * m) * growth(std::sqrt(m * rate));
    EXPECT_NEAR(eta(casson(5), static_cast<double>(rate)) / static_cast<double>(root * root), 1, 8 * epsilon)
        << static_cast<double>(rate);
  });
}

TEST(Casson, HasItsLimits) {
  const double rest = std::pow(std::sqrt(0.75) + std::sqrt(5 * m), 2);
  EXPECT_NEAR(eta(casson(5), 0) / rest, 1, 8 * epsilon);
  for (const double rate : {1.0, 100.0, 1e6}) {
    const double ideal = std::pow(std::sqrt(5.0) + std::sqrt(0.75 * rate), 2);
    EXPECT_NEAR(eta(casson(5), rate) * rate / ideal, 1, 8 * epsilon + 2 * std::exp(-std::sqrt(m * rate)));
    EXPECT_NEAR(eta(casson(0), rate), 0.75, 4 * epsilon);
  }
}

TEST(Casson, YieldsWithTheYieldStress) {
  EXPECT_FALSE(yielded(casson(5), 0));
  EXPECT_FALSE(yielded(casson(5), Real(4.99)));
  EXPECT_TRUE(yielded(casson(5), Real(5.01)));
}

Rheology biviscous(double yield_stress) { return make(RheologyKind::biviscous, {0.75, yield_stress, 64}); }

TEST(Biviscous, HasTwoStraightBranchesThatMeet) {
  const double critical = 6 / (64 * 0.75);  // 0.125 1/s
  over_rates([&](long double rate) {
    const auto g = static_cast<double>(rate);
    const double stress = g <= critical ? 64 * 0.75 * g : 6 + 0.75 * (g - critical);
    EXPECT_NEAR(eta(biviscous(6), g) * g / stress, 1, 8 * epsilon) << g;
  });
  EXPECT_EQ(eta(biviscous(6), 0), 64 * 0.75);
  EXPECT_NEAR(eta(biviscous(6), critical * 1.000001) / (64 * 0.75), 1, 2e-6);
}

TEST(Biviscous, YieldsWithTheYieldStress) {
  EXPECT_FALSE(yielded(biviscous(6), 0));
  EXPECT_FALSE(yielded(biviscous(6), Real(5.99)));
  EXPECT_TRUE(yielded(biviscous(6), Real(6.01)));
}

TEST(Biviscous, WithoutYieldStressIsNewtonian) {
  for (const double rate : {0.0, 1e-9, 1.0, 1e6}) EXPECT_EQ(eta(biviscous(0), rate), 0.75);
}

Rheology carreau(double index, double infinite, double transition) {
  return make(RheologyKind::carreau_yasuda, {8, infinite, 0.5, index, transition});
}

TEST(CarreauYasuda, MatchesLongDoubleOverTwentyDecades) {
  for (const double index : {0.125, 0.5, 1.0})
    for (const double transition : {0.5, 2.0, 8.0})
      over_rates([&](long double rate) {
        const long double bracket = 1 + std::pow(0.5L * rate, static_cast<long double>(transition));
        const long double exact = 0.25L + 7.75L * std::pow(bracket, (index - 1) / transition);
        EXPECT_NEAR(
            eta(carreau(index, 0.25, transition), static_cast<double>(rate)) / static_cast<double>(exact), 1,
            16 * epsilon)
            << index << " " << transition << " " << static_cast<double>(rate);
      });
}

TEST(CarreauYasuda, HasItsPlateausAndThePowerLawBetween) {
  EXPECT_EQ(eta(carreau(0.5, 0.25, 2), 0), 8);
  EXPECT_NEAR(eta(carreau(0.5, 0.25, 2), 1e15), 0.25, 1e-6);
  EXPECT_NEAR(eta(carreau(0.5, 0, 2), 2e6) / (8 * std::pow(1e6, -0.5)), 1, 1e-6);
  EXPECT_EQ(eta(carreau(1, 0.25, 2), 37), 8);
  EXPECT_TRUE(yielded(carreau(0.5, 0.25, 2), 0));
}

// (lambda gamma)^a would be 1e240.
TEST(CarreauYasuda, DoesNotOverflow) {
  EXPECT_NEAR(eta(carreau(0.5, 0, 10), 2e24) / (8 * std::pow(1e24, -0.5)), 1, 1e-5);
}

}  // namespace
}  // namespace slagflow
