// Keys of heat: what is allowed, what each refusal says, and that a resolved case is the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "heat/heat.hpp"
#include "heat/material_table.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/run/check.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const hot = R"(
[case]
name = "hot"
[resolution]
spacing = 0.01
[thermal]
ambient_temperature = 298
surface_heat_transfer = 15
[fluid.slag]
density = 2750
rheology = "bingham"
liquid_viscosity = {law = "weymann", A = 3.008e-9, B = 19826}
suspension = "einstein-roscoe"
critical_fraction = 0.6
exponent = 2.5
solid_fraction = [[1473, 1.0], [1573, 0.5], [1623, 0.2], [1673, 0.0]]
yield_stress = [[0.2, 0], [0.4, 5], [0.5, 50], [0.6, 500]]
latent_heat = 2.09e5
heat_capacity = [[298, 900], [1473, 1150], [1673, 1350]]
conductivity = [[298, 1.0], [1473, 1.5], [1673, 0.7]]
emissivity = 0.85
[[region]]
shapes = [{shape="box", min=[0,0,0], max=[0.1,0.1,0.1]}]
temperature = 1773
[[wall]]
name = "runner"
shapes = [{shape="box", min=[0,0,-0.04], max=[0.1,0.1,0]}]
thermal = "semi_infinite"
temperature = 298
contact_heat_transfer = 1000
conductivity = 40
density = 7850
heat_capacity = 550
[domain]
min = [0, 0, -0.04]
max = [0.1, 0.1, 0.2]
[output]
end_time = 10
interval = 1
)";

