// Viscosity over temperature: what is read as that, the fits, and the table that a case takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/rheometry/rheometry_melt.hpp"
#include "host/rheometry_command.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing_tools::hot_case_with;
using testing_tools::read_text_file;
using testing_tools::rheometry_command;
using testing_tools::Said;
using testing_tools::TempFolder;

// Urbain's viscosity of the blast furnace slag of 42 CaO, 36 SiO2, 14 Al2O3, 8 MgO.
double slag(double t) { return 3.008e-9 * t * std::exp(19826 / t); }
double glass(double t) { return 1e-3 * std::exp(4500 / (t - 900)); }

template <class Law>
ViscositySeries series_of(Law law, double noise = 0) {
  ViscositySeries s;
  const double errors[] = {1, -0.5, 0.3, -1, 0.8, -0.2, 0.6, -0.9, 0.1, 0.4, -0.7};
  for (int k = 0; k <= 10; ++k) {
    s.temperature.push_back(1600 + 30.0 * k);
    s.viscosity.push_back(law(s.temperature.back()) * (1 + noise * errors[k]));
  }
  return s;
}

std::string csv_of(const ViscositySeries& s, const std::string& head) {
  std::string text = head + "\n";
  for (std::size_t k = 0; k < s.count(); ++k)
    text += std::to_string(s.temperature[k]) + "," + std::to_string(s.viscosity[k]) + "\n";
  return text;
}

