// Fluid and wall particles against counts, depths and pressures worked out by hand. Spacing 1, sites at n +
// 1/2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/geometry/geometry.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

struct At {
  bool found = false;
  double depth = 0;
  Vec3d normal;
};

At wall_at(const WallParticles& walls, Vec3d p) {
  for (std::size_t i = 0; i < walls.position.size(); ++i)
    if (norm(walls.position[i] - p) < 1e-9) return {true, walls.depth[i], walls.normal[i]};
  return {};
}

void expect_wall(const WallParticles& walls, Vec3d p, double depth, Vec3d normal) {
  const At at = wall_at(walls, p);
  const auto name = [](Vec3d v) {
    return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z);
  };
  ASSERT_TRUE(at.found) << name(p);
  EXPECT_NEAR(at.depth, depth, 1e-9) << name(p);
  EXPECT_LT(norm(at.normal - normal), 1e-9) << name(p) << " has normal " << name(at.normal);
}

TEST(GeometryWalls, FlatFloorHasThreeLayers) {
  Case c = unit_case();
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 2}, {0, 0, 1}}, false}})};
  const WallParticles walls = fill(c).walls;
  // Three layers below z = 2, over the domain and its margin of 3 on each side.
  EXPECT_EQ(walls.position.size(), 16u * 16u * 3u);
  std::map<double, int> depths;
  for (std::size_t i = 0; i < walls.depth.size(); ++i) {
    EXPECT_NEAR(walls.depth[i], 2 - walls.position[i].z, 1e-12);
    EXPECT_TRUE(walls.normal[i] == (Vec3d{0, 0, 1}));
    ++depths[std::round(walls.depth[i] * 1000) / 1000];
  }
  EXPECT_EQ(depths, (std::map<double, int>{{0.5, 256}, {1.5, 256}, {2.5, 256}}));
}

TEST(GeometryWalls, LayersFollowTheSupportRatio) {
  Case c = unit_case();
  c.support_ratio = 2;
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 4}, {0, 0, 1}}, false}})};
  EXPECT_EQ(fill(c).walls.position.size(), 14u * 14u * 2u);
}

TEST(GeometryWalls, FaceBesideTheLatticeKeepsItsDepthAndWarns) {
  Case c = unit_case();
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 3.8}, {0, 0, 1}}, false}})};
  const Filling filling = fill(c);
  expect_wall(filling.walls, {5.5, 5.5, 3.5}, 0.3, {0, 0, 1});
  expect_wall(filling.walls, {5.5, 5.5, 1.5}, 2.3, {0, 0, 1});
  ASSERT_EQ(filling.warnings.size(), 1u);
  EXPECT_THAT(filling.warnings[0],
              testing::HasSubstr("wall 'floor': the face z = 3.8 m lies 0.20 spacings off"));
}

TEST(GeometryWalls, OfManyFacesBesideTheLatticeThreeAreTold) {
  Case c = unit_case();
  c.regions[0].shapes = {box({0, 4, 2}, {10, 6, 9})};
  WallSpec stairs = wall("stairs", {});
  for (int k = 0; k < 5; ++k) {
    const ShapeSpec block = box({-20, -20, -20}, {2.0 * k + 2, 30, 5.8 - 0.7 * k});
    stairs.shapes.push_back(block);
  }
  c.walls = {stairs};
  const std::vector<std::string> warnings = fill(c).warnings;
  const auto told = testing::HasSubstr("spacings off the lattice; ");
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [&](const std::string& w) { return testing::Value(w, told); }),
            3);
  EXPECT_THAT(warnings, testing::Contains("wall 'stairs': faces off the lattice besides these: 1"));
}

TEST(GeometryWalls, NoWarningOnTheLatticeOrFarFromFluid) {
  Case c = unit_case();
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 4}, {0, 0, 1}}, false}}),
             wall("lid", {box({0, 0, 9.3}, {10, 10, 13})})};
  EXPECT_TRUE(fill(c).warnings.empty());
}

// Its pole lies across an axis, over a site.
TEST(GeometryWalls, NoWarningOfAFaceThatACurvedWallHasNot) {
  Case c = unit_case();
  c.walls = {wall("ball", {{SphereSpec{{5.5, 5.5, 0}, 4.2}, false}})};
  for (const std::string& warning : fill(c).warnings)
    EXPECT_THAT(warning, testing::Not(testing::HasSubstr("off the lattice")));
}