std::string error_of(const std::vector<std::string>& overrides) {
  try {
    build_setup(parse_case(hot, "h.toml", overrides));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(CaseThermal, TakesACaseAndWritesItBack) {
  const Case c = parse_case(hot, "h.toml");
  EXPECT_TRUE(c.thermal.on);
  EXPECT_EQ(c.thermal.reference_temperature, 1773);
  EXPECT_NEAR(c.fluids[0].parameters[0], 3.008e-9 * 1773 * std::exp(19826.0 / 1773), 1e-6);
  EXPECT_EQ(c.fluids[0].parameters[1], 0);
  const std::string written = to_toml(c);
  const Case again = parse_case(written, "again.toml");
  EXPECT_EQ(to_toml(again), written);
  const MaterialSetup &a = c.fluids[0].material, &b = again.fluids[0].material;
  EXPECT_EQ(a.solid_fraction, b.solid_fraction);
  EXPECT_EQ(a.yield_stress, b.yield_stress);
  EXPECT_EQ(a.liquid.a, b.liquid.a);
  EXPECT_EQ(static_cast<int>(again.walls[0].thermal.kind), static_cast<int>(WallHeat::semi_infinite));
}

TEST(CaseThermal, LiquidViscosityMayBeANumberOrRows) {
  EXPECT_EQ(error_of({"fluid.slag.liquid_viscosity=0.5"}), "accepted");
  EXPECT_EQ(error_of({"fluid.slag.liquid_viscosity=[[1400, 2], [1800, 0.3]]"}), "accepted");
  EXPECT_EQ(error_of({"fluid.slag.liquid_viscosity={law='vft', A=1e-4, B=8000, T0=700}"}), "accepted");
  const Case c = parse_case(hot, "h.toml", {"fluid.slag.liquid_viscosity=[[1400, 2], [1800, 0.3]]"});
  EXPECT_EQ(to_toml(parse_case(to_toml(c), "again.toml")), to_toml(c));
}

TEST(CaseThermal, FreezingByAPhaseDiagram) {
  const std::string table =
      "fluid.slag={density=2750, rheology='newtonian', dynamic_viscosity=1, heat_capacity=1000, "
      "conductivity=1, latent_heat=1e5, freezing=";
  const std::string straight = "liquidus=1600, solvent_melting_point=1800, partition=0.5";
  const auto made = [&](const std::string& law) {
    return parse_case(
               hot, "h.toml",
               {table + "{law='" + law + "', " + straight + (law == "scheil" ? ", eutectic=1300}}" : "}}")})
        .fluids[0]
        .material.solid_fraction;
  };
  // Lever: solid at 1800 - 200/0.5, half solid where 1600 - T = 0.25 (1800 - T).
  EXPECT_NEAR(made("lever").front()[0], 1400, 1e-9);
  EXPECT_NEAR(value_at(made("lever"), 1600 - 0.25 * 200 / 0.75), 0.5, 2e-3);
  // Scheil: (T_m - T)/(T_m - T_l) = 2.5 at the eutectic leaves 1/2.5^2 of liquid, which freezes there.
  EXPECT_EQ(made("scheil")[0], (std::array<double, 2>{1300, 1}));
  EXPECT_NEAR(made("scheil")[1][1], 1 - 1 / 6.25, 1e-9);
  EXPECT_THAT(error_of({"fluid.slag.freezing={law='lever', " + straight + "}"}),
              HasSubstr("stands beside solid_fraction"));
}

struct Refusal {
  std::string override, key, says;
};
class ThermalRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(ThermalRefusals, SayWhatIsAllowed) {
  const auto& [override, key, says] = GetParam();
  EXPECT_THAT(error_of({override}), AllOf(HasSubstr("key '" + key), HasSubstr(says), HasSubstr("allowed: ")));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, ThermalRefusals,
    testing::Values(
        Refusal{"region.0.temperature=1500.5e-1", "region.0.temperature", "kelvin, not degrees Celsius?"},
        Refusal{"region.0.temperature=25", "region.0.temperature", "kelvin, not degrees Celsius?"},
        Refusal{"region.0.temperature=5000", "region.0.temperature", ">= 200.0 and <= 4000.0 [K]"},
        Refusal{"wall.0.temperature=25", "wall.0.temperature", "kelvin, not degrees Celsius?"},
        Refusal{"thermal.ambient_temperature=25", "thermal.ambient_temperature", "kelvin"},
        Refusal{"fluid.slag.solid_fraction=[[1200, 1], [1400, 0.5], [1400.5, 0.6], [1500, 0]]",
                "fluid.slag.solid_fraction", "out of range or order"},
        Refusal{"fluid.slag.solid_fraction=[[1500, 0], [1200, 1]]", "fluid.slag.solid_fraction", "follows"},
        Refusal{"fluid.slag.solid_fraction=[[1200, 0.9], [1500, 0]]", "fluid.slag.solid_fraction",
                "from 1 to 0"},
        Refusal{"fluid.slag.solid_fraction=[[20, 1], [1500, 0]]", "fluid.slag.solid_fraction", "kelvin"},
        Refusal{"fluid.slag.conductivity=0", "fluid.slag.conductivity", "> 0"},
        Refusal{"fluid.slag.conductivity=[[300, 1], [400, -1]]", "fluid.slag.conductivity", "out of range"},
        Refusal{"fluid.slag.heat_capacity=[[400, 900], [300, 900]]", "fluid.slag.heat_capacity", "follows"},
        Refusal{"fluid.slag.latent_heat=-1", "fluid.slag.latent_heat", ">= 0"},
        Refusal{"fluid.slag.emissivity=1.2", "fluid.slag.emissivity", "<= 1"},
        Refusal{"fluid.slag.yield_stress=[[0.2, 0], [0.5, 50]]", "fluid.slag.yield_stress",
                "ends at the solid fraction"},
        Refusal{"fluid.slag.liquid_viscosity={law='arrhenius', A=3.008e-9, B=60000}",
                "fluid.slag.liquid_viscosity", "A in Pa s"},
        Refusal{"fluid.slag.liquid_viscosity={law='vft', A=1e-4, B=8000, T0=1600}",
                "fluid.slag.liquid_viscosity", "T0"},
        Refusal{"fluid.slag.liquid_viscosity={law='weyman', A=1, B=1}", "fluid.slag.liquid_viscosity.law",
                "weymann"},
        Refusal{"wall.0.thermal='hot'", "wall.0.thermal", "semi_infinite"},
        Refusal{"wall.0.thermal='flux'", "wall.0.heat_flux", "missing"},
        Refusal{"wall.0.contact_heat_transfer=0", "wall.0.contact_heat_transfer", "\"perfect\""},
        Refusal{"wall.0.surface_velocity=[1, 0, 0]", "wall.0.thermal", "surface_velocity"},
        Refusal{"thermal.surface_heat_transfer=-1", "thermal.surface_heat_transfer", ">= 0"},
        Refusal{"thermal.flow_until=-1", "thermal.flow_until", "or \"end_time\""},
        Refusal{"numerics.viscous_step='explicit'", "numerics.viscous_step", "implicit"},
        Refusal{"numerics.scheme='paper'", "numerics.theta", "backward Euler"}));

TEST(CaseThermal, WithoutTheTableItsKeysAreRefused) {
  std::string cold = hot;
  cold.erase(cold.find("[thermal]"), cold.find("[fluid.slag]") - cold.find("[thermal]"));
  std::string error;
  try {
    parse_case(cold, "c.toml");
  } catch (const InputError& e) {
    error = e.what();
  }
  EXPECT_THAT(error,
              HasSubstr("key 'region.0.temperature': does not go with the other keys: heat is off: a table "
                        "[thermal] switches it on"));
  EXPECT_THAT(error, HasSubstr("key 'wall.0.thermal'"));
  EXPECT_THAT(error, HasSubstr("key 'fluid.slag.heat_capacity'"));
}

TEST(CaseThermal, WhatIsMissingIsSaid) {
  std::string text = hot;
  const auto take_out = [&](const std::string& line) { text.erase(text.find(line), line.size()); };
  take_out("temperature = 1773"), take_out("conductivity = [[298, 1.0], [1473, 1.5], [1673, 0.7]]");
  std::string error;
  try {
    parse_case(text, "c.toml");
  } catch (const InputError& e) {
    error = e.what();
  }
  EXPECT_THAT(error, HasSubstr("region.0.temperature"));
  EXPECT_THAT(error, HasSubstr("fluid.slag.conductivity"));
  EXPECT_THAT(error_of({"measure=[{name='s', type='solid', min=[0,0,0], max=[0.1,0.1,0.1]}, "
                        "{name='q', type='heat', wall='runner'}]"}),
              "accepted");
}

// Half a spacing of 10 mm conducts less than the surface radiates; 10 s are too short for such a spacing.
TEST(CaseThermal, CheckTellsWhatIsNotResolved) {
  const CaseCheck check = check_case(build_setup(parse_case(hot, "h.toml")));
  ASSERT_TRUE(check.heat.on);
  EXPECT_NEAR(check.heat.fluids[0].diffusivity, 1.5 / (2750 * 900), 1e-12);
  const double radiant = 4 * 0.85 * 5.670374e-8 * std::pow(1773.0, 3);
  EXPECT_NEAR(check.heat.fluids[0].half_cell_biot, (15 + radiant) * 0.01 / (2 * 0.7), 1e-6);
  EXPECT_NEAR(check.heat.fluids[0].stefan, 1350 * 300 / 2.09e5, 1e-6);
  EXPECT_NEAR(check.heat.contacts[0].temperature, 428, 60);
  EXPECT_THAT(check.warnings, testing::Contains(HasSubstr("heat to walls is right within 5 % only from")));
  EXPECT_THAT(check.warnings, testing::Contains(HasSubstr("the surface's temperature is not resolved")));
  EXPECT_THAT(to_text(check), HasSubstr("conduction is stable up to steps of"));
}

TEST(CaseThermal, CheckCountsTheStepsOfHeatAlone) {
  const auto check = [](const std::string& until) {
    return check_case(
        build_setup(parse_case(hot, "h.toml", {"output.end_time=3600", "thermal.flow_until=" + until})));
  };
  const CaseCheck alone = check("0"), both = check("1");
  EXPECT_THAT(check("3600").warnings, testing::Contains(HasSubstr("the flow goes on to the end")));
  EXPECT_THAT(both.warnings, testing::Not(testing::Contains(HasSubstr("the flow goes on to the end"))));
  const auto cooling = [](double duration, double longest) {
    double steps = 0;
    for (double t = 0; t < duration; t += cooling_time_step(longest, t)) ++steps;
    return steps;
  };
  EXPECT_NEAR(alone.steps, cooling(3600, alone.heat.time_step), 2);
  EXPECT_NEAR(both.steps, std::ceil(1 / both.time_step) + cooling(3599, both.heat.time_step), 2);
  EXPECT_THAT(to_text(both),
              HasSubstr("such steps, or max_time_step, are taken from 1 s on, when nothing moves any more"));
  const CaseCheck shorter = check_case(build_setup(parse_case(
      hot, "h.toml", {"output.end_time=3600", "thermal.flow_until=0", "numerics.max_time_step=0.01"})));
  EXPECT_EQ(shorter.steps, 360000);
  const Case c = parse_case(hot, "h.toml", {"thermal.flow_until=7"});
  EXPECT_EQ(parse_case(to_toml(c), "again.toml").thermal.flow_until, 7);
}

// 40 mm of steel: (20 mm)^2 over 40/(7850 550) m^2/s.
TEST(CaseThermal, CheckTellsWhenAThickWallIsFeltThrough) {
  const auto check = [](const std::string& end) {
    return check_case(build_setup(parse_case(hot, "h.toml", {"output.end_time=" + end})));
  };
  ASSERT_EQ(check("10").heat.thick_walls.size(), 1);
  EXPECT_NEAR(check("10").heat.thick_walls[0].felt, 4e-4 * 7850 * 550 / 40, 0.5);
  EXPECT_THAT(to_text(check("10")), HasSubstr("'runner', 0.04 m thick, is felt through after 43.2 s"));
  EXPECT_THAT(check("10").warnings, testing::Not(testing::Contains(HasSubstr("semi_infinite"))));
  EXPECT_THAT(check("60").warnings, testing::Contains(HasSubstr("felt through from 43.2 s on")));
}

// However fine the spacing is.
TEST(CaseThermal, CheckLooksThroughAWallOfManySpacings) {
  const auto check = [](const std::string& end) {
    return check_case(
        build_setup(parse_case(hot, "h.toml",
                               {"output.end_time=" + end, "resolution.spacing=0.00125",
                                "region.0.shapes=[{shape=\"box\", min=[0,0,0], max=[0.01,0.01,0.01]}]"})));
  };
  EXPECT_THAT(check("60").warnings, testing::Contains(HasSubstr("felt through from 43.2 s on")));
  EXPECT_THAT(check("10").warnings, testing::Not(testing::Contains(HasSubstr("semi_infinite"))));
}

TEST(CaseThermal, CheckTellsOfAnInletOfSolidFluid) {
  const auto check = [](const std::string& temperature) {
    return check_case(build_setup(parse_case(
        hot, "h.toml",
        {"inlet=[{name='feed', face='rectangle', center=[0.05, 0.05, 0.15], width=0.05, height=0.05, "
         "normal=[0, 0, -1], velocity=0.1, temperature=" +
         temperature + "}]"})));
  };
  EXPECT_THAT(check("1540").warnings, testing::Contains(HasSubstr("inlet 'feed': fluid 'slag' is solid at")));
  EXPECT_THAT(check("1560").warnings, testing::Not(testing::Contains(HasSubstr("is solid at"))));
}

}  // namespace
}  // namespace slagflow
