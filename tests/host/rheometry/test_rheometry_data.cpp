#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_data.hpp"

namespace slagflow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string good_rows = "1,3.3\n2,4.3\n5,7.3\n10,12.3\n";

std::string refusal(const std::string& text, const SampleFacts& options = {}) {
  try {
    parse_measurements(text, "x.csv", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RheometryData, ReadsShearRateAndStress) {
  const Measurements m = parse_measurements(
      "# oil B\n# density_g/cm3 = 0.97\n# name = oil_b\nshear_rate_1/s,shear_stress_mPa\n2,648\n1,324\n"
      "5,1620\n\n10,3240\n",
      "x.csv");
  EXPECT_THAT(m.curve.rate, ElementsAre(1, 2, 5, 10));
  EXPECT_THAT(m.curve.stress, testing::Pointwise(testing::DoubleNear(1e-12), {0.324, 0.648, 1.62, 3.24}));
  EXPECT_FALSE(m.curve.cylinders.has_value());
  EXPECT_DOUBLE_EQ(m.facts.density.value(), 970);
  EXPECT_EQ(m.facts.name.value(), "oil_b");
  EXPECT_TRUE(m.warnings.empty());
}

const std::string cylinders = "# bob_radius_mm = 4.37\n# cup_radius_mm = 6.35\n# height_mm = 30\n";

TEST(RheometryData, ReadsRotationAndTorque) {
  const Measurements m =
      parse_measurements(cylinders + "rotation_rpm;torque_uNm\n6;1\n12;2\n30;5\n60;10\n", "x.csv");
  ASSERT_TRUE(m.curve.cylinders.has_value());
  EXPECT_DOUBLE_EQ(m.curve.cylinders->height, 0.03);
  EXPECT_NEAR(m.curve.rate[3], 6.283185307, 1e-8);
  EXPECT_NEAR(m.curve.stress[0], 1e-6 / (2 * M_PI * 4.37e-3 * 4.37e-3 * 0.03), 1e-9);
}

TEST(RheometryData, ReadsTorqueInPerCentOfFullScale) {
  const std::string rows = "rotation_rpm,torque_percent\n6,5\n12,20\n30,50\n60,100\n";
  EXPECT_THAT(refusal(cylinders + rows), HasSubstr("full_scale_torque_Nm"));
  SampleFacts options;
  options.full_scale_torque = 1e-4;
  const Measurements m = parse_measurements(cylinders + rows, "x.csv", options);
  EXPECT_NEAR(m.curve.stress[3], m.curve.cylinders->bob_stress(1e-4), 1e-9);
  EXPECT_THAT(m.warnings, ElementsAre(HasSubstr("x.csv:5: column 'torque_percent': value 5 is below 10 %")));
}

TEST(RheometryData, OptionsGoBeforeTheFile) {
  SampleFacts options;
  options.height = 0.04;
  const Measurements m =
      parse_measurements(cylinders + "rotation_rpm,torque_uNm\n6,1\n12,2\n30,5\n60,10\n", "x.csv", options);
  EXPECT_DOUBLE_EQ(m.curve.cylinders->height, 0.04);
}

TEST(RheometryData, RefusesUnknownUnits) {
  EXPECT_THAT(refusal("shear_rate_1/s,shear_stress_psi\n" + good_rows),
              AllOf(HasSubstr("x.csv:1: column 'shear_stress_psi'"),
                    HasSubstr("allowed: shear_stress_Pa, shear_stress_mPa, shear_stress_kPa")));
  EXPECT_THAT(refusal("shear_rate,shear_stress_Pa\n" + good_rows),
              HasSubstr("column 'shear_rate' has no unit"));
  EXPECT_THAT(refusal("# bob_radius_in = 1\nshear_rate_1/s,shear_stress_Pa\n" + good_rows),
              HasSubstr("x.csv:1: key 'bob_radius_in' has no unit that is known"));
}

TEST(RheometryData, RefusesColumnsThatAreNoPair) {
  EXPECT_THAT(refusal("shear_rate_1/s,torque_Nm\n" + good_rows), HasSubstr("not a pair"));
  EXPECT_THAT(refusal("shear_rate_1/s,shear_stress_Pa,shear_stress_mPa\n1,2,3\n"), HasSubstr("twice"));
  EXPECT_THAT(refusal(""), HasSubstr("no line names the columns"));
}

TEST(RheometryData, RefusesValuesThatCannotBe) {
  const std::string header = "shear_rate_1/s,shear_stress_Pa\n";
  EXPECT_THAT(refusal(header + "1,3.3\n-2,4.3\n5,7.3\n10,12.3\n"),
              AllOf(HasSubstr("x.csv:3: column 'shear_rate_1/s': value -2"), HasSubstr("allowed: > 0")));
  EXPECT_THAT(refusal(header + "1,3.3\n2,0\n5,7.3\n10,12.3\n"),
              HasSubstr("x.csv:3: column 'shear_stress_Pa': value 0"));
  EXPECT_THAT(refusal(header + "1,3.3\n2,many\n5,7.3\n10,12.3\n"),
              HasSubstr("value \"many\" is not a number"));
  EXPECT_THAT(refusal(header + "1,3.3,9\n2,4.3\n5,7.3\n10,12.3\n"),
              HasSubstr("x.csv:2: 3 fields: allowed: 2"));
  EXPECT_THAT(refusal(cylinders + "rotation_rpm,torque_percent\n6,120\n"), HasSubstr("to 100"));
}

TEST(RheometryData, ReportsAllThatIsWrong) {
  const std::string said = refusal("shear_rate_1/s,shear_stress_Pa\n-1,3.3\n2,x\n5,7.3\n10,12.3\n");
  EXPECT_THAT(said, AllOf(HasSubstr("x.csv:2:"), HasSubstr("x.csv:3:")));
}

TEST(RheometryData, RefusesMissingOrImpossibleGeometry) {
  const std::string rows = "rotation_rpm,torque_uNm\n6,1\n12,2\n30,5\n60,10\n";
  EXPECT_THAT(refusal(rows),
              AllOf(HasSubstr("# bob_radius_m = ..."), HasSubstr("--cup-radius"), HasSubstr("--height")));
  EXPECT_THAT(refusal("# bob_radius_m = 4.37\n" + rows), HasSubstr("is the unit right?"));
  EXPECT_THAT(refusal("# bob_radius_mm = 6.35\n# cup_radius_mm = 4.37\n# height_mm = 30\n" + rows),
              HasSubstr("cup_radius 0.00437 m: allowed: > bob_radius"));
}

TEST(RheometryData, RefusesTooFewPointsAndASingleRate) {
  EXPECT_THAT(refusal("shear_rate_1/s,shear_stress_Pa\n1,3.3\n2,4.3\n5,7.3\n"),
              HasSubstr("3 points: allowed: at least 4"));
  EXPECT_THAT(refusal("shear_rate_1/s,shear_stress_Pa\n2,3.3\n2,3.4\n2,3.2\n2,3.3\n"),
              HasSubstr("all points have the same rate"));
}

TEST(RheometryData, WarnsOfASmallFallAndRefusesALargeOne) {
  const std::string header = "shear_rate_1/s,shear_stress_Pa\n";
  const Measurements m = parse_measurements(header + "1,3\n2,5\n4,4.8\n8,9\n", "x.csv");
  EXPECT_THAT(
      m.warnings,
      ElementsAre(HasSubstr("x.csv:4: the stress 4.8 Pa is below the 5 Pa of line 3 at a lower rate")));
  EXPECT_THAT(refusal(header + "1,3\n2,9\n4,7\n8,6.5\n"),
              AllOf(HasSubstr("x.csv:4: the stress 7 Pa is below the 9 Pa of line 3"), HasSubstr("22.2 %"),
                    HasSubstr("x.csv:5:")));
}

TEST(RheometryData, TakesRepeatsAtOneRate) {
  const Measurements m =
      parse_measurements("shear_rate_1/s,shear_stress_Pa\n1,3\n1,2.9\n4,6\n4,6.1\n8,10\n", "x.csv");
  EXPECT_TRUE(m.warnings.empty());
  EXPECT_EQ(m.curve.rate.size(), 5u);
}

TEST(RheometryData, WarnsOfANarrowRangeAndOfUnusedColumns) {
  const Measurements m = parse_measurements(
      "shear_rate_1/s,shear_stress_Pa,temperature_C\n5,3.3,20\n6,4.3,20\n8,7.3,20\n10,12.3,20\n", "x.csv");
  EXPECT_THAT(m.warnings, ElementsAre(HasSubstr("column 'temperature_C' is not used"),
                                      HasSubstr("only 2 times the smallest")));
}

TEST(RheometryData, NamesAFileThatIsNotThere) {
  try {
    read_measurements("/nowhere/x.csv", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/x.csv"));
  }
}

}  // namespace
}  // namespace slagflow