TEST(GeometryWalls, ConvexLipTakesTheNearestFace) {
  Case c = unit_case();
  c.regions[0].shapes = {box({7, 4, 7}, {9, 6, 9})};
  c.walls = {wall("block", {box({-20, -20, -20}, {5, 30, 5})})};
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {4.5, 5.5, 1.5}, 0.5, {1, 0, 0});
  expect_wall(walls, {1.5, 5.5, 4.5}, 0.5, {0, 0, 1});
  expect_wall(walls, {4.5, 5.5, 3.5}, 0.5, {1, 0, 0});
  expect_wall(walls, {2.5, 5.5, 3.5}, 1.5, {0, 0, 1});
  EXPECT_NEAR(wall_at(walls, {4.5, 5.5, 4.5}).depth, 0.5, 1e-12);
  EXPECT_FALSE(wall_at(walls, {1.5, 5.5, 1.5}).found);
}

TEST(GeometryWalls, ConcaveCornerContinuesThePlanes) {
  Case c = unit_case();
  // A floor that runs on below a side wall; they touch at z = 4.
  c.walls = {wall("corner", {box({-20, -20, -20}, {30, 30, 4}), box({-20, -20, 4}, {4, 30, 30})})};
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {7.5, 5.5, 2.5}, 1.5, {0, 0, 1});  // open floor
  expect_wall(walls, {2.5, 5.5, 7.5}, 1.5, {1, 0, 0});  // open side
  expect_wall(walls, {3.5, 5.5, 3.5}, 0.5, {0, 0, 1});  // below the side wall
  expect_wall(walls, {1.5, 5.5, 3.5}, 0.5, {0, 0, 1});
  expect_wall(walls, {3.5, 5.5, 1.5}, 2.5, {0, 0, 1});
  expect_wall(walls, {3.5, 5.5, 4.5}, 0.5, {1, 0, 0});  // the side wall's lowest site: not its bottom face
}

TEST(GeometryWalls, TouchingPartsOfTwoWallsShowNoFaceToEachOther) {
  Case c = unit_case();
  c.walls = {wall("floor", {box({-20, -20, -20}, {30, 30, 4})}),
             wall("sides", {box({-20, -20, 4}, {4, 30, 30}), box({-20, -20, 4}, {30, 4, 30})})};
  const WallParticles walls = fill(c).walls;
  for (const Vec3d& n : walls.normal) EXPECT_GE(n.z, 0);
  // Behind the vertical corner of the two side walls.
  const At at = wall_at(walls, {3.5, 2.5, 4.5});
  ASSERT_TRUE(at.found);
  EXPECT_EQ(at.normal.z, 0);
  EXPECT_NEAR(at.depth, at.normal.x > 0 ? 0.5 : 1.5, 1e-12);
}

TEST(GeometryWalls, ContainerContinuesItsPlanesAtCorners) {
  Case c = unit_case();
  c.regions[0].shapes = {box({2, 2, 2}, {8, 8, 5})};
  c.walls = {wall("tank", {outside(box({2, 2, 2}, {8, 8, 50}))})};
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {1.5, 5.5, 4.5}, 0.5, {1, 0, 0});
  expect_wall(walls, {9.5, 5.5, 4.5}, 1.5, {-1, 0, 0});
  expect_wall(walls, {5.5, 5.5, 0.5}, 1.5, {0, 0, 1});
  expect_wall(walls, {1.5, 5.5, 0.5}, 0.5, {1, 0, 0});
}

TEST(GeometryWalls, SubtractedChannelHasItsOwnFaces) {
  Case c = unit_case();
  WallSpec block = wall("block", {box({-20, -20, -20}, {30, 30, 8})});
  block.subtract = {box({3, -20, 4}, {7, 30, 9})};
  c.walls = {block};
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {5.5, 5.5, 3.5}, 0.5, {0, 0, 1});
  expect_wall(walls, {2.5, 5.5, 5.5}, 0.5, {1, 0, 0});
  expect_wall(walls, {8.5, 5.5, 5.5}, 1.5, {-1, 0, 0});
  expect_wall(walls, {8.5, 5.5, 7.5}, 0.5, {0, 0, 1});
}

