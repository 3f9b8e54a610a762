// The automatic sound speed and its terms. Spacing 1 and gravity 10 along -z: lengths read as spacings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"
#include "host/run/check.hpp"

namespace slagflow {
namespace {

// A block of 2 x 2 x 2 in a domain of 40 x 10 x 100 that is open below.
Case tall_case() {
  Case c = unit_case();
  c.domain.upper = {40, 10, 100};
  c.regions[0].shapes = {box({4, 4, 50}, {6, 6, 52})};
  return c;
}

WallSpec floor_at(double z) { return wall("floor", {{PlaneSpec{{0, 0, z}, {0, 0, 1}}, false}}); }

double term(const Case& c, const std::string& name) {
  for (const SoundSpeedTerm& t : build_setup(c).sound_speed_terms)
    if (t.name == name) return t.speed;
  ADD_FAILURE() << "no term " << name;
  return 0;
}

double fall(double height) { return std::sqrt(2 * 10 * height); }

// Paths are followed in quarters of a spacing.
void expect_fall(double speed, double height) {
  EXPECT_NEAR(speed, fall(height), fall(height + 0.5) - fall(height));
}

TEST(SoundSpeed, DepthIsThatOfFluidThatHangsTogether) {
  Case c = tall_case();
  c.walls = {floor_at(0)};
  c.regions[0].shapes = {box({0, 0, 0}, {40, 10, 8})};
  EXPECT_DOUBLE_EQ(build_setup(c).setup.numerics.sound_speed, 11 * fall(8));
  c.regions.push_back(c.regions[0]);
  c.regions[1].shapes = {box({4, 4, 60}, {6, 6, 63})};  // far above: it falls, it is not deep
  EXPECT_DOUBLE_EQ(term(c, "depth"), fall(8));
  c.regions[1].shapes = {box({4, 4, 10}, {6, 6, 13})};  // two spacings above: as if it lay on it
  EXPECT_DOUBLE_EQ(term(c, "depth"), fall(13));
  EXPECT_DOUBLE_EQ(term(c, "impact"), fall(5));  // down its sides, onto the rest of it
}

TEST(SoundSpeed, ABodyThatFallsOnAFloorAsksForTenTimesItsSpeed) {
  Case c = tall_case();
  c.walls = {floor_at(0)};
  expect_fall(term(c, "impact"), 50);
  const BuiltCase built = build_setup(c);
  EXPECT_EQ(ruling(built.sound_speed_terms).name, "impact");
  EXPECT_DOUBLE_EQ(built.setup.numerics.sound_speed, 10 * term(c, "impact"));
}

TEST(SoundSpeed, FluidThatFallsOnOtherFluidToo) {
  Case c = tall_case();
  c.walls = {floor_at(0)};
  c.regions.push_back(c.regions[0]);
  c.regions[1].shapes = {box({0, 0, 0}, {40, 10, 20})};
  expect_fall(term(c, "impact"), 30);
  c.walls[0].motion.remove_at = 10;  // the pool may be gone by then
  expect_fall(term(c, "impact"), 50);
}

TEST(SoundSpeed, WhatLeavesTheDomainDoesNotCount) {
  EXPECT_EQ(term(tall_case(), "impact"), 0);
  EXPECT_DOUBLE_EQ(build_setup(tall_case()).setup.numerics.sound_speed, 11 * fall(2));
}

// Thrown sideways: over a short wall, against a high one.
TEST(SoundSpeed, FollowsAParabola) {
  Case c = tall_case();
  c.regions[0].velocity = {10, 0, 0};
  c.walls = {wall("wall", {box({26, -5, -5}, {27, 15, 20})})};
  EXPECT_EQ(term(c, "impact"), 0);
  c.walls = {wall("wall", {box({26, -5, -5}, {27, 15, 60})})};
  // 20 spacings at 10 a second: the speed has grown to that of 20 spacings of fall by then.
  EXPECT_NEAR(term(c, "impact"), std::hypot(10, 20), 0.5);
  EXPECT_EQ(term(c, "start"), 10);
}

TEST(SoundSpeed, WallsThatMoveOrVanishCountOnTheWayAndHoldNothing) {
  Case c = tall_case();
  c.walls = {floor_at(0), wall("tray", {box({-5, -5, 45}, {45, 15, 50})})};
  EXPECT_EQ(term(c, "impact"), 0);
  c.walls[1].motion.remove_at = 0.5;
  expect_fall(term(c, "impact"), 50);
  c.walls.erase(c.walls.begin());
  c.walls[0].shapes = {box({-5, -5, 25}, {45, 15, 30})};
  expect_fall(term(c, "impact"), 20);  // on the tray while it is there
}

TEST(SoundSpeed, FluidThatRestsFallsOffTheEdgesThatItCanReach) {
  Case c = tall_case();
  // A shelf that ends at x = 20, over a floor that ends there too, or does not.
  c.walls = {wall("shelf", {box({-5, -5, 40}, {20, 15, 50})})};
  EXPECT_EQ(term(c, "impact"), 0);
  c.walls.push_back(floor_at(0));
  EXPECT_DOUBLE_EQ(term(c, "impact"), fall(50 + 2));  // from the surface of the block
  c.walls.push_back(wall("step", {box({20, -5, 0}, {45, 15, 10})}));
  EXPECT_DOUBLE_EQ(term(c, "impact"), fall(40 + 2));
  c.walls.resize(1);  // a floor that begins 5 beyond the edge, where a leap ends
  c.walls.push_back(wall("basin", {box({25, -5, -5}, {45, 15, 0})}));
  EXPECT_NEAR(term(c, "impact"), fall(50 + 2), 0.5);
  c.walls.push_back(wall("dam", {box({15, -5, 50}, {18, 15, 70})}));
  EXPECT_EQ(term(c, "impact"), 0);
}

TEST(SoundSpeed, WallsAndTheStartAskForTenTimesTheirSpeed) {
  Case c = tall_case();
  c.gravity = {};
  c.walls = {floor_at(50)};
  c.walls[0].surface.velocity = {0, 3, 0};
  EXPECT_DOUBLE_EQ(build_setup(c).setup.numerics.sound_speed, 30);
  c.regions[0].angular_velocity = {0, 0, 8}, c.regions[0].center = {5, 5, 0};
  EXPECT_DOUBLE_EQ(build_setup(c).setup.numerics.sound_speed, 10 * 8 * std::sqrt(0.5));
  c.walls[0].motion.kind = MotionKind::sine;
  c.walls[0].motion.amplitude = {2, 0, 0}, c.walls[0].motion.frequency = 1;
  EXPECT_NEAR(build_setup(c).setup.numerics.sound_speed, 10 * 2 * 2 * 3.14159265358979, 1e-9);
}

// A drum of radius 5 about the axis y: the speed of its inner face, not of the corners of its shape.
TEST(SoundSpeed, AWallThatTurnsHasTheSpeedOfItsSurface) {
  Case c = unit_case();
  c.domain.lower = {-8, -4, -8}, c.domain.upper = {8, 4, 8};
  c.regions[0].shapes = {{CylinderSpec{{0, -4, 0}, {0, 4, 0}, 5}, false}};
  c.walls = {wall("drum", {outside({CylinderSpec{{0, -9, 0}, {0, 9, 0}, 5}, false})})};
  c.walls[0].motion.kind = MotionKind::constant;
  c.walls[0].motion.angular_velocity = {0, 4, 0}, c.walls[0].motion.center = {0, 7, 0};
  EXPECT_NEAR(term(c, "walls"), 20, 1e-6);
}

// Plates 20 wide, 4 apart: U L/(2 gap).
TEST(SoundSpeed, FluidBetweenPlatesThatApproachIsPressedOut) {
  Case c = unit_case();
  c.dimensions = 2, c.gravity = {};
  c.domain.lower = {0, -1, -4}, c.domain.upper = {40, 1, 10};
  c.regions[0].shapes = {box({10, -1, 0}, {30, 1, 4})};
  c.walls = {floor_at(0), wall("plate", {box({10, -1, 4}, {30, 1, 7})})};
  c.walls[1].motion.kind = MotionKind::constant;
  c.walls[1].motion.velocity = {0, 0, -2};
  EXPECT_DOUBLE_EQ(term(c, "squeeze"), 2 * 20 / (2 * 4.0));
  EXPECT_DOUBLE_EQ(build_setup(c).setup.numerics.sound_speed, 10 * 2 * 20 / (2 * 4.0));
  c.walls[1].motion.velocity = {0, 0, 2};  // apart
  EXPECT_EQ(term(c, "squeeze"), 0);
}

// The same of a fluid of 50 Pa s: twice the pressure of lubrication, 1.5 eta U L^2/gap^3. Of a yield stress
// alone, tau L/gap.
TEST(SoundSpeed, AViscousFilmBetweenPlatesResists) {
  Case c = unit_case();
  c.dimensions = 2, c.gravity = {};
  c.domain.lower = {0, -1, -4}, c.domain.upper = {40, 1, 10};
  c.regions[0].shapes = {box({10, -1, 0}, {30, 1, 4})};
  c.walls = {floor_at(0), wall("plate", {box({10, -1, 4}, {30, 1, 7})})};
  c.walls[1].motion.kind = MotionKind::constant;
  c.walls[1].motion.velocity = {0, 0, -2};
  c.fluids[0].parameters[0] = 50;
  const double pressure = 2 * 1.5 * 50 * 2 * 20 * 20 / (4.0 * 4 * 4);
  EXPECT_NEAR(term(c, "film"), std::sqrt(2 * pressure / 1000), 1e-6);
  c.walls[1].motion.velocity = {0, 0, 2};  // apart
  EXPECT_EQ(term(c, "film"), 0);
  c.walls[1].motion.velocity = {0, 0, -1e-3};
  c.fluids[0].rheology = RheologyKind::bingham;
  c.fluids[0].parameters = {1e-6, 300, 1e9};
  EXPECT_NEAR(term(c, "film"), std::sqrt(2 * 300 * 20 / 4.0 / 1000), 1e-5);
}

TEST(SoundSpeed, RegionPressureAndSurfaceTensionCount) {
  Case c = unit_case();
  c.gravity = {};
  c.regions[0].pressure = InitialPressure::uniform, c.regions[0].uniform_pressure = 2000;
  EXPECT_DOUBLE_EQ(build_setup(c).setup.numerics.sound_speed, 11 * 2);
  c.fluids[0].surface_tension = 9000;
  EXPECT_DOUBLE_EQ(build_setup(c).setup.numerics.sound_speed, 10 * 3);
}

// The fluid that leaves over the dam's lip falls 150 mm and out of the domain.
TEST(SoundSpeed, OfTheDamComesFromItsDepth) {
  const Case c = load_case(std::string(SLAGFLOW_SOURCE_DIR) + "/cases/dam_discharge_quick.toml",
                           {"numerics.sound_speed=auto"});
  const BuiltCase built = build_setup(c);
  EXPECT_NEAR(built.setup.numerics.sound_speed, 11 * std::sqrt(2 * 9.81 * 0.02), 1e-9);
  EXPECT_LE(built.setup.numerics.sound_speed, 8);
}

TEST(SoundSpeed, DoesNotDependOnTheOutputs) {
  Case c = tall_case();
  c.walls = {floor_at(0)};
  const double speed = build_setup(c).setup.numerics.sound_speed;
  c.output.end_time = 1e-3, c.output.interval = 1e-4;
  EXPECT_EQ(build_setup(c).setup.numerics.sound_speed, speed);
}

TEST(SoundSpeed, CheckPrintsEachTermWhichRulesAndWhatItCosts) {
  Case c = tall_case();
  c.walls = {floor_at(0)};
  const std::string text = to_text(check_case(build_setup(c)));
  EXPECT_THAT(text,
              testing::ContainsRegex("by depth +69.57 m/s = 11 x 6.325 m/s, sqrt\\(2 g H\\), H 2 m: time "
                                     "step 0.0149 s, 67 steps\n"));
  EXPECT_THAT(text, testing::ContainsRegex(
                        "by impact +31[67]\\..* m/s = 10 x 31\\..*, of a body on a wall or fluid that it "
                        "falls on: time step .* steps, 4.5[45] times those by depth; auto "
                        "takes it\n"));
  c.numerics.sound_speed = 69.57;
  EXPECT_THAT(to_text(check_case(build_setup(c))),
              testing::ContainsRegex("warning: fluid will meet walls or fluid "
                                     "at 31\\..* raise numerics.sound_speed"));
}

}  // namespace
}  // namespace slagflow
