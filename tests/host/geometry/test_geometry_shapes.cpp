// Signed distances and feet of the shapes; STL files, good and bad.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "backend/error.hpp"
#include "host/geometry/shapes.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

Foot nearest_foot(const Shape& shape, Vec3d p) {
  std::vector<Foot> feet;
  shape.feet(p, 10, feet);
  EXPECT_FALSE(feet.empty());
  Foot best = feet.at(0);
  for (const Foot& f : feet)
    if (norm(f.point - p) < norm(best.point - p)) best = f;
  return best;
}

void expect_near(Vec3d a, Vec3d b) { EXPECT_LT(norm(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

// Latitude-longitude sphere, all triangles outward.
std::vector<Triangle> sphere_triangles(int rings, int sectors, double radius) {
  const double pi = std::acos(-1.0);
  const auto at = [&](int r, int s) {
    const double theta = pi * r / rings, phi = 2 * pi * (s % sectors) / sectors;
    if (r == 0) return Vec3d{0, 0, radius};
    if (r == rings) return Vec3d{0, 0, -radius};
    return Vec3d{radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi),
                 radius * std::cos(theta)};
  };
  std::vector<Triangle> triangles;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      if (r + 1 < rings) triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      if (r > 0) triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
  return triangles;
}

TEST(GeometryShapes, BoxHasDistanceAndFaces) {
  const Shape shape(box({0, 0, 0}, {2, 4, 6}));
  EXPECT_DOUBLE_EQ(shape.distance({1, 0.5, 3}), -0.5);
  EXPECT_DOUBLE_EQ(shape.distance({5, 4, 10}), 5);
  EXPECT_DOUBLE_EQ(shape.distance({1, 4.25, 3}), 0.25);
  const Foot f = nearest_foot(shape, {1, 0.5, 3});
  expect_near(f.point, {1, 0, 3});
  expect_near(f.normal, {0, -1, 0});
}

TEST(GeometryShapes, ContainerHasThePlanesAPointIsBeyond) {
  const Shape shape(outside(box({0, 0, 0}, {2, 4, 6})));
  EXPECT_DOUBLE_EQ(shape.distance({1, 0.5, 3}), 0.5);
  EXPECT_DOUBLE_EQ(shape.distance({-3, 2, -4}), -5);
  std::vector<Foot> feet;
  shape.feet({-3, 2, -4}, 10, feet);
  ASSERT_EQ(feet.size(), 2u);
  expect_near(feet[0].point, {0, 2, -4});
  expect_near(feet[0].normal, {1, 0, 0});
  expect_near(feet[1].point, {-3, 2, 0});
  expect_near(feet[1].normal, {0, 0, 1});
}

TEST(GeometryShapes, PlaneIsSolidAwayFromItsNormal) {
  const Shape shape({PlaneSpec{{0, 0, 1}, {3, 0, 4}}, false});
  EXPECT_DOUBLE_EQ(shape.distance({0, 7, 2}), 0.8);
  EXPECT_DOUBLE_EQ(shape.distance({0, 7, 0}), -0.8);
  const Foot f = nearest_foot(shape, {0, 7, 0});
  expect_near(f.point, {0.48, 7, 0.64});
  expect_near(f.normal, {0.6, 0, 0.8});
}

TEST(GeometryShapes, CylinderHasSideAndCaps) {
  const Shape shape({CylinderSpec{{0, 0, 0}, {0, 10, 0}, 2}, false});
  EXPECT_DOUBLE_EQ(shape.distance({1.5, 5, 0}), -0.5);
  EXPECT_DOUBLE_EQ(shape.distance({0, 9.75, 0}), -0.25);
  EXPECT_DOUBLE_EQ(shape.distance({0, 5, 3}), 1);
  EXPECT_DOUBLE_EQ(shape.distance({5, 14, 0}), 5);
  expect_near(nearest_foot(shape, {0.9, 5, 1.2}).point, {1.2, 5, 1.6});
  expect_near(nearest_foot(shape, {0.9, 5, 1.2}).normal, {0.6, 0, 0.8});
  expect_near(nearest_foot(shape, {0.5, 9.75, 0}).normal, {0, 1, 0});
  const Shape pipe(outside({CylinderSpec{{0, 0, 0}, {0, 10, 0}, 2}, false}));
  expect_near(nearest_foot(pipe, {0, 5, 3}).normal, {0, 0, -1});
  expect_near(nearest_foot(pipe, {0, -1, 0}).normal, {0, 1, 0});
}

TEST(GeometryShapes, SphereHasRadialFeet) {
  const Shape shape({SphereSpec{{1, 0, 0}, 2}, false});
  EXPECT_DOUBLE_EQ(shape.distance({2, 0, 0}), -1);
  expect_near(nearest_foot(shape, {2, 0, 0}).point, {3, 0, 0});
  EXPECT_DOUBLE_EQ(norm(nearest_foot(shape, {1, 0, 0}).normal), 1);
}

TEST(GeometryShapes, SubtractedShapesLimitASolid) {
  const Solid solid({Shape(box({0, 0, 0}, {10, 10, 10}))}, {Shape(box({4, 4, 5}, {6, 6, 11}))});
  EXPECT_TRUE(solid.contains({1, 1, 1}));
  EXPECT_FALSE(solid.contains({5, 5, 8}));
  std::vector<Foot> feet;
  solid.feet({3.5, 5, 8}, 3, feet);
  bool side = false;
  for (const Foot& f : feet) side = side || (norm(f.point - Vec3d{4, 5, 8}) < 1e-12 && f.normal.x == 1);
  EXPECT_TRUE(side);
}

TEST(GeometryStl, BinaryAndAsciiBoxEqualTheBox) {
  const Vec3d a{-1, -2, 0.5}, b{3, 1, 2.25};
  const Shape exact(box(a, b));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-4, 4);
  for (const std::string& bytes : {binary_stl(box_triangles(a, b)), ascii_stl(box_triangles(a, b))}) {
    const Shape stl(stl_shape(write_temp_file("box.stl", bytes)));
    int inside = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3d p{at(random), at(random), at(random)};
      const double d = exact.distance(p);
      EXPECT_EQ(stl.distance(p) < 0, d < 0);
      EXPECT_LE(std::abs(stl.distance(p)), std::abs(d) + 1e-12);  // far away: a lower bound
      if (d >= 0) continue;
      ++inside;
      EXPECT_NEAR(stl.distance(p), d, 1e-12);
      expect_near(nearest_foot(stl, p).point, nearest_foot(exact, p).point);
      expect_near(nearest_foot(stl, p).normal, nearest_foot(exact, p).normal);
    }
    EXPECT_GT(inside, 100);
  }
}

