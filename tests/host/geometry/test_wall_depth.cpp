// How deep places are in walls, against distances worked out by hand. Spacing 1.
#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/wall_depth.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

Case with_walls(std::vector<WallSpec> walls) {
  Case c = unit_case();
  c.walls = std::move(walls);
  return c;
}

TEST(WallDepth, IsThatOfTheNearestFaceOfATank) {
  const WallDepth depth(with_walls({wall("tank", {outside(box({2, 2, 2}, {8, 8, 50}))})}));
  EXPECT_EQ(depth.of({2.1, 5, 5}), 0);
  EXPECT_EQ(depth.of({2.1, 2.1, 2.1}), 0);  // in its corner
  EXPECT_NEAR(depth.of({1.4, 5, 5}), 0.6, 1e-12);
  EXPECT_NEAR(depth.of({5, 5, 0.7}), 1.3, 1e-12);
  EXPECT_NEAR(depth.of({5, 2.2, 1.5}), 0.5, 1e-12);
}

// Nudges of a thousandth of a spacing lead from face to face.
TEST(WallDepth, BehindAConcaveCornerIsTheWayToTheCorner) {
  const WallDepth tank(with_walls({wall("tank", {outside(box({2, 2, 2}, {8, 8, 50}))})}));
  EXPECT_NEAR(tank.of({1.4, 1.2, 5}), 1, 2e-3);
  EXPECT_NEAR(tank.of({1.4, 1.4, 1.4}), 0.6 * std::sqrt(3.0), 3e-3);
  const WallDepth pot(with_walls({wall("pot", {outside({CylinderSpec{{5, 5, 2}, {5, 5, 50}, 4}, false})})}));
  EXPECT_NEAR(pot.of({5 + 4.4 * std::cos(0.4), 5 + 4.4 * std::sin(0.4), 1.7}), 0.5, 2e-3);
}

// The open below the floor is two spacings away, that in the corner next to the place.
TEST(WallDepth, InAConcaveCornerOfThinWallsIsTheWayToTheCorner) {
  const WallDepth angle(
      with_walls({wall("floor", {box({1, 1, 2}, {9, 9, 4})}), wall("side", {box({1, 1, 2}, {3, 9, 9})})}));
  EXPECT_NEAR(angle.of({2.97, 5, 3.96}), 0.05, 3e-3);
  EXPECT_NEAR(angle.of({1.1, 5, 3.96}), 0.1, 1e-12);
}

TEST(WallDepth, IsZeroBesideALip) {
  const WallDepth depth(with_walls({wall("block", {box({-20, -20, -20}, {5, 30, 5})})}));
  for (const Vec3d p : {Vec3d{4.4, 5, 5.05}, Vec3d{5.05, 5, 4.4}, Vec3d{5.1, 5, 5.1}, Vec3d{1, 5, 5.2}})
    EXPECT_EQ(depth.of(p), 0);
  EXPECT_NEAR(depth.of({4.7, 5, 4.2}), 0.3, 1e-12);
  EXPECT_NEAR(depth.of({3.2, 5, 4.1}), 0.9, 1e-12);
}

// A wedge of 30 degrees between z = 5 and a plane through the tip (7, ., 5), which is below.
TEST(WallDepth, HoldsAtASharpLip) {
  WallSpec lip = wall("lip", {{PlaneSpec{{0, 0, 5}, {0, 0, 1}}, false}});
  lip.subtract = {{PlaneSpec{{7, 0, 5}, {-0.5, 0, std::sqrt(0.75)}}, false}};
  const WallDepth depth(with_walls({lip}));
  EXPECT_EQ(depth.of({6.5, 5, 5.1}), 0);
  EXPECT_EQ(depth.of({6.5, 5, 4.6}), 0);  // below the wedge
  EXPECT_EQ(depth.of({7.2, 5, 4.9}), 0);  // before the tip
  EXPECT_NEAR(depth.of({4, 5, 4.8}), 0.2, 1e-12);
  EXPECT_NEAR(depth.of({4, 5, 3.5}), -1.5 * std::sqrt(0.75) + 1.5, 1e-12);
}

TEST(WallDepth, IsAtMostHalfTheThicknessOfAPlate) {
  const WallDepth depth(with_walls({wall("plate", {box({-20, -20, 4}, {30, 30, 5})})}));
  EXPECT_NEAR(depth.of({5, 5, 4.3}), 0.3, 1e-12);
  EXPECT_NEAR(depth.of({5, 5, 4.8}), 0.2, 1e-12);
  EXPECT_EQ(depth.of({5, 5, 3.9}), 0);
}