TEST(GeometryWalls, InclinedPlaneHasExactDepth) {
  Case c = unit_case();
  c.regions[0].shapes = {box({4, 4, 7}, {6, 6, 9})};
  c.walls = {wall("slope", {{PlaneSpec{{5, 5, 4}, {0.6, 0, 0.8}}, false}})};
  const WallParticles walls = fill(c).walls;
  ASSERT_GT(walls.depth.size(), 500u);
  for (std::size_t i = 0; i < walls.depth.size(); ++i) {
    const Vec3d p = walls.position[i];
    EXPECT_NEAR(walls.depth[i], -(0.6 * (p.x - 5) + 0.8 * (p.z - 4)), 1e-5);
    EXPECT_NEAR(walls.normal[i].x, 0.6, 1e-12);
  }
}

TEST(GeometryWalls, CylinderShowsItsSide) {
  Case c = unit_case();
  c.regions[0].shapes = {box({0, 0, 0}, {2, 2, 2})};
  c.walls = {wall("rod", {{CylinderSpec{{5, -20, 5}, {5, 30, 5}, 3}, false}})};
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {7.5, 5.5, 5.5}, 3 - std::hypot(2.5, 0.5),
              Vec3d{2.5, 0, 0.5} * (1 / std::hypot(2.5, 0.5)));
  for (const Vec3d& n : walls.normal) EXPECT_EQ(n.y, 0);  // the caps are outside of the domain
}

TEST(GeometryWalls, StlBoxGivesTheParticlesOfTheBox) {
  const Vec3d a{-20, -20, -20}, b{5, 30, 5}, tank_a{2, 2, 2}, tank_b{8, 8, 50};
  const ShapeSpec block = stl_shape(write_temp_file("block.stl", binary_stl(box_triangles(a, b))));
  const ShapeSpec tank =
      outside(stl_shape(write_temp_file("tank.stl", binary_stl(box_triangles(tank_a, tank_b)))));
  for (const auto& [exact, stl] :
       {std::pair{box(a, b), block}, std::pair{outside(box(tank_a, tank_b)), tank}}) {
    Case c = unit_case();
    c.regions[0].shapes = {box({6, 6, 6}, {8, 8, 8})};
    c.walls = {wall("w", {exact})};
    const Filling expected = fill(c);
    c.walls = {wall("w", {stl})};
    const Filling found = fill(c);
    ASSERT_EQ(found.walls.position.size(), expected.walls.position.size());
    ASSERT_EQ(found.fluid.position.size(), expected.fluid.position.size());
    for (std::size_t i = 0; i < found.walls.depth.size(); ++i) {
      EXPECT_TRUE(found.walls.position[i] == expected.walls.position[i]);
      EXPECT_NEAR(found.walls.depth[i], expected.walls.depth[i], 1e-9);
    }
  }
}

TEST(GeometryWalls, PeriodicWallGoesOnBehindTheDomain) {
  Case c = unit_case();
  c.domain.periodic = {false, true, false};
  c.walls = {wall("floor", {box({-20, 0, -20}, {30, 10, 4})})};  // ends where the period does
  const WallParticles walls = fill(c).walls;
  EXPECT_EQ(walls.position.size(), 16u * 10u * 3u);
  for (const Vec3d& n : walls.normal) EXPECT_TRUE(n == (Vec3d{0, 0, 1}));
}

TEST(GeometryWalls, FacesOnOrBeyondTheDomainDoNotCount) {
  Case c = unit_case();
  c.walls = {wall("floor", {box({0, -1, -20}, {11, 30, 4})})};  // ends at the domain's face, and 1 past it
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {0.5, 5.5, 2.5}, 1.5, {0, 0, 1});
  expect_wall(walls, {10.5, 5.5, 2.5}, 1.5, {0, 0, 1});
  expect_wall(walls, {5.5, -0.5, 1.5}, 2.5, {0, 0, 1});
}

TEST(GeometryWalls, OpenSpaceWrapsRoundAPeriodicAxis) {
  Case c = unit_case();
  c.domain.periodic = {true, false, false};
  c.walls = {
      wall("half", {box({0, -20, -20}, {5, 30, 30})})};  // its far side faces the open through the period
  const WallParticles walls = fill(c).walls;
  expect_wall(walls, {0.5, 5.5, 5.5}, 0.5, {-1, 0, 0});
  expect_wall(walls, {4.5, 5.5, 5.5}, 0.5, {1, 0, 0});
}

