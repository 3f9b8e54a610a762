// From a case to the setup of a simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

std::string error_of(const Case& c) {
  try {
    build_setup(c);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(SetupBuilder, FillsInEverything) {
  Case c = unit_case();
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 2}, {0, 0, 1}}, false}})};
  c.walls[0].slip = WallSlip::free_slip;
  c.body_force = {1, 0, 0};
  MeasureSpec front;
  front.direction = {0, 1};
  front.position = 7;
  MeasureSpec jet;
  jet.type = MeasureType::jet;
  jet.bottom = 1;
  c.measures = {jet, front};
  const BuiltCase built = build_setup(c);
  const SimulationSetup& s = built.setup;
  EXPECT_EQ(s.spacing, 1);
  EXPECT_EQ(s.support_ratio, 2.6);
  EXPECT_TRUE(s.gravity == c.gravity);
  EXPECT_EQ(s.body_acceleration.x, 1);
  EXPECT_EQ(s.fluids.at(0).name, "water");
  EXPECT_EQ(s.fluids.at(0).rest_density, 1000);
  EXPECT_FLOAT_EQ(static_cast<float>(s.fluids.at(0).rheology.parameters[0]), 1e-3f);
  EXPECT_EQ(s.particles.position.size(), 8u);
  EXPECT_EQ(s.particles.velocity.size(), 8u);
  EXPECT_EQ(s.walls.body.size(), s.walls.position.size());
  EXPECT_EQ(s.bodies.at(0).name, "floor");
  EXPECT_EQ(s.bodies.at(0).slip, WallSlip::free_slip);
  ASSERT_EQ(s.fronts.size(), 2u);
  EXPECT_EQ(s.fronts[0].axis, 2);
  EXPECT_EQ(s.fronts[0].sign, -1);
  EXPECT_EQ(s.fronts[0].position, 1);
  EXPECT_EQ(s.fronts[1].axis, 0);
  EXPECT_EQ(s.fronts[1].sign, 1);
  EXPECT_EQ(s.fronts[1].position, 7);
  // The fluid is 2 deep: 11 sqrt(2 g H).
  EXPECT_NEAR(s.numerics.sound_speed, 11 * std::sqrt(2 * 10 * 2.0), 1e-9);
  EXPECT_EQ(built.resolved.numerics.sound_speed, s.numerics.sound_speed);
  EXPECT_NE(to_toml(built.resolved).find("sound_speed = 69.57"), std::string::npos);
}

TEST(SetupBuilder, WarnsOfAFluidThatNoRegionUses) {
  Case c = unit_case();
  const auto unused = testing::HasSubstr("is in no region");
  EXPECT_THAT(build_setup(c).warnings, testing::Not(testing::Contains(unused)));
  c.fluids.push_back(c.fluids[0]);
  c.fluids[1].name = "oil";
  EXPECT_THAT(build_setup(c).warnings, testing::Contains(testing::HasSubstr("fluid 'oil' is in no region")));
}

TEST(SetupBuilder, WarnsOfACaseDrawnInMillimetres) {
  Case c = unit_case();  // a spacing of 1 m
  const auto told = testing::Contains(testing::HasSubstr("if the case is drawn in mm"));
  EXPECT_THAT(build_setup(c).warnings, testing::Not(told));
  c.spacing = 2;
  EXPECT_THAT(build_setup(c).warnings, told);
}

TEST(SetupBuilder, WarnsOfADensityInGramsPerCubicCentimetre) {
  const auto warnings = [](const std::string& density) {
    return build_setup(parse_case(testing_tools::tiny_case(), "t", {"fluid.oil.density=" + density}))
        .warnings;
  };
  EXPECT_THAT(warnings("2.7"), testing::Contains(testing::HasSubstr("meant in g/cm^3? Then density = 2700")));
  EXPECT_THAT(warnings("965"), testing::Not(testing::Contains(testing::HasSubstr("g/cm^3"))));
}

// eta/sqrt(rho sigma spacing), spacing 1.
TEST(SetupBuilder, WarnsOfSurfaceTensionThatViscosityDoesNotDamp) {
  Case c = unit_case();
  c.fluids[0].surface_tension = 10;
  const auto currents = testing::HasSubstr("fluid 'water': surface tension is strong against viscosity");
  c.fluids[0].parameters[0] = 0.11 * 100;
  EXPECT_THAT(build_setup(c).warnings, testing::Not(testing::Contains(currents)));
  c.fluids[0].parameters[0] = 0.09 * 100;
  EXPECT_THAT(build_setup(c).warnings,
              testing::Contains(testing::AllOf(currents, testing::HasSubstr("= 0.09: below 0.1"),
                                               testing::HasSubstr("about 0.04 m/s"))));
  c.fluids[0].surface_tension = 0;
  EXPECT_THAT(build_setup(c).warnings, testing::Not(testing::Contains(currents)));
}

TEST(SetupBuilder, RefusesWhatCannotRun) {
  Case c = unit_case();
  c.gravity = {0, 0, 0};
  EXPECT_THAT(error_of(c),
              testing::HasSubstr("key 'numerics.sound_speed': value \"auto\" gives 0 without gravity"));
  c = unit_case();
  c.regions[0].shapes = {box({4.6, 4.6, 4.6}, {5.4, 5.4, 5.4})};
  EXPECT_THAT(error_of(c), testing::HasSubstr("unit.toml:12: key 'region.0': no particle"));
  c.dimensions = 2;
  EXPECT_THAT(error_of(c), testing::HasSubstr("a lattice site in the plane y = 0, inside the domain"));
  c = unit_case();
  c.walls = {wall("w", {stl_shape(write_temp_file("empty.stl", "solid\nendsolid\n"))})};
  EXPECT_THAT(error_of(c), testing::HasSubstr("key 'wall.0.shapes.0': "));
}

TEST(SetupBuilder, RefusesMoreThanTheMemoryHolds) {
  Case c = unit_case();
  c.spacing = 1e-4;
  EXPECT_THAT(error_of(c),
              testing::AllOf(testing::HasSubstr("unit.toml:5: key 'resolution.spacing'"),
                             testing::HasSubstr("GB of memory"), testing::HasSubstr("available")));
  c.spacing = 1e-12;
  EXPECT_THAT(error_of(c),
              testing::HasSubstr("value 1e-12: the domain reaches more than 1e9 spacings from the "
                                 "origin"));
  c = unit_case();
  c.domain.lower = {-1e29, -1e29, -1e29};
  c.domain.upper = {1e29, 1e29, 1e29};
  EXPECT_THAT(error_of(c), testing::HasSubstr("more than 1e9 spacings"));
}

}  // namespace
}  // namespace slagflow
