// Frusta, prisms and shapes that are moved and turned.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "backend/error.hpp"
#include "host/geometry/shapes.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

ShapeSpec frustum(Vec3d start, Vec3d end, double a, double b) {
  return {FrustumSpec{start, end, a, b}, false};
}
ShapeSpec prism(int axis, std::vector<std::array<double, 2>> points, double from, double to) {
  return {PrismSpec{axis, std::move(points), from, to}, false};
}

template <class Visit>
void for_random_places(double reach, const Visit& visit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-reach, reach);
  for (int k = 0; k < 4000; ++k) visit(Vec3d{in(random), in(random), in(random)});
}

// Both hold the same places, at the same distances as far as they are exact.
void expect_same(const Shape& a, const Shape& b, double reach) {
  int inside = 0;
  for_random_places(reach, [&](Vec3d p) {
    const double one = a.distance(p), other = b.distance(p);
    ASSERT_EQ(one < 0, other < 0) << p.x << " " << p.y << " " << p.z;
    if (one < 0) {
      ASSERT_NEAR(one, other, 1e-9);
    }
    inside += one < 0;
  });
  EXPECT_GT(inside, 50);
}

TEST(ShapesDrawn, FrustumOfOneRadiusIsACylinder) {
  const Vec3d a{-1, 0.5, 0}, b{2, 1, 1};
  expect_same(Shape(frustum(a, b, 0.8, 0.8)), Shape({CylinderSpec{a, b, 0.8}, false}), 3);
}

// A point straight off the side is as far from it as the cone's slope makes it.
TEST(ShapesDrawn, FrustumHasItsSlope) {
  const Shape cone(frustum({0, 0, 0}, {0, 0, 4}, 3, 0));  // side along 3 across, 4 up
  EXPECT_NEAR(cone.distance({0, 0, 2}), -std::min(2.0, 0.8 * 1.5), 1e-12);
  EXPECT_NEAR(cone.distance({1.5 + 0.8, 0, 2 + 0.6}), 1, 1e-12);
  EXPECT_GT(cone.distance({0, 0, 4.5}), 0);
  std::vector<Foot> feet;
  cone.feet({1, 0, 2}, 10, feet);
  bool found = false;
  for (const Foot& f : feet) found = found || norm(f.normal - Vec3d{0.8, 0, 0.6}) < 1e-12;
  EXPECT_TRUE(found);
  const Extents e = cone.extents();
  EXPECT_NEAR(norm(e.lower - Vec3d{-3, -3, 0}) + norm(e.upper - Vec3d{3, 3, 4}), 0, 1e-12);
}

TEST(ShapesDrawn, PrismOfARectangleIsABox) {
  const Shape cuboid(box({-1, -2, -0.5}, {2, 1, 1.5}));
  expect_same(Shape(prism(1, {{-1, -0.5}, {2, -0.5}, {2, 1.5}, {-1, 1.5}}, -2, 1)), cuboid, 3);
  expect_same(Shape(prism(2, {{-1, 1}, {2, 1}, {2, -2}, {-1, -2}}, -0.5, 1.5)), cuboid, 3);  // clockwise
  expect_same(Shape(prism(0, {{-2, -0.5}, {1, -0.5}, {1, 1.5}, {-2, 1.5}}, -1, 2)), cuboid, 3);
}

// An L, with a dent, against two boxes; as container too.
TEST(ShapesDrawn, PrismMayHaveDents) {
  const Shape l(prism(1, {{-1, -1}, {2, -1}, {2, 0}, {0, 0}, {0, 2}, {-1, 2}}, -1, 1));
  const Solid boxes({Shape(box({-1, -1, -1}, {2, 1, 0})), Shape(box({-1, -1, -1}, {0, 1, 2}))}, {});
  for_random_places(3, [&](Vec3d p) {
    ASSERT_EQ(l.distance(p) < 0, boxes.contains(p));
    std::vector<Foot> feet;
    if (l.distance(p) < 0) {
      l.feet(p, 10, feet);
      double nearest = 1e9;
      for (const Foot& f : feet)
        if (l.distance(f.point + 1e-6 * f.normal) > 0) nearest = std::min(nearest, norm(f.point - p));
      // The dent's corner is no face.
      const double corner = std::hypot(p.x, p.z);
      ASSERT_NEAR(std::min(nearest, p.x < 0 && p.z < 0 ? corner : 1e9), -l.distance(p), 1e-9);
    }
  });
}