TEST(WallDepth, FollowsACylinderAndItsStlFile) {
  const WallDepth rod(with_walls({wall("rod", {{CylinderSpec{{5, -20, 5}, {5, 30, 5}, 3}, false}})}));
  EXPECT_NEAR(rod.of({7, 5, 6}), 3 - std::sqrt(5.0), 1e-12);
  EXPECT_EQ(rod.of({7.9, 5, 6}), 0);
  const std::string file = write_temp_file("block.stl", binary_stl(box_triangles({2, -9, 2}, {8, 19, 8})));
  const WallDepth block(with_walls({wall("block", {stl_shape(file)})}));
  EXPECT_NEAR(block.of({7.25, 5, 6}), 0.75, 1e-6);
  EXPECT_EQ(block.of({8.1, 5, 6}), 0);
}

// Inner faces, where boxes touch, where a wall ends at the domain or at a periodic face, are no way out.
TEST(WallDepth, GoesOverFacesThatBorderTheOpenOnly) {
  Case c = with_walls({wall("floor", {box({-20, 0, -20}, {5, 10, 4}), box({5, 0, -20}, {10, 10, 4})}),
                       wall("side", {box({-20, -20, 4}, {2, 30, 30})})});
  c.domain.periodic[1] = true;
  const WallDepth depth(c);
  EXPECT_NEAR(depth.of({5.1, 5, 3.2}), 0.8, 1e-12);    // near the joint
  EXPECT_NEAR(depth.of({5.5, 0.1, 3.2}), 0.8, 1e-12);  // near the periodic face
  EXPECT_NEAR(depth.of({9.9, 5, 2.5}), 1.5, 1e-12);    // near the domain's face
  EXPECT_NEAR(depth.of({1.2, 5, 4.1}), 0.8, 1e-12);    // above the floor, in the side wall
}

TEST(WallDepth, IsLimitedToSixSpacings) {
  const WallDepth depth(with_walls({wall("floor", {{PlaneSpec{{0, 0, 9}, {0, 0, 1}}, false}})}));
  EXPECT_NEAR(depth.of({5, 5, 3.5}), 5.5, 1e-12);
  EXPECT_EQ(depth.of({5, 5, 0.5}), 6);
}

TEST(WallDepth, FollowsWallsThatMoveTurnAndVanish) {
  WallSpec piston = wall("piston", {box({-20, -20, -20}, {2, 30, 30})});
  piston.motion.kind = MotionKind::constant;
  piston.motion.velocity = {2, 0, 0};
  piston.motion.remove_at = 3;
  WallSpec arm = wall("arm", {box({8, 4, 4}, {9, 6, 20})});  // turns about y by a quarter in 1 s
  arm.motion.kind = MotionKind::constant;
  arm.motion.angular_velocity = {0, -std::acos(-1.0) / 2, 0};
  arm.motion.center = {8.5, 5, 5};
  WallDepth depth(with_walls({piston, arm}));
  EXPECT_EQ(depth.of({3, 5, 9}), 0);
  EXPECT_NEAR(depth.of({8.7, 5, 9}), 0.3, 1e-12);
  depth.move_to(1);  // the piston's face at x = 4, the arm along -x from (9.5, ., 5)
  EXPECT_NEAR(depth.of({3, 5, 9}), 1, 1e-12);
  EXPECT_EQ(depth.of({8.7, 5, 9}), 0);
  EXPECT_NEAR(depth.of({7, 5, 5.3}), 0.2, 1e-12);
  depth.move_to(3);
  EXPECT_EQ(depth.of({3, 5, 9}), 0);
}

// A plate of half the period that has gone round once and a quarter.
TEST(WallDepth, FollowsAWallRoundAPeriodicAxis) {
  WallSpec plate = wall("plate", {box({0, -20, 1}, {5, 30, 4})});
  plate.motion.kind = MotionKind::constant;
  plate.motion.velocity = {12.5, 0, 0};
  Case c = with_walls({plate});
  c.domain.periodic[0] = true;
  WallDepth depth(c);
  depth.move_to(1);  // from x = 2.5 to 7.5
  EXPECT_EQ(depth.of({2, 5, 3.4}), 0);
  EXPECT_NEAR(depth.of({5, 5, 3.4}), 0.6, 1e-12);
  depth.move_to(1.6);  // from 0 to 5, and the same again at 0.4 s from 5 to 10
  EXPECT_NEAR(depth.of({0.2, 5, 3.4}), 0.2, 1e-12);
  EXPECT_EQ(depth.of({9.8, 5, 3.4}), 0);
}

TEST(WallDepth, IgnoresTheThirdDirectionInTwoDimensions) {
  Case c = with_walls({wall("rod", {{CylinderSpec{{5, -0.3, 5}, {5, 0.3, 5}, 3}, false}})});
  c.dimensions = 2;
  EXPECT_NEAR(WallDepth(c).of({5, 0, 6}), 2, 1e-12);
}

}  // namespace
}  // namespace slagflow
