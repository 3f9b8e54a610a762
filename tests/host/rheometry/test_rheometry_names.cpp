#include <gtest/gtest.h>

#include "host/rheometry/rheometry_spindles.hpp"
#include "host/rheometry/rheometry_units.hpp"

namespace slagflow {
namespace {

struct Header {
  const char* name;
  Quantity quantity;
  double factor;
};

TEST(RheometryNames, KnowsTheFormsOfMakersAndLanguages) {
  using Q = Quantity;
  constexpr double turn = 6.283185307179586;
  const Header headers[] = {{"shear_rate_1/s", Q::shear_rate, 1},
                            {"Shear Rate [1/s]", Q::shear_rate, 1},
                            {"Shear rate (s^-1)", Q::shear_rate, 1},
                            {"SHEAR RATE, 1/S", Q::shear_rate, 1},
                            {"GP in 1/s", Q::shear_rate, 1},
                            {"\xCE\xB3\xCC\x87 / s\xE2\x81\xBB\xC2\xB9", Q::shear_rate, 1},
                            {"Scherrate [1/min]", Q::shear_rate, 1.0 / 60},
                            {"Shear rate, 1/s (corrected)", Q::shear_rate, 1},
                            {"Shear Stress \xCF\x84 [Pa]", Q::shear_stress, 1},
                            {"Shear Stress (dyne/cm\xC2\xB2)", Q::shear_stress, 0.1},
                            {"Stress [MPa]", Q::shear_stress, 1e6},
                            {"Viscosity (cP)", Q::viscosity, 1e-3},
                            {"Viskosit\xC3\xA4t [mPa\xC2\xB7s]", Q::viscosity, 1e-3},
                            {"viscosity, mpa.s", Q::viscosity, 1e-3},
                            {"Eta in P", Q::viscosity, 0.1},
                            {"Viscosity [Pa.s]", Q::viscosity, 1},
                            {"Speed (RPM)", Q::rotation, turn / 60},
                            {"rpm", Q::rotation, turn / 60},
                            {"n [1/min]", Q::rotation, turn / 60},
                            {"Speed in Hz", Q::rotation, turn},
                            {"Angular velocity [rad/s]", Q::rotation, 1},
                            {"Torque (\xC2\xB5N\xC2\xB7m)", Q::torque, 1e-6},
                            {"Torque [dyn cm]", Q::torque, 1e-7},
                            {"M in mNm", Q::torque, 1e-3},
                            {"% Torque", Q::torque, 0.01},
                            {"Torque %", Q::torque, 0.01},
                            {"Dial reading", Q::torque, 0.01}};
  for (const Header& header : headers) {
    const NamedQuantity named = parse_name(header.name);
    EXPECT_TRUE(named.known && named.unit_known) << header.name;
    EXPECT_EQ(named.quantity, header.quantity) << header.name;
    EXPECT_DOUBLE_EQ(named.factor, header.factor) << header.name;
  }
}

TEST(RheometryNames, KnowsTemperatures) {
  struct Temperature {
    const char* name;
    double one;  // [K] that a value of 1 is
  };
  for (const Temperature& header :
       std::initializer_list<Temperature>{{"temperature_K", 1},
                                          {"T [°C]", 274.15},
                                          {"T(C)", 274.15},
                                          {"T/K", 1},
                                          {"Temperatur / °C", 274.15},
                                          {"Temp. in ℃", 274.15},
                                          {"Température (ºC)", 274.15},
                                          {"温度 [℃]", 274.15},
                                          {"Sample temperature, degC", 274.15},
                                          {"temperature [°F]", 5.0 / 9 * (1 - 32) + 273.15}}) {
    const NamedQuantity named = parse_name(header.name);
    EXPECT_TRUE(named.known && named.unit_known) << header.name;
    EXPECT_EQ(named.quantity, Quantity::temperature) << header.name;
    EXPECT_NEAR(named.si(1), header.one, 1e-9) << header.name;
  }
  EXPECT_FALSE(parse_name("t [s]").unit_known);
  EXPECT_FALSE(parse_name("Temperature set [°C]").known);
}

TEST(RheometryNames, KnowsNoOtherQuantities) {
  for (const char* name :
       {"Normal stress [Pa]", "Shear stress amplitude [Pa]", "Torque limit", "Complex viscosity [Pa.s]",
        "Status", "mass [kg]", "number", "Speed setting [rpm]", ""})
    EXPECT_FALSE(parse_name(name).known) << name;
}

TEST(RheometryNames, RefusesUnitsThatMayBeTwo) {
  EXPECT_FALSE(parse_name("Viscosity [MPA.S]").unit_known);
  EXPECT_FALSE(parse_name("Angular velocity [1/s]").unit_known);
  EXPECT_FALSE(parse_name("Shear stress [psi]").unit_known);
  EXPECT_FALSE(parse_name("Shear stress [Pa.s]").unit_known);
  EXPECT_DOUBLE_EQ(parse_name("Viscosity [MPa.s]").factor, 1e6);
}

TEST(RheometrySpindles, HaveTheMakersFactors) {
  // Viscosity at 100 % of scale and 60 rpm, as dials print it: 100, 500, 2000 and 10000 mPa s.
  const double at_60_rpm[] = {0.1, 0.5, 2, 10};
  for (int k = 0; k < 4; ++k) {
    const Spindle spindle = find_spindle("LV-" + std::to_string(k + 1)).value();
    EXPECT_NEAR(spindle.factor / 60, at_60_rpm[k], 1e-12);
    const Cylinders like = spindle.cylinders();
    EXPECT_NEAR(like.bob_stress(67.37e-6) / like.nominal_rate(6.283185307179586), at_60_rpm[k], 1e-9);
  }
  EXPECT_DOUBLE_EQ(find_spindle("RV3").value().factor, 100);
}

TEST(RheometrySpindles, HaveManyNames) {
  for (const char* name : {"LV-2", "LV2", "lv 2", "LVT 2", "LV-62", "62", "S62", "spindle 62"})
    EXPECT_EQ(find_spindle(name).value().name, "LV-2") << name;
  for (const char* name :
       {"", "2", "LV-0", "LV-5", "RV-8", "60", "LV", "LV-2x", "LV--", "SC4-21", "99999999999"})
    EXPECT_FALSE(find_spindle(name).has_value()) << name;
}

}  // namespace
}  // namespace slagflow