// Its face towards -x lies beyond the period, which cuts it: no site goes without a particle.
TEST(GeometryWalls, WallLargerThanThePeriodEndsAtItsFace) {
  Case c = unit_case();
  c.domain.periodic = {true, false, false};
  c.regions[0].shapes = {box({9, 4, 4}, {10, 6, 6})};
  c.walls = {wall("most", {box({-20, -20, -20}, {8, 30, 30})})};
  const Filling filling = fill(c);
  expect_wall(filling.walls, {0.5, 5.5, 5.5}, 0.5, {-1, 0, 0});
  expect_wall(filling.walls, {7.5, 5.5, 5.5}, 0.5, {1, 0, 0});
  EXPECT_EQ(filling.walls.position.size(), 6u * 16u * 16u);
}

TEST(GeometryWalls, TwoDimensionsHaveOneLayer) {
  Case c = unit_case();
  c.dimensions = 2;
  c.regions[0].shapes = {box({4, -1, 2}, {6, 1, 6})};
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 2}, {0, 0, 1}}, false}})};
  const BuiltCase built = build_setup(c);
  EXPECT_EQ(built.setup.particles.position.size(), 8u);
  EXPECT_EQ(built.setup.walls.position.size(), 16u * 3u);
  for (const Vec3d& p : built.setup.particles.position) EXPECT_EQ(p.y, 0);
  EXPECT_LT(built.setup.domain.lower.y, 0);
  EXPECT_GT(built.setup.domain.upper.y, 0);
}

TEST(GeometryFluid, FillsSitesOfTheUnionWithoutTheRest) {
  Case c = unit_case();
  c.regions[0].shapes = {box({1, 1, 1}, {5, 5, 5}), box({3, 1, 1}, {7, 5, 5})};
  c.regions[0].subtract = {box({1, 1, 1}, {2, 5, 2})};
  EXPECT_EQ(fill(c).fluid.position.size(), 6u * 4u * 4u - 4u);
}

TEST(GeometryFluid, FacesThroughSitesAreSettledOneWay) {
  Case c = unit_case();
  c.regions[0].shapes = {box({2.5, 2.5, 2.5}, {5.5, 5.5, 5.5})};
  EXPECT_EQ(fill(c).fluid.position.size(), 27u);
  c.regions.push_back(c.regions[0]);
  c.regions[1].shapes = {box({5.5, 2.5, 2.5}, {8.5, 5.5, 5.5})};
  EXPECT_EQ(fill(c).fluid.position.size(), 54u);
}

TEST(GeometryFluid, SphereHasItsVolume) {
  Case c = unit_case();
  c.regions[0].shapes = {{SphereSpec{{5, 5, 5}, 4.5}, false}};
  std::size_t expected = 0;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 10; ++k)
        expected += square(i - 4.5) + square(j - 4.5) + square(k - 4.5) < square(4.5);
  EXPECT_EQ(fill(c).fluid.position.size(), expected);
}

TEST(GeometryFluid, EarlierRegionsAndWallsComeFirst) {
  Case c = unit_case();
  FluidSpec oil = c.fluids[0];
  oil.name = "oil";
  c.fluids.push_back(oil);
  c.regions[0].shapes = {box({0, 0, 0}, {10, 10, 5})};
  c.regions.push_back(c.regions[0]);
  c.regions[1].fluid = 1;
  c.regions[1].shapes = {box({0, 0, 4}, {10, 10, 7})};
  c.walls = {wall("floor", {box({-5, -5, -5}, {15, 15, 1})})};
  const FluidParticles fluid = fill(c).fluid;
  EXPECT_EQ(std::count(fluid.fluid.begin(), fluid.fluid.end(), 0), 400);
  EXPECT_EQ(std::count(fluid.fluid.begin(), fluid.fluid.end(), 1), 200);
  for (std::size_t i = 0; i < fluid.fluid.size(); ++i)
    EXPECT_EQ(fluid.fluid[i] == 0, fluid.position[i].z < 5);
}

