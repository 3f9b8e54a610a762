// Open surfaces with a thickness. Volumes are those of the bodies between faces and their copies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/geometry/shapes.hpp"
#include "host/geometry/stl_plate.hpp"
#include "host/geometry/stl_surface.hpp"

namespace slagflow {
namespace {

using Triangles = std::vector<Triangle>;

// Two triangles a-b-c-d whose normal is that of the right-hand rule.
void add_face(Triangles& surface, Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  surface.push_back({a, b, c}), surface.push_back({a, c, d});
}

// 2 m by 1 m at z = 0, normal up.
Triangles sheet() {
  Triangles surface;
  add_face(surface, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0});
  return surface;
}

// The lower half of a pipe of radius 1 m along y, 2 m long, normals to its axis.
Triangles channel(int faces) {
  Triangles surface;
  const auto at = [&](int k, double y) {
    const double angle = 3.14159265358979323846 * (1 + static_cast<double>(k) / faces);
    return Vec3d{std::cos(angle), y, std::sin(angle)};
  };
  for (int k = 0; k < faces; ++k) add_face(surface, at(k, 0), at(k + 1, 0), at(k + 1, 2), at(k, 2));
  return surface;
}

// A vessel of 2 m by 2 m by 1 m, open above, normals inwards.
Triangles tray() {
  Triangles surface;
  add_face(surface, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0});
  add_face(surface, {0, 0, 0}, {0, 2, 0}, {0, 2, 1}, {0, 0, 1});
  add_face(surface, {2, 0, 0}, {2, 0, 1}, {2, 2, 1}, {2, 2, 0});
  add_face(surface, {0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 0});
  add_face(surface, {0, 2, 0}, {2, 2, 0}, {2, 2, 1}, {0, 2, 1});
  return surface;
}

double volume(const Triangles& closed) {
  double sum = 0;
  for (const Triangle& t : closed) sum += dot(t[0], cross(t[1], t[2])) / 6;
  return sum;
}

Triangles closed_plate(const Triangles& surface, double thickness, PlateSide side = PlateSide::back) {
  return closed_surface(plate(surface, thickness, side, "shell.stl"), "shell.stl");
}

