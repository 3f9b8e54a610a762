// Warnings of walls that are too thin, of steps and of sites without a particle. Spacing 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/geometry.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry/wall_survey.hpp"
#include "host/geometry_cases.hpp"
#include "host/run/check.hpp"

namespace slagflow {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> warnings(std::vector<WallSpec> walls) {
  Case c = unit_case();
  c.regions[0].shapes = {box({4, 4, 7}, {6, 6, 9})};
  c.walls = std::move(walls);
  return fill(c).warnings;
}

ShapeSpec plate(double thickness) { return box({-20, -20, 5 - thickness}, {30, 30, 5}); }

TEST(WallSurvey, PlateOfOneSpacingIsWarnedOfWithItsPlaceAndCount) {
  Case c = unit_case();
  c.regions[0].shapes = {box({4, 4, 7}, {6, 6, 9})};
  c.walls = {wall("baffle", {plate(1)})};
  // 16 x 16 particles, of which 10 x 10 are in the domain.
  const auto told = HasSubstr(
      "wall 'baffle' is 1 spacing thick at (0.5, 0.5, 5) m, where it is thinnest, and "
      "thinner than three spacings at 100 of its 256 particles");
  EXPECT_THAT(fill(c).warnings, ElementsAre(told));
  EXPECT_THAT(to_text(check_case(build_setup(c))), told);
}

TEST(WallSurvey, PlatesBelowThreeSpacingsAreThin) {
  EXPECT_THAT(warnings({wall("w", {plate(2)})}), ElementsAre(HasSubstr("is 2 spacings thick")));
  EXPECT_THAT(warnings({wall("w", {plate(3)})}), IsEmpty());
}

// The domain ends with it, or before: two layers of particles are two.
TEST(WallSurvey, FloorThatEndsNearTheDomainIsThin) {
  for (const double bottom : {0.0, -1.0})
    EXPECT_THAT(warnings({wall("w", {box({-20, -20, bottom}, {30, 30, bottom + 2})})}),
                ElementsAre(HasSubstr("is 2 spacings thick")));
}

TEST(WallSurvey, InclinedPlatesAreMeasuredAlongTheirNormal) {
  const Vec3d n{-0.6, 0, 0.8};
  const auto inclined = [&](double thickness) {
    WallSpec w = wall("w", {{PlaneSpec{{5, 5, 4}, n}, false}});
    w.subtract = {{PlaneSpec{Vec3d{5, 5, 4} - thickness * n, n}, false}};
    return w;
  };
  EXPECT_THAT(warnings({inclined(1.5)}), ElementsAre(HasSubstr("is 1.5 spacings thick")));
  EXPECT_THAT(warnings({inclined(3)}), IsEmpty());
}

// A ram that starts in a block and comes out of it lacks what the block keeps; one that only goes deeper, or
// along the block, does not.
TEST(WallSurvey, PartOfAMovingWallThatComesOutOfAnotherIsWarnedOf) {
  const auto told = [](Vec3d velocity, double far) {
    WallSpec ram = wall("ram", {box({0, 3, 5}, {far, 6, 8})});
    ram.motion.kind = MotionKind::constant;
    ram.motion.velocity = velocity;
    Case c = unit_case();
    c.regions[0].shapes = {box({7, 4, 7}, {9, 6, 9})};
    c.output.end_time = 1;
    c.walls = {ram, wall("block", {box({-20, -20, -20}, {4, 30, 30})})};
    return fill(c).warnings;
  };
  const auto missing = Contains(HasSubstr("wall 'ram' starts partly inside walls at rest, which keep "));
  EXPECT_THAT(told({3, 0, 0}, 5), missing);
  EXPECT_THAT(told({3, 0, 0}, 4), missing);  // all of it
  EXPECT_THAT(told({-3, 0, 0}, 5), Not(missing));
  EXPECT_THAT(told({0, 0, 1}, 5), Not(missing));
  EXPECT_THAT(told({0, 0, 0}, 5), Not(missing));
}

// The rim of a trough whose section is cut flush with the wall's top.
TEST(WallSurvey, AnEdgeIsNoThinWall) {
  WallSpec trough = wall("trough", {box({0, -20, 0}, {60, 30, 35})});
  trough.subtract = {{PrismSpec{1, {{20, 5}, {40, 5}, {50, 35}, {10, 35}}, -100, 100}, false}};
  Case c = unit_case();
  c.dimensions = 2;
  c.domain.upper = {60, 10, 60};
  c.regions[0].shapes = {box({25, -1, 7}, {35, 1, 9})};
  c.walls = {trough};
  EXPECT_THAT(fill(c).warnings, Not(Contains(HasSubstr("spacings thick"))));
}

TEST(WallSurvey, StlPlateIsWarnedOfAsTheBoxIs) {
  const std::string file =
      write_temp_file("plate.stl", binary_stl(box_triangles({-20, -20, 4}, {30, 30, 5})));
  EXPECT_EQ(warnings({wall("w", {stl_shape(file)})}), warnings({wall("w", {plate(1)})}));
}

TEST(WallSurvey, TwoPartsThatTouchAreAsThickAsBoth) {
  EXPECT_THAT(warnings({wall("a", {plate(1.5), box({-20, -20, 1}, {30, 30, 3.5})})}), IsEmpty());
  EXPECT_THAT(warnings({wall("a", {plate(2)}), wall("b", {box({-20, -20, 1}, {30, 30, 3})})}), IsEmpty());
}

TEST(WallSurvey, EdgesOfTheDomainAndOfThickWallsAreNotThin) {
  EXPECT_THAT(warnings({wall("floor", {box({-1, -1, -2}, {11, 11, 1})})}), IsEmpty());
  EXPECT_THAT(warnings({wall("block", {box({-20, -20, -20}, {5, 30, 5})})}), IsEmpty());
  EXPECT_THAT(warnings({wall("rod", {{CylinderSpec{{5, -20, 3}, {5, 30, 3}, 2}, false}})}), IsEmpty());
  EXPECT_THAT(warnings({wall("tank", {outside(box({1, 1, 1}, {9, 9, 50}))})}), IsEmpty());
}

TEST(WallSurvey, GateIsMeasuredByItself) {
  WallSpec gate = wall("gate", {box({2, -20, 3}, {4, 30, 30})});
  gate.motion.remove_at = 0.1;
  EXPECT_THAT(warnings({wall("floor", {box({-20, -20, -20}, {30, 30, 3})}), gate}),
              ElementsAre(HasSubstr("wall 'gate' is 2 spacings thick")));
}

// Blocks that make stairs down along x from z = 6.
std::vector<Vec3d> stairs(double width, double height) {
  std::vector<Vec3d> corners;
  for (int k = 0; - 1 + width * k < 12; ++k) corners.push_back({-1 + width * (k + 1), 30, 6 - height * k});
  return corners;
}

WallSpec blocks(const std::vector<Vec3d>& corners) {
  WallSpec w = wall("stairs", {});
  for (const Vec3d& corner : corners) {
    const ShapeSpec block = box({-20, -20, -20}, corner);
    w.shapes.push_back(block);
  }
  return w;
}

TEST(WallSurvey, NarrowStairsAreWarnedOf) {
  const auto told = HasSubstr("wall 'stairs' has steps less than two spacings wide at ");
  EXPECT_THAT(warnings({blocks(stairs(0.5, 0.25))}), Contains(told));
  EXPECT_THAT(warnings({blocks(stairs(1, 0.5))}), Contains(told));
  EXPECT_THAT(warnings({blocks(stairs(1.5, 1))}), Contains(told));
  EXPECT_THAT(warnings({blocks(stairs(3, 1))}), IsEmpty());
  EXPECT_THAT(warnings({{wall("slope", {{PlaneSpec{{5, 5, 4}, {0.6, 0, 0.8}}, false}})}}), IsEmpty());
}

TEST(WallSurvey, TellsSitesWithoutAFace) {
  Case c = unit_case();
  c.walls = {wall("hole", {plate(3)})};
  const Lattice lattice(c);
  const WallSolids solids(c);
  WallSurvey survey(c, lattice, solids);
  survey.dropped({3.5, 4.5, 2.5}, 0);
  survey.dropped({4.5, 4.5, 2.5}, 0);
  EXPECT_THAT(
      survey.warnings(),
      ElementsAre("wall 'hole' has no face near 2 lattice sites inside of it, the first at (3.5, 4.5, "
                  "2.5) m, which get no particle: fluid may pass"));
}

}  // namespace
}  // namespace slagflow
