// Each body of an STL file is turned the right way round. Solid is where a distance is negative.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/geometry/geometry.hpp"
#include "host/geometry/shapes.hpp"
#include "host/geometry/stl_surface.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

using Triangles = std::vector<Triangle>;

Triangles inverted(Triangles triangles) {
  for (Triangle& t : triangles) std::swap(t[0], t[1]);
  return triangles;
}

Triangles together(const std::vector<Triangles>& bodies) {
  Triangles all;
  for (const Triangles& body : bodies) all.insert(all.end(), body.begin(), body.end());
  return all;
}

// The volume that the surface encloses, each point as often as normals that point out of it say.
double volume(const Triangles& triangles) {
  double sum = 0;
  for (const Triangle& t : closed_surface(triangles, "surface")) sum += dot(t[0], cross(t[1], t[2])) / 6;
  return sum;
}

bool solid(const Triangles& triangles, Vec3d p) {
  return make_surface_form(closed_surface(triangles, "surface"))->distance(p) < 0;
}

std::string error_of(const Triangles& triangles) {
  try {
    closed_surface(triangles, "x.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const Triangles small = box_triangles({4, 4, 4}, {6, 6, 6}), large = box_triangles({0, 0, 0}, {10, 10, 10}),
                beside = box_triangles({11, 0, 0}, {13, 2, 2});

// 1000, 8 and 8.
TEST(StlBodies, EachIsTurnedByItself) {
  for (const Triangles& first : {large, inverted(large)})
    for (const Triangles& second : {beside, inverted(beside)}) {
      EXPECT_NEAR(volume(together({first, second})), 1008, 1e-9);
      EXPECT_NEAR(volume(together({second, first})), 1008, 1e-9);
    }
}

TEST(StlBodies, OneInsideOfAnotherIsACavityAndOneInsideOfThatSolid) {
  const Triangles core = box_triangles({4.5, 4.5, 4.5}, {5.5, 5.5, 5.5});
  for (const Triangles& outer : {large, inverted(large)})
    for (const Triangles& inner : {small, inverted(small)})
      for (const Triangles& middle : {core, inverted(core)}) {
        const Triangles all = together({middle, outer, inner, beside});
        EXPECT_NEAR(volume(all), 1000 - 8 + 1 + 8, 1e-9);
        EXPECT_TRUE(solid(all, {1, 5, 5}));
        EXPECT_FALSE(solid(all, {4.2, 5, 5}));
        EXPECT_TRUE(solid(all, {5, 5, 5}));
        EXPECT_TRUE(solid(all, {12, 1, 1}));
      }
}

TEST(StlBodies, ThatCrossAreAUnionOrRefused) {
  const Triangles other = box_triangles({9, 9, 9}, {12, 12, 12});
  for (const Triangles& all : {together({large, other}), together({inverted(large), inverted(other)})}) {
    EXPECT_NEAR(volume(all), 1000 + 27, 1e-9);
    EXPECT_TRUE(solid(all, {9.5, 9.5, 9.5}));
    EXPECT_TRUE(solid(all, {11, 11, 11}));
  }
  EXPECT_THAT(
      error_of(together({large, inverted(other)})),
      testing::HasSubstr("x.stl: two bodies cross, around (5, 5, 5) and (10.5, 10.5, 10.5) of the file, "
                         "and are wound in opposite senses"));
}

// Edges of four triangles.
TEST(StlBodies, ThatTouchAtAnEdgeOrAFaceAreTwo) {
  const Triangles at_edge = box_triangles({10, 10, 0}, {12, 12, 10}),
                  on_top = box_triangles({0, 0, 10}, {10, 10, 12});
  EXPECT_NEAR(volume(together({large, inverted(at_edge)})), 1000 + 40, 1e-9);
  EXPECT_NEAR(volume(together({inverted(on_top), large})), 1000 + 200, 1e-9);
  EXPECT_NEAR(volume(together({on_top, large})), 1000 + 200, 1e-9);
  EXPECT_TRUE(solid(together({inverted(on_top), large}), {5, 5, 11}));
}

TEST(StlBodies, WithoutVolumeAreRefusedWhenThereIsNoOther) {
  const Triangle t{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}};
  const Triangles sheet{t, {t[0], t[2], t[1]}};
  EXPECT_THAT(error_of(sheet), testing::HasSubstr("the surface encloses no volume"));
  EXPECT_EQ(error_of(together({sheet, beside})), "accepted");
}

// Two slabs side by side: the floor of spacing 1 has all its particles, whichever way the second is wound.
TEST(StlBodies, FloorOfABodyWoundInsideOutHasItsParticles) {
  const Triangles left = box_triangles({-20, -20, -20}, {4, 30, 3}),
                  right = box_triangles({6, -20, -20}, {30, 30, 3});
  Case c = unit_case();
  c.regions[0].shapes = {box({1, 1, 4}, {9, 9, 6})};
  std::vector<WallParticles> walls;
  for (const Triangles& second : {right, inverted(right)}) {
    c.walls = {
        wall("floor", {stl_shape(write_temp_file("slabs.stl", binary_stl(together({left, second}))))})};
    walls.push_back(fill(c).walls);
  }
  EXPECT_TRUE(walls[0].position == walls[1].position);
  EXPECT_TRUE(walls[0].normal == walls[1].normal);
  const auto right_ones = [](const WallParticles& w) {
    return std::count_if(w.position.begin(), w.position.end(), [](Vec3d p) { return p.x > 6; });
  };
  EXPECT_GT(right_ones(walls[1]), 7 * 16 * 3 - 1);
}

}  // namespace
}  // namespace slagflow
