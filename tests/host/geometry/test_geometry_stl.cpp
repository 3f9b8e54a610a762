// Wall particles of surfaces from STL files. Spacing 1, sites at n + 1/2.
#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/geometry.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

// Blocks as bodies of a file: faces inside the union, steps of 0.5 along x and 0.25 down.
TEST(GeometryWalls, ParticlesOfStlStairsFaceTheirSlope) {
  std::vector<Triangle> triangles;
  for (int k = 0; k < 26; ++k)
    for (const Triangle& t : box_triangles({-20, -20, -20}, {-0.5 + 0.5 * k, 30, 6 - 0.25 * k}))
      triangles.push_back(t);
  Case c = unit_case();
  c.regions[0].shapes = {box({4, 4, 7}, {6, 6, 9})};
  c.walls = {wall("stairs", {stl_shape(write_temp_file("stairs.stl", binary_stl(triangles)))})};
  const WallParticles walls = fill(c).walls;
  ASSERT_GT(walls.normal.size(), 500u);
  const Vec3d slope{1 / std::sqrt(5.0), 0, 2 / std::sqrt(5.0)};
  for (std::size_t i = 0; i < walls.normal.size(); ++i) EXPECT_GT(dot(walls.normal[i], slope), 0.4);
}

// A body that ends at the faces of the domain shows its top, not its sides or its bottom.
TEST(GeometryWalls, StlFloorThatEndsAtTheDomainFacesUp) {
  Case c = unit_case();
  c.domain.periodic = {false, true, false};
  c.regions[0].shapes = {box({4, 4, 7}, {6, 6, 9})};
  const std::string file = write_temp_file("floor.stl", binary_stl(box_triangles({0, 0, 0}, {10, 10, 3})));
  c.walls = {wall("floor", {stl_shape(file)})};
  const WallParticles walls = fill(c).walls;
  EXPECT_EQ(walls.position.size(), 10u * 10u * 3u);
  for (std::size_t i = 0; i < walls.position.size(); ++i) {
    EXPECT_LT(norm(walls.normal[i] - Vec3d{0, 0, 1}), 1e-12);
    EXPECT_NEAR(walls.depth[i], 3 - walls.position[i].z, 1e-6);
  }
}

// As closed forms do: one of the plate's layers knows the other side.
TEST(GeometryWalls, StlPlateHasItsOppositeFace) {
  Case c = unit_case();
  const std::string file =
      write_temp_file("plate2.stl", binary_stl(box_triangles({-20, -20, 1}, {30, 30, 3})));
  c.walls = {wall("plate", {stl_shape(file)})};
  const WallParticles walls = fill(c).walls;
  ASSERT_FALSE(walls.position.empty());
  for (std::size_t i = 0; i < walls.position.size(); ++i)
    EXPECT_NEAR(walls.depth[i] + walls.back_depth[i], 2, 1e-6);
}

}  // namespace
}  // namespace slagflow
