// Fluids that single precision does not hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string error_of(const std::vector<std::string>& overrides) {
  try {
    build_setup(parse_case(testing_tools::tiny_case(), "t.toml", overrides));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

std::string error_of_fluid(const std::string& law) {
  return error_of({"fluid.oil={density=965, rheology=" + law + "}"});
}

TEST(CaseFluids, ViscosityAtRestIsBounded) {
  EXPECT_THAT(error_of({"fluid.oil.growth_exponent=1e29"}),
              AllOf(HasSubstr("'fluid.oil.growth_exponent': value 1e+29 gives a viscosity of 5e+29 Pa s"),
                    HasSubstr("<= 1e+12 [Pa s]")));
  EXPECT_EQ(error_of({"fluid.oil.growth_exponent=1e6", "fluid.oil.yield_stress=1e5"}), "accepted");
  EXPECT_THAT(error_of({"fluid.oil.plastic_viscosity=1e13"}),
              HasSubstr("'fluid.oil.plastic_viscosity': value 1e+13"));
  EXPECT_THAT(error_of_fluid("'newtonian', dynamic_viscosity=1e24"),
              HasSubstr("'fluid.oil.dynamic_viscosity'"));
  const std::string power = "'herschel-bulkley', flow_index=0.01, yield_stress=0, ";
  EXPECT_THAT(error_of_fluid(power + "consistency=1, growth_exponent=1e30"),
              HasSubstr("'fluid.oil.growth_exponent'"));
  EXPECT_THAT(error_of_fluid(power + "consistency=1e20"), HasSubstr("gives a viscosity of"));
  EXPECT_THAT(error_of_fluid("'casson', casson_viscosity=1, yield_stress=1e10"),
              HasSubstr("'fluid.oil.growth_exponent'"));
  EXPECT_THAT(error_of_fluid("'bi-viscous', plastic_viscosity=1e10, yield_stress=1"),
              HasSubstr("'fluid.oil.plastic_viscosity'"));
  EXPECT_THAT(
      error_of_fluid("'carreau-yasuda', zero_shear_viscosity=1e20, relaxation_time=1, flow_index=0.5"),
      HasSubstr("'fluid.oil.zero_shear_viscosity'"));
}

TEST(CaseFluids, DensityAndSoundSpeedHaveBothBounds) {
  for (const char* const value : {"1e-300", "1e-30", "1e20"})
    EXPECT_THAT(error_of({std::string("fluid.oil.density=") + value}),
                HasSubstr("allowed: a number >= 0.001 and <= 1e+06 [kg/m^3]"));
  for (const char* const value : {"1e-20", "1e20"})
    EXPECT_THAT(error_of({std::string("numerics.sound_speed=") + value}),
                HasSubstr("allowed: a number >= 1e-06 and <= 1e+06 [m/s"));
}

TEST(CaseFluids, BackgroundPressureStaysBelowTheLimitOfCompression) {
  EXPECT_THAT(error_of({"numerics.background_pressure=1e9"}),
              AllOf(HasSubstr("'numerics.background_pressure': value 1e+09"),
                    HasSubstr("allowed: >= 0 and <= 7237.5 [Pa]")));
  EXPECT_EQ(error_of({"numerics.background_pressure=7000"}), "accepted");
}

}  // namespace
}  // namespace slagflow
