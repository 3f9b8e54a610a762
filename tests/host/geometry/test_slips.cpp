// Slips of units, of times, and of measures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> warnings(const Case& c) { return build_setup(c).warnings; }

Case on_floor() {
  Case c = unit_case();
  c.walls = {wall("floor", {box({0, 0, 0}, {10, 10, 4})})};
  return c;
}

TEST(Slips, GravityOfAnotherUnitOrSignIsTold) {
  Case c = on_floor();
  EXPECT_THAT(warnings(c), Not(Contains(HasSubstr("gravity"))));
  c.gravity = {0, 0, -9810};
  EXPECT_THAT(warnings(c), Contains(HasSubstr("gravity.acceleration is 9810 m/s^2")));
  c.gravity = {0, 0, -0.00981};
  EXPECT_THAT(warnings(c), Contains(HasSubstr("gravity.acceleration is 0.00981 m/s^2")));
  c.gravity = {0, 0, 9.81};
  EXPECT_THAT(warnings(c), Contains(AllOf(HasSubstr("points up"), HasSubstr("is [0, 0, -9.81] meant?"))));
  c.walls.push_back(wall("roof", {box({0, 0, 8}, {10, 10, 10})}));
  EXPECT_THAT(warnings(c), Not(Contains(HasSubstr("points up"))));
}

TEST(Slips, MotionsThatAreNotMeantAreTold) {
  Case c = on_floor();
  WallMotion& motion = c.walls[0].motion;
  motion.remove_at = 2;
  EXPECT_THAT(warnings(c),
              Contains(HasSubstr("wall 'floor': remove_at = 2.0 s is after the end of the run at 1.0 s")));
  motion = {};
  motion.kind = MotionKind::table;
  motion.time = {0, 1}, motion.angle = {0, 6.3}, motion.axis = {0, 0, 1}, motion.displacement.resize(2);
  EXPECT_THAT(warnings(c), Not(Contains(HasSubstr("floor"))));
  motion.angle[1] = 90;
  EXPECT_THAT(warnings(c), Contains(HasSubstr("meant in degrees? 90 degrees are 1.571 rad")));
  motion.angle.clear();
  motion.displacement[1] = {500, 0, 0};
  EXPECT_THAT(warnings(c), Contains(HasSubstr("moves by up to 500 m, the domain is 17.32 m")));
  motion.displacement[1] = {1, 0, 0};
  motion.start = 3;
  EXPECT_THAT(warnings(c), Contains(HasSubstr("motion.start = 3.0 s is after the end")));
  motion.start = 0, motion.stop = 3;
  EXPECT_THAT(warnings(c), Contains(HasSubstr("motion.stop = 3.0 s is after the end")));
}

TEST(Slips, MeasuresBesideThePlaneAreTold) {
  Case c = unit_case();
  c.dimensions = 2;
  c.regions[0].shapes = {box({4, -1, 4}, {6, 1, 6})};
  MeasureSpec front, volume, profile;
  front.name = "front", front.direction = {1, 1}, front.position = 20;
  volume.name = "pool", volume.type = MeasureType::volume, volume.min = {0, 1, 0}, volume.max = {5, 2, 5};
  profile.name = "line", profile.type = MeasureType::profile, profile.start = {5, 5, 0},
  profile.end = {5, 5, 9};
  c.measures = {front, volume, profile};
  EXPECT_THAT(warnings(c), AllOf(Contains(HasSubstr("measure 'front' goes along y")),
                                 Contains(HasSubstr("measure 'pool' has y from 1.0 to 2.0 m")),
                                 Contains(HasSubstr("measure 'line' has a line with y = 5.0 m"))));
  c.measures[0].direction = {0, 1}, c.measures[1].min.y = -1;
  c.measures[2].start.y = c.measures[2].end.y = 0;
  EXPECT_THAT(warnings(c), Not(Contains(HasSubstr("measure"))));
}

TEST(Slips, LayersOfVeryDifferentDensityAreTold) {
  const auto with = [](double density, double courant) {
    Case c = unit_case();
    c.fluids.push_back(c.fluids[0]);
    c.fluids[1].name = "metal", c.fluids[1].density = density;
    c.regions.push_back(c.regions[0]);
    c.regions[1].fluid = 1, c.regions[1].shapes = {box({4, 4, 2}, {6, 6, 4})};
    c.numerics.courant = courant;
    return warnings(c);
  };
  EXPECT_THAT(with(30000, 0.8), Not(Contains(HasSubstr("times as dense"))));
  EXPECT_THAT(with(50000, 0.8), Contains(AllOf(HasSubstr("'metal' is 50 times as dense as 'water'"),
                                               HasSubstr("courant = 0.3 keeps them"))));
  EXPECT_THAT(with(50000, 0.3), Not(Contains(HasSubstr("times as dense"))));
  EXPECT_THAT(with(500000, 0.3), Contains(HasSubstr("beyond 100 to 1 they do not")));
  EXPECT_THAT(with(10, 0.3), Contains(HasSubstr("meant in g/cm^3? Then density = 10000.0")));
  EXPECT_THAT(with(70, 0.3), Contains(HasSubstr("meant in lb/ft^3? Then density = 1121.0")));
}

TEST(Slips, WavesThatTheSpacingDoesNotCarryAreTold) {
  const auto with = [](double length) {
    Case c = unit_case();
    c.regions[0].waves = {{{1, 0, 0}, {0, 0, 1 / length}, 0}};
    return warnings(c);
  };
  EXPECT_THAT(with(8), Not(Contains(HasSubstr("waves"))));
  EXPECT_THAT(with(5), Contains(HasSubstr("region.0.waves.0 is 5 m long, 5 spacings: too few to carry it")));
  EXPECT_THAT(with(1.25), Contains(HasSubstr("as in another, longer wave")));
}

}  // namespace
}  // namespace slagflow
