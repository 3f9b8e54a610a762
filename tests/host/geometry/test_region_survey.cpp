// Regions without a particle, and what is cut of others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/geometry/region_survey.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::string error_of(const Case& c) {
  try {
    build_setup(c);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

Case with_region(const ShapeSpec& shape) {
  Case c = unit_case();
  c.regions[0].shapes = {shape};
  return c;
}

TEST(RegionSurvey, EachCauseOfNoParticleHasItsMessage) {
  const auto says = [](const std::string& what) {
    return AllOf(HasSubstr("key 'region.0': no particle: "), HasSubstr(what),
                 HasSubstr(": allowed: shapes that hold a lattice site"));
  };
  EXPECT_THAT(
      error_of(with_region(box({20, 4, 4}, {30, 6, 6}))),
      says("the region lies outside the domain; it reaches from (20, 4, 4) to (30, 6, 6) m, the domain from "
           "(0, 0, 0) to (10, 10, 10) m"));
  EXPECT_THAT(error_of(with_region(box({4, 4, 4.6}, {6, 6, 4.9}))),
              says("the region is thinner than the spacing of 1.0 m"));
  EXPECT_THAT(error_of(with_region({SphereSpec{{5, 5, 5}, 0.3}, false})), says("thinner than the spacing"));
  Case walled = with_region(box({4, 4, 4}, {6, 6, 6}));
  walled.walls = {wall("block", {box({3, 3, 3}, {7, 7, 7})})};
  EXPECT_THAT(
      error_of(walled),
      says("inside walls, which have all of its 8 lattice sites in the domain; most are in wall 'block'"));
  Case taken = with_region(box({4, 4, 4}, {6, 6, 6}));
  taken.regions.push_back(taken.regions[0]);
  EXPECT_THAT(error_of(taken), HasSubstr("key 'region.1': no particle: earlier regions have all of its 8"));
  Case empty = with_region(box({4, 4, 4}, {6, 6, 6}));
  empty.regions[0].subtract = {box({3, 3, 3}, {7, 7, 7})};
  EXPECT_THAT(error_of(empty), says("subtract takes all of the region away"));
  Case plane = with_region(box({4, 4, 4}, {6, 6, 6}));
  plane.dimensions = 2;
  EXPECT_THAT(error_of(plane), says("does not hold the plane y = 0"));
  // Outside of the domain by a body that meets its box.
  EXPECT_THAT(error_of(with_region({CylinderSpec{{-6, 5, 5}, {5, 5, -6}, 0.6}, false})),
              says("outside the domain"));
}

std::string stl_box(const std::string& name, Vec3d a, Vec3d b) {
  return write_temp_file(name, binary_stl(box_triangles(a, b)));
}

TEST(RegionSurvey, AFileInAnotherUnitIsTold) {
  // 2 to 8 m in other units.
  const std::string mm = stl_box("mm.stl", {2000, 2000, 2000}, {8000, 8000, 8000});
  EXPECT_THAT(error_of(with_region(stl_shape(mm))),
              AllOf(HasSubstr("'mm.stl' reaches from (2000, 2000, 2000) to (8000, 8000, 8000) m"),
                    HasSubstr("with scale = 0.001 it would fit")));
  const std::string inches = stl_box("inches.stl", {80, 80, 80}, {320, 320, 320});
  EXPECT_THAT(error_of(with_region(stl_shape(inches))), HasSubstr("with scale = 0.0254 it would fit"));
  const std::string metres = stl_box("metres.stl", {2, 2, 2}, {8, 8, 8});
  ShapeSpec shrunk = stl_shape(metres);
  std::get<StlSpec>(shrunk.form).scale = 1e-3;
  EXPECT_THAT(error_of(with_region(shrunk)), HasSubstr("with scale = 1.0 it would fit"));
  EXPECT_EQ(error_of(with_region(stl_shape(metres))), "accepted");
  EXPECT_THAT(error_of(with_region(stl_shape(stl_box("far.stl", {20, 20, 20}, {28, 28, 28})))),
              AllOf(HasSubstr("outside the domain"), Not(HasSubstr("scale"))));
}

TEST(RegionSurvey, AWallInAnotherUnitIsTold) {
  Case c = unit_case();
  c.walls = {
      wall("mould", {outside(stl_shape(stl_box("mould.stl", {-1000, -1000, -1000}, {9000, 9000, 9000})))})};
  EXPECT_THAT(build_setup(c).warnings,
              Contains(AllOf(HasSubstr("wall 'mould' has no particle"), HasSubstr("with scale = 0.001"))));
  c.walls = {wall("mould", {stl_shape(stl_box("mould.stl", {-1, -1, -1}, {9000, 9000, 9000}))})};
  EXPECT_THAT(error_of(c), AllOf(HasSubstr("inside walls"), HasSubstr("with scale = 0.001")));
}

TEST(RegionSurvey, AWallThatIsThereInAnotherUnitIsTold) {
  // -1 to 9.9 m in mm: the domain is 10 m.
  ShapeSpec shape = stl_shape(stl_box("trough.stl", {-1000, -1000, -1000}, {9900, 9900, 9900}));
  const auto warnings = [&](double scale) {
    Case c = unit_case();
    std::get<StlSpec>(shape.form).scale = scale;
    c.walls = {wall("trough", {box({0, 0, 0}, {10, 10, 4}), outside(shape)})};
    return build_setup(c).warnings;
  };
  for (const double scale : {1e-2, 0.0254, 0.1, 1.0})
    EXPECT_THAT(warnings(scale),
                Contains(AllOf(HasSubstr("wall 'trough' does not suit the domain; 'trough.stl'"),
                               HasSubstr("with scale = 0.001 it would fit"))));
  EXPECT_THAT(warnings(1e-3), Not(Contains(HasSubstr("suit"))));
  Case small = unit_case();
  std::get<StlSpec>(shape.form).scale = 1e-5;
  small.walls = {wall("trough", {shape})};
  EXPECT_THAT(build_setup(small).warnings,
              Contains(AllOf(HasSubstr("no particle"), HasSubstr("scale = 0.001"))));
}

TEST(RegionSurvey, WhatIsCutIsTold) {
  const auto warnings = [](const Case& c) { return build_setup(c).warnings; };
  EXPECT_THAT(
      warnings(with_region(box({4, 4, 4}, {14, 6, 6}))),
      Contains(AllOf(HasSubstr("region 0 lies partly outside the domain: 40 % of it, 1.58e+04 litres"),
                     HasSubstr("it reaches from (4, 4, 4) to (14, 6, 6) m"))));
  EXPECT_THAT(warnings(with_region(box({4, 4, 4}, {10, 6, 6}))), Not(Contains(HasSubstr("outside"))));
  EXPECT_THAT(warnings(with_region({PlaneSpec{{0, 0, 5}, {0, 0, 1}}, false})),
              Not(Contains(HasSubstr("outside"))));
  Case seam = with_region(box({8, 4, 4}, {12, 6, 6}));  // shapes do not come round a periodic face
  seam.domain.periodic = {true, false, false};
  EXPECT_THAT(warnings(seam), Contains(HasSubstr("region 0 lies partly outside the domain: 50 % of it")));
  seam = with_region(box({-1, 4, 4}, {12, 6, 6}));
  seam.domain.periodic = {true, false, false};
  EXPECT_THAT(warnings(seam), Not(Contains(HasSubstr("outside"))));
  Case c = with_region(box({1, 1, 1}, {9, 9, 9}));
  c.walls = {wall("block", {box({0, 0, 0}, {10, 10, 6})})};
  EXPECT_THAT(warnings(c),
              Contains(AllOf(HasSubstr("region 0 lies partly in walls: 62 % of it, 3.2e+05 litres"),
                             HasSubstr("wall 'block'"))));
}

}  // namespace
}  // namespace slagflow
