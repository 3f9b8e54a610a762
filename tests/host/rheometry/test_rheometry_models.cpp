#include <gtest/gtest.h>

#include <cmath>

#include "host/rheometry/rheometry_models.hpp"

namespace slagflow {
namespace {

// The paper's viscometer: a bob of 8.74 mm in a cup of 12.7 mm diameter.
const Cylinders viscometer{4.37e-3, 6.35e-3, 0.03};
constexpr double rpm = 2 * 3.14159265358979323846 / 60;  // [rad/s]

TEST(Cylinders, NominalRateOfThePapersViscometer) {
  EXPECT_NEAR(viscometer.nominal_rate(rpm), 0.398, 0.0005);  // [1/s] per rpm, from its dimensions
}

TEST(Cylinders, StressAtTheBobFromTheTorque) {
  // 2 pi R^2 H = 3.6e-6 m^3
  EXPECT_NEAR(viscometer.bob_stress(1e-5), 1e-5 / (2 * M_PI * 4.37e-3 * 4.37e-3 * 0.03), 1e-9);
}

TEST(Cylinders, NewtonianStressIsViscosityTimesTheNominalRate) {
  const FlowParameters oil{0, 0.324, 1};
  EXPECT_NEAR(bob_stress(oil, viscometer, 3.0), 0.324 * viscometer.nominal_rate(3.0), 1e-10);
}

TEST(Cylinders, PowerLawHasItsClosedForm) {
  // tau ~ r^-2 gives Omega = (n/2) (tau_b/K)^(1/n) (1 - kappa^(2/n)).
  for (const double n : {0.3, 0.5, 0.8, 1.4}) {
    const FlowParameters fluid{0, 2.0, n};
    const double expected = n / 2 * std::pow(7.0 / 2.0, 1 / n) * (1 - std::pow(viscometer.ratio(), 2 / n));
    EXPECT_NEAR(rotation(fluid, viscometer, 7.0), expected, 1e-9 * expected) << n;
    EXPECT_NEAR(bob_stress(fluid, viscometer, expected), 7.0, 1e-8) << n;
  }
}

// Reiner and Riwlin: Omega = (T/4 pi eta_P)(1/R_i^2 - 1/r_y^2) - (tau_B/eta_P) ln(r_y/R_i) with T the torque
// per length and r_y = min(R_o, sqrt(T/2 pi tau_B)).
double reiner_riwlin(double stress, double tau_b, double eta, const Cylinders& c) {
  const double torque = 2 * M_PI * c.bob_radius * c.bob_radius * stress;
  const double r_y = std::min(c.cup_radius, std::sqrt(torque / (2 * M_PI * tau_b)));
  return torque / (4 * M_PI * eta) * (1 / (c.bob_radius * c.bob_radius) - 1 / (r_y * r_y)) -
         tau_b / eta * std::log(r_y / c.bob_radius);
}

TEST(Cylinders, BinghamFollowsReinerAndRiwlin) {
  const FlowParameters slurry{5, 0.8, 1};
  for (const double stress : {5.2, 7.0, 10.0, 11.0, 40.0}) {  // the gap is sheared from 10.56 Pa on
    const double omega = reiner_riwlin(stress, 5, 0.8, viscometer);
    EXPECT_NEAR(rotation(slurry, viscometer, stress), omega, 1e-12 + 1e-10 * omega) << stress;
    EXPECT_NEAR(bob_stress(slurry, viscometer, omega), stress, 1e-8 * stress) << stress;
  }
}

TEST(Cylinders, IntegralOfHerschelBulkleyMeetsTheClosedFormAtIndexOne) {
  const FlowParameters closed{5, 0.8, 1}, integrated{5, 0.8, 1 + 1e-9};
  for (const double stress : {5.2, 7.0, 11.0, 40.0}) {
    const double omega = rotation(closed, viscometer, stress);
    EXPECT_NEAR(rotation(integrated, viscometer, stress), omega, 1e-7 * omega) << stress;
  }
}

TEST(Cylinders, NarrowGapIsSimpleShear) {
  const Cylinders narrow{0.0200, 0.0201, 0.05};
  const FlowParameters slurry{3, 1.2, 0.6};
  const double omega = 2.0, rate = narrow.nominal_rate(omega);
  // Stress and rate vary by 1 % across this gap.
  EXPECT_NEAR(bob_stress(slurry, narrow, omega), shear_stress(slurry, rate),
              0.01 * shear_stress(slurry, rate));
}

}  // namespace
}  // namespace slagflow