// Fluid beside a wall stays on the lattice: only what lies on its face is moved.
TEST(GeometryFluid, KeepsJustOffWalls) {
  Case c = unit_case();
  c.regions[0].shapes = {box({0, 0, 0}, {10, 10, 10})};
  const auto lowest = [&](double floor) {
    c.walls = {wall("floor", {box({-5, -5, -5}, {15, 15, floor})})};
    double z = 10;
    for (const Vec3d& p : fill(c).fluid.position) z = std::min(z, p.z);
    return z;
  };
  EXPECT_DOUBLE_EQ(lowest(2.2), 2.5);
  EXPECT_DOUBLE_EQ(lowest(2.3), 2.5);
  EXPECT_NEAR(lowest(2.49), 2.51, 1e-9);
  EXPECT_NEAR(lowest(2.5), 2.52, 1e-9);  // sites on a face belong to the side of the larger coordinate
}

// Sites lost at the wall would make the fluid of a pipe of this size 5 % less.
TEST(GeometryFluid, FillsAPipeToItsVolume) {
  Case c = unit_case();
  c.domain.lower = {0, -14, -14}, c.domain.upper = {8, 14, 14};
  c.domain.periodic[0] = true;
  c.walls = {wall("pipe", {outside({CylinderSpec{{-1, 0, 0}, {9, 0, 0}, 10}, false})})};
  c.regions[0].shapes = {{CylinderSpec{{-1, 0, 0}, {9, 0, 0}, 10}, false}};
  const auto position = fill(c).fluid.position;
  // 316 sites of each layer have their centre within the radius.
  EXPECT_EQ(position.size(), 8u * 316u);
  for (const Vec3d& p : position) EXPECT_LE(std::hypot(p.y, p.z), 9.98 + 1e-9);
}

// A slit of 0.4 spacings leaves no place a quarter of a spacing off both of its walls.
TEST(GeometryFluid, LeavesASlitEmpty) {
  Case c = unit_case();
  c.regions[0].shapes = {box({0, 0, 0}, {10, 10, 10})};
  c.walls = {wall("below", {box({-5, -5, -5}, {15, 15, 4.3})}),
             wall("above", {box({-5, -5, 4.7}, {15, 15, 8})})};
  for (const Vec3d& p : fill(c).fluid.position) EXPECT_GT(p.z, 8);
}

TEST(GeometryFluid, StaysInsideTheDomain) {
  Case c = unit_case();
  c.regions[0].shapes = {box({-50, -50, -50}, {50, 50, 50})};
  EXPECT_EQ(fill(c).fluid.position.size(), 1000u);
}

TEST(GeometryFluid, PressureIsHydrostaticBelowTheSurface) {
  Case c = unit_case();
  c.walls = {wall("floor", {box({0, 0, -1}, {10, 10, 2})})};
  c.regions[0].shapes = {box({2, 2, 2}, {4, 4, 7})};
  c.regions.push_back(c.regions[0]);
  c.regions[1].shapes = {box({6, 2, 2}, {8, 4, 4})};
  c.regions[1].pressure = InitialPressure::zero;
  const FluidParticles fluid = fill(c).fluid;
  ASSERT_EQ(fluid.pressure.size(), fluid.position.size());
  for (std::size_t i = 0; i < fluid.pressure.size(); ++i)
    EXPECT_NEAR(fluid.pressure[i], fluid.position[i].x < 5 ? 1000 * 10 * (7 - fluid.position[i].z) : 0, 1e-6);
}

TEST(GeometryFluid, PressureFollowsInclinedGravity) {
  Case c = unit_case();
  c.gravity = {6, 0, -8};
  c.walls = {wall("floor", {box({4, 4, 0}, {6, 6, 4})})};
  const FluidParticles fluid = fill(c).fluid;
  // Highest site along -g: (4.5, ., 5.5).
  for (std::size_t i = 0; i < fluid.pressure.size(); ++i) {
    const Vec3d p = fluid.position[i];
    EXPECT_NEAR(fluid.pressure[i], 1000 * (6 * (p.x - 4.5) + 8 * (5.5 - p.z) + 5), 1e-6);
  }
}

TEST(GeometryFluid, MovesAsARigidBody) {
  Case c = unit_case();
  c.regions[0].velocity = {1, 0, 0};
  c.regions[0].angular_velocity = {0, 0, 2};
  c.regions[0].center = {5, 5, 5};
  const FluidParticles fluid = fill(c).fluid;
  for (std::size_t i = 0; i < fluid.velocity.size(); ++i) {
    const Vec3d r = fluid.position[i] - Vec3d{5, 5, 5};
    EXPECT_TRUE(fluid.velocity[i] == (Vec3d{1 - 2 * r.y, 2 * r.x, 0}));
  }
}

}  // namespace
}  // namespace slagflow