TEST(GeometryStl, ScaleAndTranslationApply) {
  const std::string path = write_temp_file("unit.stl", binary_stl(box_triangles({0, 0, 0}, {1, 1, 1})));
  const Shape shape({StlSpec{path, 1e-3, {5, 0, 0}}, false});
  EXPECT_NEAR(shape.distance({5.0005, 0.0005, 0.0001}), -0.0001, 1e-15);
}

TEST(GeometryStl, InvertedTrianglesAreTurned) {
  std::vector<Triangle> triangles = box_triangles({0, 0, 0}, {1, 1, 1});
  for (Triangle& t : triangles) std::swap(t[0], t[1]);
  const Shape shape(stl_shape(write_temp_file("inverted.stl", binary_stl(triangles))));
  EXPECT_NEAR(shape.distance({0.5, 0.5, 0.75}), -0.25, 1e-12);
  expect_near(nearest_foot(shape, {0.5, 0.5, 0.75}).normal, {0, 0, 1});
}

TEST(GeometryStl, OverlappingShellsAreAUnion) {
  std::vector<Triangle> triangles = box_triangles({0, 0, 0}, {2, 2, 2});
  for (const Triangle& t : box_triangles({1, 1, 1}, {3, 3, 3})) triangles.push_back(t);
  const Shape shape(stl_shape(write_temp_file("two.stl", binary_stl(triangles))));
  EXPECT_LT(shape.distance({1.5, 1.5, 1.5}), 0);  // inside both
  EXPECT_LT(shape.distance({2.5, 2.5, 2.5}), 0);
  EXPECT_GT(shape.distance({0.5, 0.5, 2.5}), 0);
}

