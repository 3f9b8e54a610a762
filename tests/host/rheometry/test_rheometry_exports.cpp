// Files as rheometers' programs, spreadsheets and editors write them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_data.hpp"

namespace slagflow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* names = "shear_rate_1/s,shear_stress_Pa\n";

Measurements read(const std::string& text, const SampleFacts& options = {}) {
  return parse_measurements(text, "x.csv", options);
}

std::string refusal(const std::string& text, const SampleFacts& options = {}) {
  try {
    read(text, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Each reads 1, 2, 5, 10 /s and 3, 4, 7, 12 Pa.
void expect_readings(const Measurements& m) {
  EXPECT_THAT(m.curve.rate, testing::Pointwise(testing::DoubleNear(1e-9), {1., 2., 5., 10.}));
  EXPECT_THAT(m.curve.stress, testing::Pointwise(testing::DoubleNear(1e-9), {3., 4., 7., 12.}));
}

TEST(RheometryExports, QuotedFields) {
  expect_readings(
      read("shear_rate_1/s,shear_stress_mPa,remark\n1,\"3,000.0\",\"ok, run 1\"\n2,\"4,000\",\"5\"\" cup\"\n"
           "\"5\",\"7,000.0\",\n10,\"12,000\"\n"));
  EXPECT_THAT(refusal(std::string(names) + "1,\"3\n2,4\n5,7\n10,12\n"),
              HasSubstr("x.csv:2: a quote that is not closed"));
}

TEST(RheometryExports, ARowOfUnits) {
  expect_readings(read(std::string(names) + "1/s,Pa\n1,3\n2,4\n5,7\n10,12\n"));
  expect_readings(read("Shear Rate;Shear Stress;Status\n[1/s];[Pa];\n1;3;\n2;4;\n5;7;\n10;12;\n"));
  expect_readings(read("GP,Tau,Eta\n1/s,mPa,mPas\n1,3000,3000\n2,4000,2000\n5,7000,1400\n10,12000,1200\n"));
  EXPECT_THAT(refusal(std::string(names) + "1/s,mPa\n1,3\n2,4\n5,7\n10,12\n"),
              HasSubstr("x.csv:2: column 'shear_stress_Pa': the row of units has \"mPa\": allowed: the unit "
                        "of the name, Pa"));
  EXPECT_THAT(refusal("Shear Rate,Shear Stress\n1/s,psi\n1,3\n2,4\n5,7\n10,12\n"),
              HasSubstr("x.csv:2: column 'Shear Stress' has no unit that is known, but 'psi'"));
}

// Left out and told; what a person got wrong is refused.
TEST(RheometryExports, RowsThatTheInstrumentMarksAsNone) {
  const Measurements m = read(
      "Point;Shear rate [1/s];Shear stress [Pa]\n1;1;3\n2;1,5;over range\n3;2;4\n4;---;---\n"
      "5;5;7\n6;10;12\n7;20;#NV\n");
  expect_readings(m);
  EXPECT_THAT(m.warnings,
              testing::Contains(HasSubstr("x.csv:3: 3 rows have no reading: lines 3 (\"over range\"), 5 "
                                          "(\"---\"), 8 (\"#NV\"); they are left out")));
  EXPECT_THAT(
      read(std::string(names) + "1,3\n2,4\n---,---\n5,7\n10,12\n").warnings,
      testing::Contains(HasSubstr("x.csv:4: 1 row has no reading: line 4 (\"---\"); it is left out")));
  EXPECT_THAT(refusal(std::string(names) + "1,3\n2,nan\n5,nan\n"),
              HasSubstr("x.csv:3: 2 rows have no reading: lines 3 (\"nan\"), 4 (\"nan\"): allowed: up to "
                        "half of all rows"));
  EXPECT_THAT(refusal(std::string(names) + "1,3\n2,4*\n5,7\n10,12\n"),
              HasSubstr("x.csv:3: column 'shear_stress_Pa': value \"4*\" is not a number"));
}

// Brookfield's Rheocalc: of a disc it knows no shear rate, and writes 0.
TEST(RheometryExports, ColumnsOfZerosAreNotMeasured) {
  const Measurements m = read(
      "Spindle,LV-02 (62)\n\nViscosity (cP),Speed (RPM),% Torque (%),"
      "Shear Stress (dyne/cm\xC2\xB2),Shear Rate "
      "(1/s)\n1250,6,25,0.00,0.00\n1000,12,40,0.00,0.00\n900,20,60,0.00,0.00\n"
      "800,30,80,0.00,0.00\nEEEE,60,EEEE,EEEE,0.00\n");
  EXPECT_EQ(m.facts.spindle, "LV-2");
  EXPECT_THAT(m.how,
              HasSubstr("4 rows in lines 4 to 7; rotation in rpm from 'Speed (RPM)', torque in percent"));
  EXPECT_THAT(m.warnings, testing::Contains(HasSubstr("1 row has no reading: line 8 (\"EEEE\")")));
  EXPECT_THAT(refusal(std::string(names) + "0,3\n0,4\n0,7\n"),
              HasSubstr("x.csv:2: column 'shear_rate_1/s': value 0"));
}

TEST(RheometryExports, RunsUpAndDownThatDifferAreTold) {
  const auto warnings = [](const std::string& back) {
    return read(std::string(names) + "1,30\n2,40\n5,70\n10,120\n5," + back + "\n").warnings;
  };
  EXPECT_THAT(warnings("68"), IsEmpty());
  EXPECT_THAT(warnings("63"), ElementsAre(HasSubstr("x.csv:6: the stress 63 Pa is below the 70 Pa of line 4 "
                                                    "at the same rate: does the sample change with time?")));
}

TEST(RheometryExports, EmptyColumns) {
  expect_readings(read("shear_rate_1/s,shear_stress_Pa,,\n1,3,,\n2,4,,\n5,7\n10,12,,\n"));
  EXPECT_THAT(read(std::string(names) + "1,3,,\n2,4,,\n5,7,,\n10,12,,\n").warnings, IsEmpty());
  EXPECT_THAT(refusal(std::string(names) + "1,3\n2,\n5,7\n10,12\n"),
              HasSubstr("x.csv:3: column 'shear_stress_Pa': no value"));
}

TEST(RheometryExports, DecimalCommas) {
  expect_readings(read("shear_rate_1/s;shear_stress_Pa\n1,0;3,0\n2,0;4,0\n5,0;7\n10,0;12,0\n"));
  expect_readings(
      read("shear_rate_1/s;shear_stress_mPa\n1,0;3.000,0\n2,0;4.000,0\n5,0;7.000,0\n10,0;12.000,0\n"));
  EXPECT_THAT(refusal("shear_rate_1/s;shear_stress_Pa\n1;3,0\n2;4.5\n5;7\n10;12\n"),
              HasSubstr("x.csv:2: value \"3,0\" has a decimal comma, \"4.5\" in line 3 a decimal point"));
  const std::string unclear = "shear_rate_1/s;shear_stress_Pa\n1;3,000\n2;4,000\n5;7,000\n10;12,000\n";
  EXPECT_THAT(refusal(unclear), HasSubstr("x.csv:2: value \"3,000\" may have a decimal comma"));
  expect_readings(read("# decimal = comma\n" + unclear));
  EXPECT_THAT(refusal("# decimal = dot\n" + unclear),
              HasSubstr("key 'decimal': value \"dot\": allowed: point, comma"));
  EXPECT_THAT(refusal(std::string(names) + "1,0,3,0\n2,0,4,0\n5,0,7,0\n10,0,12,0\n"),
              HasSubstr("x.csv:2: 4 fields: allowed: 2, as in line 1; a decimal comma?"));
}

TEST(RheometryExports, ViscosityInPlaceOfStress) {
  expect_readings(read("Shear rate [1/s],Viscosity [cP]\n1,3000\n2,2000\n5,1400\n10,1200\n"));
  expect_readings(read("Stress [Pa],Viscosity [Pa.s]\n3,3\n4,2\n7,1.4\n12,1.2\n"));
  EXPECT_THAT(
      read("Shear rate [1/s],Shear stress [Pa],Viscosity [Pa.s]\n1,3,3000\n2,4,2000\n5,7,1400\n10,12,1200\n")
          .warnings,
      ElementsAre(
          HasSubstr("x.csv:2: the viscosity is 3000 Pa s, but stress over rate 3 Pa s, and so in 4 lines")));
}

// As RheoCompass exports intervals, here with tabs.
std::string interval(const std::string& number) {
  return "Interval and data points:\t" + number +
         "\t4\nInterval data:\tPoint No.\tShear Rate\tShear "
         "Stress\tTorque\n\t\t\t\t\n\t\t[1/s]\t[Pa]\t[mN\xC2\xB7m]\n"
         "\t1\t1\t3\t1\n\t2\t2\t4\t1\n\t3\t5\t7\t1\n\t4\t10\t12\t1\n\n";
}

TEST(RheometryExports, Intervals) {
  const std::string head = "Project:\tslag\nTest:\tflow curve\n\n";
  expect_readings(read(head + interval("1")));
  const Measurements both = read(head + interval("1") + interval("2"));
  EXPECT_EQ(both.curve.rate.size(), 8u);
  EXPECT_THAT(both.warnings, testing::Contains(HasSubstr("the 2 tables of lines 5, 14 are taken together")));
  SampleFacts options;
  options.table = 2;
  expect_readings(read(head + interval("1") + interval("2"), options));
  options.table = 3;
  EXPECT_THAT(refusal(head + interval("1") + interval("2"), options), HasSubstr("table 3: allowed: 1 to 2"));
}

TEST(RheometryExports, LinesAboveAndBelow) {
  expect_readings(
      read("Instrument;DHR\nDensity;2600;kg/m3\n\nShear rate [1/s];Stress [Pa]\n1;3\n2;4\n\n5;7\n10;12\n\n"
           "Temperature;1400;C\nEnd\n"));
  EXPECT_DOUBLE_EQ(
      read("Density: 2.6 g/cm3\n" + std::string(names) + "1,3\n2,4\n5,7\n10,12\n").facts.density.value(),
      2600);
  EXPECT_THAT(refusal(std::string(names) + "1,3\n2,4\npause\n5,7\n10,12\n"),
              HasSubstr("x.csv:5: numbers below line 4, which ends the table of line 1"));
  EXPECT_THAT(refusal("No,shear_rate_1/s,shear_stress_Pa\n1,1,3\n2,2,4\n3,5,7\n4,10,12\nMean,4.5,6.5\n"),
              HasSubstr("x.csv:6: column 'No': value \"Mean\""));
}

TEST(RheometryExports, OtherSeparatorsAndEncodings) {
  expect_readings(read("Shear rate [1/s]   Shear stress [Pa]\n 1    3\n 2    4\n 5    7\n 10   12\n"));
  expect_readings(read(
      "| shear_rate_1/s | shear_stress_Pa |\n|---|---|\n| 1 | 3 |\n| 2 | 4 |\n| 5 | 7 |\n| 10 | 12 |\n"));
  expect_readings(read("# shear_rate_1/s shear_stress_Pa\n1 3\n2 4\n5 7\n10 12\n"));
  expect_readings(read("Shear rate, 1/s, Shear stress, Pa\n1,3\n2,4\n5,7\n10,12\n"));
  expect_readings(read("\xEF\xBB\xBF" + std::string(names) + "1,3\r\n2,4\r\n5,7\r\n10,12\r\n"));
  EXPECT_THAT(
      read(std::string(names) + "1,3\n2,4\n5,7\n10,12\n").how,
      HasSubstr("UTF-8, separated by commas, decimal point: 4 rows in lines 2 to 5; shear_rate in 1/s from "
                "'shear_rate_1/s', shear_stress in Pa"));
}

TEST(RheometryExports, SpindlesGiveViscosity) {
  SampleFacts options;
  options.spindle = "LV-62";  // 300 mPa s for each rpm and per cent
  for (const char* text : {"rpm,% torque\n6,20\n12,40\n18,60\n30,100\n",
                           "Speed (RPM),Dial reading\n6,20\n12,40\n18,60\n30,100\n",
                           "rpm,cP\n6,1000\n12,1000\n18,1000\n30,1000\n",
                           "rpm,Torque (dyn cm)\n6,134.74\n12,269.48\n18,404.22\n30,673.7\n"}) {
    const Measurements m = read(text, options);
    for (std::size_t k = 0; k < m.curve.rate.size(); ++k)
      EXPECT_NEAR(m.curve.stress[k] / m.curve.cylinders->nominal_rate(m.curve.rate[k]), 1, 1e-9) << text;
  }
  options.height = 0.1;
  EXPECT_THAT(refusal("rpm,% torque\n6,20\n12,40\n18,60\n30,100\n", options),
              HasSubstr("a spindle and radii"));
  EXPECT_THAT(refusal("# spindle = LV-7\nrpm,% torque\n6,20\n"),
              HasSubstr("x.csv:1: key 'spindle': value \"LV-7\""));
  EXPECT_THAT(refusal("rpm,cP\n6,20\n12,20\n"),
              HasSubstr("x.csv:1: rotation and viscosity need the spindle"));
}

TEST(RheometryExports, SpindlesOfLinesOfText) {
  const std::string rows = "U/min;Skalenwert\n6;20 %\n12;40 %\n18;60 %\n30;100 %\n";
  for (const char* line : {"Spindel;LV2;", "Spindle: 62;", "Brookfield LVT;;\nSpindel;2;", "# Spindel = LV-2",
                           "Modell;DV2TLV;\nSpindel;2;"}) {
    const Measurements m = read(line + std::string("\n") + rows);
    EXPECT_EQ(m.facts.spindle, "LV-2") << line;
  }
  EXPECT_THAT(refusal("Spindel;2;\n" + rows), HasSubstr("--spindle"));
}

TEST(RheometryExports, AnotherViscosityThanTheSpindlesIsTold) {
  const auto warnings = [](const std::string& spindle) {
    return read("# spindle = " + spindle +
                "\nrpm;% torque;Viscosity (mPa.s)\n6;20;1000\n12;40;1000\n18;60;1000\n30;100;1000\n")
        .warnings;
  };
  EXPECT_THAT(warnings("LV-2"), IsEmpty());
  EXPECT_THAT(warnings("LV-3"),
              ElementsAre(HasSubstr("x.csv:3: the file gives a viscosity of 1 Pa s, rotation "
                                    "and torque 4 Pa s: the wrong spindle")));
}

TEST(RheometryExports, ATemperatureThatVariesIsTold) {
  const auto warnings = [](const std::string& last) {
    return read("Shear Rate [1/s];Shear Stress [Pa];Temperature\n1;3;1400\n2;4;1401\n5;7;1401\n10;12;" +
                last + "\n")
        .warnings;
  };
  EXPECT_THAT(warnings("1402"), testing::Not(testing::Contains(HasSubstr("temperature"))));
  EXPECT_THAT(warnings("1350"), testing::Contains(HasSubstr("the temperature goes from 1350 to 1401")));
}

TEST(RheometryExports, ADensityInGramsIsTold) {
  SampleFacts options;
  options.density = 2.6;
  EXPECT_THAT(
      read(std::string(names) + "1,3\n2,4\n5,7\n10,12\n", options).warnings,
      ElementsAre(HasSubstr("--density 2.6 kg/m3 is less than any melt's: is it meant in g/cm3? Then 2600")));
}

TEST(RheometryExports, RadiiOfMillimetresAsMetresAreTold) {
  SampleFacts options;
  options.bob_radius = 20, options.cup_radius = 21, options.height = 50;
  EXPECT_THAT(read("rpm,torque_mNm\n1,2\n2,3\n3,4\n4,5\n", options).warnings,
              testing::Contains(HasSubstr(
                  "--bob-radius 20 m is larger than any viscometer's: is it meant in mm? Then 0.02 m")));
}

TEST(RheometryExports, AUnitMayFollowTheValueOfAKey) {
  for (const char* line :
       {"# density = 2,6 g/cm3", "# Dichte = 2,6 g/cm3", "# density_g/cm3 = 2,6", "# Dichte = 2600 kg/m3"})
    EXPECT_DOUBLE_EQ(
        read(line + std::string("\n") + names + "1,3\n2,4\n5,7\n10,12\n").facts.density.value_or(0), 2600)
        << line;
  EXPECT_THAT(refusal("# density = 2.6\n" + std::string(names) + "1,3\n2,4\n5,7\n10,12\n"),
              HasSubstr("has no unit"));
}

}  // namespace
}  // namespace slagflow