std::string refusal(const Triangles& surface) {
  try {
    closed_plate(surface, 0.1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StlPlate, LiesOnTheSideThatIsAskedFor) {
  const struct {
    PlateSide side;
    double lower, upper;  // [m]
  } all[] = {{PlateSide::back, -0.1, 0}, {PlateSide::front, 0, 0.1}, {PlateSide::middle, -0.05, 0.05}};
  for (const auto& wanted : all) {
    const auto form = make_surface_form(closed_plate(sheet(), 0.1, wanted.side));
    EXPECT_NEAR(form->extents().lower.z, wanted.lower, 1e-12);
    EXPECT_NEAR(form->extents().upper.z, wanted.upper, 1e-12);
    EXPECT_NEAR(form->distance({1, 0.5, 0.5 * (wanted.lower + wanted.upper)}), -0.05, 1e-12);
    EXPECT_NEAR(volume(closed_plate(sheet(), 0.1, wanted.side)), 0.2, 1e-12);
  }
}

// A facet of n stands tan(pi / 2n) wide on either side at an apothem of 1.
TEST(StlPlate, OfAChannelHasItsThicknessBehindEachFacet) {
  constexpr int facets = 48;
  constexpr double t = 0.2;
  const double half_angle = 3.14159265358979323846 / (2 * facets), apothem = std::cos(half_angle);
  // Facets of the rim end where their own normal leads, not the bisector: less by t^2 tan of half the angle.
  const double section = facets * std::tan(half_angle) * (std::pow(apothem + t, 2) - apothem * apothem) -
                         t * t * std::tan(half_angle);
  EXPECT_NEAR(volume(closed_plate(channel(facets), t)), 2 * section, 1e-9);
  const auto form = make_surface_form(closed_plate(channel(facets), t));
  for (int k = 1; k < facets - 1; ++k) {  // the rim is nearer to the others
    const double angle = 3.14159265358979323846 * (1 + (k + 0.5) / facets);
    const Vec3d out{std::cos(angle), 0, std::sin(angle)}, middle{0, 1, 0};
    EXPECT_GT(form->distance(middle + (apothem - 1e-6) * out), 0) << k;
    EXPECT_NEAR(form->distance(middle + (apothem + 0.05) * out), -0.05, 1e-9) << k;
    EXPECT_NEAR(form->distance(middle + (apothem + t - 0.05) * out), -0.05, 1e-9) << k;
    EXPECT_GT(form->distance(middle + (apothem + t + 1e-6) * out), 0) << k;
  }
}

// Outer box less the inner one.
TEST(StlPlate, OfATrayHasWholeEdgesAndCorners) {
  constexpr double t = 0.1;
  EXPECT_NEAR(volume(closed_plate(tray(), t)), 2.2 * 2.2 * 1.1 - 2.0 * 2.0 * 1.0, 1e-9);
  const auto form = make_surface_form(closed_plate(tray(), t));
  EXPECT_LT(form->distance({-0.09, -0.09, -0.09}), 0);
  EXPECT_LT(form->distance({2.09, 1, 0.99}), 0);
  EXPECT_GT(form->distance({1, 1, 0.01}), 0);
}

TEST(StlPlate, OfATrayInsideLeavesLessRoom) {
  EXPECT_NEAR(volume(closed_plate(tray(), 0.1, PlateSide::front)), 2.0 * 2.0 * 1.0 - 1.8 * 1.8 * 0.9, 1e-9);
}

TEST(StlPlate, TurnsTrianglesThatDoNotAgreeWithTheFirst) {
  for (std::size_t k = 1; k < tray().size(); ++k) {
    Triangles mixed = tray();
    std::swap(mixed[k][0], mixed[k][1]);
    EXPECT_NEAR(volume(closed_plate(mixed, 0.1)), 2.2 * 2.2 * 1.1 - 4, 1e-9) << k;
  }
}

// Outside of the box, and inside.
TEST(StlPlate, OfAClosedSurfaceIsAShell) {
  Triangles box = tray();
  add_face(box, {0, 0, 1}, {0, 2, 1}, {2, 2, 1}, {2, 0, 1});  // the lid; all normals inwards
  EXPECT_NEAR(volume(closed_plate(box, 0.1)), 2.2 * 2.2 * 1.2 - 4, 1e-9);
  EXPECT_NEAR(volume(closed_plate(box, 0.1, PlateSide::front)), 4 - 1.8 * 1.8 * 0.8, 1e-9);
}

TEST(StlPlate, RefusesThreeTrianglesAtAnEdge) {
  Triangles fin = sheet();
  fin.push_back({Vec3d{0, 0, 0}, Vec3d{2, 1, 0}, Vec3d{1, 0.5, 1}});  // on the diagonal
  EXPECT_THAT(refusal(fin), testing::HasSubstr("shell.stl: the surface has an edge of 3 triangles, from ("));
}

// Two quads stand on the edge of the sheet, which is one triangle's.
TEST(StlPlate, RefusesCornersOnAnEdge) {
  Triangles split = sheet();
  add_face(split, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1});
  add_face(split, {1, 1, 0}, {2, 1, 0}, {2, 1, 1}, {1, 1, 1});
  EXPECT_THAT(refusal(split),
              testing::HasSubstr("has a corner at (1, 1, 0) m in the middle of an edge, from ("));
}

// A band of five quads, the last of which is glued upside down to the first.
TEST(StlPlate, RefusesASurfaceWithOneSide) {
  constexpr int quads = 5;
  const auto at = [](int k, double across) {
    const double turn = 2 * 3.14159265358979323846 * k / quads, half = 0.5 * turn;
    const double radius = 3 + across * std::cos(half);
    return Vec3d{radius * std::cos(turn), radius * std::sin(turn), across * std::sin(half)};
  };
  Triangles band;
  for (int k = 0; k < quads; ++k) add_face(band, at(k, -1), at(k + 1, -1), at(k + 1, 1), at(k, 1));
  EXPECT_THAT(refusal(band), testing::HasSubstr("has one side only"));
}

TEST(StlPlate, IsOfferedWhereASurfaceIsOpen) {
  try {
    closed_surface(sheet(), "shell.stl");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'thickness' makes a plate of an open surface"));
  }
}

}  // namespace
}  // namespace slagflow