TEST(GeometryStl, TwentyThousandTrianglesAndTwoHundredThousandPointsTakeSeconds) {
  const Shape shape(stl_shape(write_temp_file("sphere.stl", binary_stl(sphere_triangles(100, 102, 1)))));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(-1.1, 1.1);
  const auto start = std::chrono::steady_clock::now();
  int wrong = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec3d p{at(random), at(random), at(random)};
    // The facets lie up to 1 - cos(pi / 100) = 5e-4 inside the sphere.
    const double r = norm(p), d = shape.distance(p);
    if (r < 1 - 1e-3 ? d >= 0 : (r > 1 && d < 0)) ++wrong;
    if (r < 1 && std::abs(-d - (1 - r)) > 1.1e-3) ++wrong;
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(taken.count(), 60);  // about 2 s; brute force would take minutes
}

TEST(GeometryStl, BadFilesAreRefusedWithTheReason) {
  const std::vector<Triangle> good = box_triangles({0, 0, 0}, {1, 1, 1});
  const std::string bytes = binary_stl(good), text = ascii_stl(good);
  const auto error = [](const std::string& content) {
    const std::string path = write_temp_file("bad.stl", content);
    return error_of([&] { make_form(stl_shape(path)); });
  };
  using testing::HasSubstr;
  EXPECT_EQ(error(bytes), "accepted");
  EXPECT_THAT(error(""), HasSubstr("too short for an STL file"));
  EXPECT_THAT(error(bytes.substr(0, 50)), HasSubstr("too short"));
  EXPECT_THAT(error(bytes.substr(0, bytes.size() - 1)), HasSubstr("announces 12 triangles = 684 bytes"));
  EXPECT_EQ(error(bytes + "abc"), "accepted");  // some writers round the size up
  EXPECT_THAT(error(bytes + std::string(50, 'x')),
              HasSubstr("734 bytes, but its header announces 12 triangles"));
  EXPECT_THAT(error(binary_stl({})), HasSubstr("holds no triangle"));
  EXPECT_THAT(error("solid a\nendsolid a\n"), HasSubstr("holds no triangle"));
  EXPECT_THAT(error(text.substr(0, text.size() / 2)), HasSubstr("expected, found"));
  EXPECT_THAT(error("solid a\n facet normal 0 0 1\n outer loop\n vertex 0 zero 0"),
              HasSubstr("bad.stl:4: a number expected, found 'zero'"));
  EXPECT_THAT(error("solid a\n"), HasSubstr("found the end of the file"));
  EXPECT_THAT(error(binary_stl({good.begin(), good.end() - 1})), HasSubstr("not closed: 3 open edges"));
  std::vector<Triangle> turned = good;
  std::swap(turned[0][0], turned[0][1]);
  EXPECT_THAT(error(binary_stl(turned)), HasSubstr("do not agree which side is outside, at 3 edges"));
  std::vector<Triangle> flat = good;
  for (Triangle& t : flat)
    for (Vec3d& v : t) v = {1, 1, 1};
  EXPECT_THAT(error(binary_stl(flat)), HasSubstr("no triangle has an area"));
  std::vector<Triangle> nan = good;
  nan[3][1].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error(binary_stl(nan)), HasSubstr("triangle 3 has a coordinate that is not a number"));
  std::string huge = bytes;
  const std::uint32_t many = 0xffffffff;
  std::memcpy(&huge[80], &many, sizeof many);
  EXPECT_THAT(error(huge), HasSubstr("announces 4294967295 triangles"));
}

TEST(GeometryStl, MissingFileIsNamed) {
  const std::string path = testing::TempDir() + "no_such.stl";
  EXPECT_THAT(error_of([&] { make_form(stl_shape(path)); }),
              testing::HasSubstr("no_such.stl: cannot be read"));
}

}  // namespace
}  // namespace slagflow