TEST(ShapesDrawn, TurnedAndMovedIsAsIfDrawnThere) {
  ShapeSpec turned = box({0, 0, 0}, {2, 1, 3});
  turned.move = {1, 0, 0}, turned.turn = {0, 0, std::acos(-1.0) / 2}, turned.center = {1, 1, 0};
  // (x, y) of the moved box goes to (1 - (y - 1), 1 + (x - 1)).
  expect_same(Shape(turned), Shape(box({1, 1, 0}, {2, 3, 3})), 4);
  const Extents e = Shape(turned).extents();
  EXPECT_NEAR(norm(e.lower - Vec3d{1, 1, 0}) + norm(e.upper - Vec3d{2, 3, 3}), 0, 1e-12);
  std::vector<Foot> feet;
  Shape(turned).feet({1.1, 2, 1.5}, 10, feet);
  bool found = false;
  for (const Foot& f : feet)
    found = found || (norm(f.point - Vec3d{1, 2, 1.5}) < 1e-12 && norm(f.normal - Vec3d{-1, 0, 0}) < 1e-12);
  EXPECT_TRUE(found);
}

TEST(ShapesDrawn, EndlessStaysEndlessWhenTurned) {
  ShapeSpec plane{PlaneSpec{{0, 0, 1}, {0, 0, 1}}, false};
  plane.turn = {0, 0.3, 0};
  EXPECT_FALSE(std::isfinite(norm(Shape(plane).extents().lower)));
  EXPECT_NEAR(Shape(plane).distance({0, 0, 0}), -1, 1e-12);
}

TEST(ShapesDrawn, StlTurnsWithItsFaces) {
  ShapeSpec stl = stl_shape(write_temp_file("turned.stl", binary_stl(box_triangles({0, 0, 0}, {2, 1, 3}))));
  ShapeSpec cuboid = box({0, 0, 0}, {2, 1, 3});
  stl.turn = cuboid.turn = {0.3, -0.5, 0.2}, stl.center = cuboid.center = {1, 0, 0};
  expect_same(Shape(stl), Shape(cuboid), 4);
}

std::string message_of(const std::string& shape) {
  try {
    parse_case(
        "[case]\nname='a'\n[resolution]\nspacing=0.1\n[fluid.w]\ndensity=1000\nrheology='newtonian'\n"
        "dynamic_viscosity=1\n[[region]]\nshapes=[" +
            shape + "]\n[domain]\nmin=[0,0,0]\nmax=[1,1,1]\n[output]\nend_time=1\n",
        "a.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ShapesDrawn, WrongOnesAreRefused) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  EXPECT_EQ(message_of("{shape='prism', along='y', points=[[0,0],[1,0],[0,1]], from=0, to=1}"), "no error");
  has(message_of("{shape='prism', along='y', points=[[0,0],[1,0]], from=0, to=1}"),
      "has 2 corners: allowed: at least");
  has(message_of("{shape='prism', along='y', points=[[0,0],[1,1],[1,0],[0,1]], from=0, to=1}"),
      "edges that cross");
  has(message_of("{shape='prism', along='y', points=[[0,0],[1,0],[0,1]], from=1, to=1}"),
      "is not above from");
  has(message_of("{shape='prism', along='y', from=0, to=1}"), "shapes.0.points': missing");
  has(message_of("{shape='frustum', start=[0,0,0], end=[0,0,1], start_radius=0, end_radius=0}"),
      "one of them above 0");
  has(message_of("{shape='box', min=[0,0,0], max=[1,1,1], rotate=[0,0,1,2]}"),
      "wrong type: allowed: a list [x, y, z]");
  has(message_of("{shape='box', min=[0,0,0], max=[1,1,1], rotate=[0,0,30]}"),
      "more than a turn: allowed: up to 2 pi");
  has(message_of("{shape='box', min=[0,0,0], max=[1,1,1], file='a'}"), "file goes with shape = \"stl\"");
}

}  // namespace
}  // namespace slagflow