std::string refusal(const std::string& text, const SampleFacts& options = {}) {
  try {
    parse_measurements(text, "x.csv", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string rows = "1400,1.2\n1450,0.8\n1500,0.55\n1550,0.4\n1600,0.3\n";

TEST(RheometryMelt, ReadsTemperaturesInManyUnits) {
  for (const auto& [head, first] :
       {std::pair{"temperature_C,viscosity_Pas", 1673.15}, std::pair{"T [K],η / Pa·s", 1400.0},
        std::pair{"Temperatur / °C,Viskosität (Pa s)", 1673.15}, std::pair{"温度 [℃],粘度 [Pa·s]", 1673.15},
        std::pair{"Température (°F),Viscosité (Pa.s)", (1400 - 32) / 1.8 + 273.15}}) {
    const Measurements m = parse_measurements(std::string(head) + "\n" + rows, "x.csv");
    ASSERT_EQ(m.series.count(), 5u) << head;
    EXPECT_NEAR(m.series.temperature[0], first, 1e-9) << head;
    EXPECT_DOUBLE_EQ(m.series.viscosity[4], 0.3) << head;
    EXPECT_TRUE(m.curve.rate.empty()) << head;
    EXPECT_TRUE(m.warnings.empty()) << head;
    EXPECT_THAT(m.how, AllOf(HasSubstr("temperature in"), HasSubstr("viscosity in")));
  }
}

TEST(RheometryMelt, SortsAndReadsDecimalCommas) {
  const Measurements m =
      parse_measurements("T [°C];Viskosität [dPa s]\n1600;3,05\n1400;12,1\n1500;5,5\n", "x.csv");
  EXPECT_THAT(m.series.viscosity, ElementsAre(1.21, 0.55, testing::DoubleEq(0.305)));
}

TEST(RheometryMelt, TakesWhatVaries) {
  const std::string at_one_rate = "T_C,shear_rate_1/s,shear_stress_Pa\n1400,10,12\n1450,10,8\n1500,10,5.5\n";
  EXPECT_THAT(parse_measurements(at_one_rate, "x.csv").series.viscosity,
              ElementsAre(testing::DoubleEq(1.2), testing::DoubleEq(0.8), testing::DoubleEq(0.55)));
  const std::string both = "T_C,shear_rate_1/s,shear_stress_Pa\n1400,1,1\n1403,2,2\n1406,4,4\n1410,8,8\n";
  const Measurements m = parse_measurements(both, "x.csv");
  EXPECT_EQ(m.curve.rate.size(), 4u);
  EXPECT_THAT(m.warnings, testing::Contains(HasSubstr("--over-temperature")));
  SampleFacts forced;
  forced.over_temperature = true;
  EXPECT_EQ(parse_measurements(both, "x.csv", forced).series.count(), 4u);
  EXPECT_THAT(refusal("shear_rate_1/s,shear_stress_Pa\n1,1\n2,2\n4,4\n8,8\n", forced),
              HasSubstr("x.csv:1: no temperature with a unit"));
}

TEST(RheometryMelt, TakesRotationAndViscosityWithoutASpindle) {
  const Measurements m = parse_measurements(
      "T_C,rpm,viscosity_mPas\n1400,30,1200\n1450,30,800\n1500,30,550\n1550,30,400\n", "x.csv");
  EXPECT_DOUBLE_EQ(m.series.viscosity[0], 1.2);
}

TEST(RheometryMelt, LeavesFlowCurvesOfOneTemperatureAlone) {
  const Measurements m = parse_measurements(
      "T_C,shear_rate_1/s,viscosity_Pas\n1400,1,2\n1400.5,3,1.5\n1401,9,1.2\n1400,20,1.1\n", "x.csv");
  EXPECT_EQ(m.curve.rate.size(), 4u);
  EXPECT_TRUE(m.series.empty());
}

TEST(RheometryMelt, RefusesWhatIsNoSeries) {
  EXPECT_THAT(refusal("temperature,viscosity_Pas\n" + rows),
              AllOf(HasSubstr("x.csv:1: column 'temperature' has no unit that is known"),
                    HasSubstr("allowed: temperature_K, temperature_C, temperature_F")));
  EXPECT_THAT(refusal("T_K,viscosity_Pas\n25,1\n30,2\n"),
              AllOf(HasSubstr("x.csv:2: column 'T_K': value 25: allowed: > 200 to 4000"),
                    HasSubstr("is the unit right?")));
  EXPECT_THAT(refusal("T_C,viscosity_Pas\n1400,x\n1450,2\n"),
              HasSubstr("x.csv:2: column 'viscosity_Pas': value \"x\" is not a number"));
  EXPECT_THAT(refusal("T_C,viscosity_Pas\n1400,-1\n1450,2\n"), HasSubstr("value -1: allowed: > 0"));
  EXPECT_THAT(refusal("T_C,viscosity_Pas\n1400,1\n1405,2\n"),
              HasSubstr("2 readings over a range of temperature of 5 K: allowed: at least 10 K"));
}

TEST(RheometryMelt, WarnsWhereHeatingAndCoolingDiffer) {
  const Measurements m =
      parse_measurements("T_C,viscosity_Pas\n1400,1.2\n1500,0.55\n1600,0.3\n1500,0.8\n", "x.csv");
  EXPECT_THAT(m.warnings, ElementsAre(AllOf(HasSubstr("x.csv:5:"), HasSubstr("of line 3"),
                                            HasSubstr("heating and cooling"))));
}

TEST(RheometryMelt, FindsTheConstantsThatMadeTheReadings) {
  const MeltFit weymann = fit(LiquidLaw::weymann, series_of(slag));
  EXPECT_NEAR(weymann.a.value / 3.008e-9, 1, 1e-6);
  EXPECT_NEAR(weymann.b.value, 19826, 1e-2);
  const MeltFit vft = fit(LiquidLaw::vft, series_of(glass));
  EXPECT_NEAR(vft.a.value / 1e-3, 1, 1e-4);
  EXPECT_NEAR(vft.b.value / 4500, 1, 1e-4);
  EXPECT_NEAR(vft.t0.value, 900, 0.1);
  EXPECT_NEAR(vft.viscosity(1500), glass(1500), 1e-5);
  EXPECT_EQ(fit_all(series_of(slag)).front().law, LiquidLaw::weymann);
  EXPECT_EQ(fit_all(series_of(glass)).front().law, LiquidLaw::vft);
  const auto arrhenius = [](double t) { return 1e-5 * std::exp(18000 / t); };
  EXPECT_EQ(fit_all(series_of(arrhenius)).front().law, LiquidLaw::arrhenius);
}

TEST(RheometryMelt, IntervalsHoldTheConstants) {
  const MeltFit f = fit(LiquidLaw::weymann, series_of(slag, 0.02));
  EXPECT_TRUE(f.a.low < 3.008e-9 && 3.008e-9 < f.a.high);
  EXPECT_TRUE(f.b.low < 19826 && 19826 < f.b.high);
  EXPECT_GT(f.a.low, 0);
  EXPECT_NEAR(f.residual, 0.013, 0.003);
}

TEST(RheometryMelt, TellsWhereFreezingBegins) {
  const auto freezing = [](double t) { return slag(t) * std::exp(std::max(0.0, 1700 - t) / 50); };
  const ViscositySeries s = series_of(freezing, 0.02);
  const std::optional<Kink> kink = find_kink(s, fit_all(s));
  ASSERT_TRUE(kink.has_value());
  EXPECT_NEAR(kink->temperature, 1700, 31);
  EXPECT_NEAR(kink->excess, std::exp(2), 2.5);
  for (const ViscositySeries& smooth : {series_of(slag, 0.02), series_of(glass, 0.02), series_of(slag)})
    EXPECT_FALSE(find_kink(smooth, fit_all(smooth)).has_value());
}

class MeltCommand : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  const TempFolder folder_;
};

TEST_F(MeltCommand, GivesTheViscosityThatACaseTakes) {
  const ViscositySeries s = series_of(slag, 0.02);
  const std::string input = file("bf slag.csv", csv_of(s, "# density_kg/m3 = 2750\nT_K,viscosity_Pas"));
  for (const LiquidLaw law : {LiquidLaw::arrhenius, LiquidLaw::weymann, LiquidLaw::vft}) {
    const bool glassy = law == LiquidLaw::vft;
    const std::string from =
        glassy ? file("glass.csv", csv_of(series_of(glass), "T_K,viscosity_Pas")) : input;
    const Said said = rheometry_command(
        {from, "--model", name_of(law), "-o", folder_ / "o.toml", "--density", "2750", "--name", "melt"});
    ASSERT_EQ(said.code, 0) << said.err;
    const std::string table = read_text_file(folder_ / "o.toml");
    EXPECT_THAT(said.out, HasSubstr(table));
    const Case c = parse_case(hot_case_with(table + "heat_capacity = 1200\nconductivity = 1\n"), "x.toml");
    ASSERT_EQ(c.fluids.size(), 1u);
    EXPECT_EQ(c.fluids[0].name, "melt");
    EXPECT_DOUBLE_EQ(c.fluids[0].density, 2750);
    EXPECT_EQ(c.fluids[0].material.liquid.law, law);
    const MeltFit found = fit(law, glassy ? series_of(glass) : s);
    for (const double t : {1500.0, 1650.0, 1900.0})
      EXPECT_NEAR(std::exp(log_liquid_viscosity(c.fluids[0].material.liquid, t)) / found.viscosity(t), 1,
                  2e-4);
  }
  const std::string curves = read_text_file(folder_ / "o.csv");
  EXPECT_EQ(curves.substr(0, curves.find(',', curves.find(',') + 1)), "temperature_K,measured_Pas");
}

TEST_F(MeltCommand, LeavesOutWhatIsColder) {
  const auto freezing = [](double t) { return slag(t) * std::exp(std::max(0.0, 1700 - t) / 50); };
  const std::string input = file("f.csv", csv_of(series_of(freezing, 0.01), "T_K,viscosity_Pas"));
  EXPECT_THAT(rheometry_command({input}).err,
              AllOf(HasSubstr("the viscosity rises above the trend"), HasSubstr("1720 K (1447 C) down"),
                    HasSubstr("--above 1720")));
  EXPECT_THAT(rheometry_command({input}).out,
              HasSubstr("# From 1720 K (1447 C) down they are above the trend"));
  const Said said = rheometry_command({input, "--above", "1720", "--density", "2700"});
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.err, Not(HasSubstr("trend")));
  EXPECT_THAT(said.out, AllOf(HasSubstr("7 readings over temperature, 1720 K"), HasSubstr("law = ")));
  EXPECT_THAT(rheometry_command({input, "--above", "1850"}).err,
              AllOf(HasSubstr("2 readings above 1850 K are too few to choose a law: allowed: at least 5"),
                    HasSubstr("liquid_viscosity = [[")));
}

TEST_F(MeltCommand, WarnsOfWhatTheReadingsDoNotTell) {
  const std::string narrow =
      file("n.csv", "T_C,viscosity_Pas\n1400,0.70\n1410,0.66\n1420,0.62\n1430,0.58\n1440,0.55\n");
  EXPECT_THAT(rheometry_command({narrow}).err,
              AllOf(HasSubstr("over 40 K alone"), HasSubstr("5 readings are too few to try the law vft")));
  const std::string five = file("v.csv", "T_C,viscosity_Pas\n" + rows);
  EXPECT_THAT(rheometry_command({five, "--model", "vft"}).err,
              HasSubstr("5 readings are too few for the law vft: allowed: at least 6"));
  const std::string straight = file("a.csv", csv_of(series_of(slag), "T_K,viscosity_Pas"));
  const Said none = rheometry_command({straight, "--model", "vft"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err,
              HasSubstr("the law vft fits with no constants that a case allows: allowed: auto, weymann"));
  const std::string rising = file("r.csv", "T_C,viscosity_Pas\n1400,1\n1450,2\n1500,3\n1550,4\n1600,5\n");
  EXPECT_THAT(rheometry_command({rising}).err, HasSubstr("does not fall while the temperature rises"));
}

TEST_F(MeltCommand, RefusesModelsOfTheOtherKind) {
  const std::string melt = file("m.csv", "T_C,viscosity_Pas\n" + rows);
  const std::string flow = file("c.csv", "shear_rate_1/s,shear_stress_Pa\n1,1\n2,2.1\n4,4\n8,8.1\n16,16\n");
  for (const auto& [arguments, what] :
       {std::pair{std::vector<std::string>{melt, "--model", "bingham"}, "--model bingham is of a flow curve"},
        std::pair{std::vector<std::string>{flow, "--model", "vft"},
                  "--model vft is of viscosity over temperature"},
        std::pair{std::vector<std::string>{flow, "--above", "1500"},
                  "--above is of viscosity over temperature"},
        std::pair{std::vector<std::string>{flow, "--model", "urbain"},
                  "--model urbain is of a composition"}}) {
    const Said said = rheometry_command(arguments);
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.err, AllOf(HasSubstr(what), HasSubstr("allowed: ")));
  }
}

}  // namespace
}  // namespace slagflow
