// Vessels filled up to a level. Spacing 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/geometry/geometry.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;

// Two basins of 4 x 6 sites, 5 deep, with a wall between that is `between` high, in a domain of 20 x 10 x 12.
Case basins(double between, Vec3d level, Vec3d from = {4, 5, 4}) {
  Case c = unit_case();
  c.domain.upper = {20, 10, 12};
  WallSpec block = wall("block", {box({0, 0, 0}, {20, 10, 8})});
  block.subtract = {box({2, 2, 3}, {6, 8, 20}), box({9, 2, 3}, {13, 8, 20}),
                    box({5, 2, 3 + between}, {10, 8, 20})};
  c.walls = {block};
  c.regions.resize(1);
  c.regions[0].shapes.clear();
  c.regions[0].fill = {true, level, from};
  return c;
}

std::size_t filled(const Case& c) { return fill(c).fluid.position.size(); }

std::string refusal(const Case& c) {
  try {
    fill(c);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(FillLevel, FillsTheVesselItStartsIn) {
  EXPECT_EQ(filled(basins(4, {0, 0, 6})), 4U * 6 * 3);
  EXPECT_EQ(filled(basins(4, {0, 0, 6}, {11, 5, 4})), 4U * 6 * 3);
}

// Over the wall between it would run into the other; both stand as high then.
TEST(FillLevel, RunsOverIntoWhatHangsTogether) {
  EXPECT_EQ(filled(basins(2, {0, 0, 6})), 2 * (4U * 6 * 3) + 3 * 6);
}

TEST(FillLevel, LevelIsSquareToGravity) {
  Case c = basins(5, {4, 0, 5});
  c.gravity = {-1, 0, -1};  // 45 degrees
  std::size_t below = 0;
  for (int x = 2; x < 6; ++x)
    for (int z = 3; z < 12; ++z) below += x + 0.5 + z + 0.5 < 9 ? 6 : 0;
  EXPECT_EQ(filled(c), below);
}

TEST(FillLevel, TakesNothingThatIsSubtractedOrEarlier) {
  Case c = basins(4, {0, 0, 6});
  c.regions[0].subtract = {box({0, 0, 0}, {20, 10, 4})};
  EXPECT_EQ(filled(c), 4U * 6 * 2);
  c = basins(4, {0, 0, 6});
  RegionSpec metal;
  metal.shapes = {box({0, 0, 0}, {20, 10, 4})};
  c.regions.insert(c.regions.begin(), metal);
  const Filling all = fill(c);
  EXPECT_EQ(all.fluid.position.size(), 2 * (4U * 6) + 4U * 6 * 2);
  EXPECT_THAT(all.warnings, testing::Not(testing::Contains(HasSubstr("region 1 starts in"))));
}

TEST(FillLevel, WhatWouldRunOutIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal(basins(4, {0, 0, 9})),
              HasSubstr("key 'region.0.fill': would run out of the domain at ("));
  EXPECT_THAT(refusal(basins(4, {0, 0, 6}, {1, 1, 1})), HasSubstr("has 'from' in a wall"));
  EXPECT_THAT(refusal(basins(4, {0, 0, 6}, {4, 5, 7})), HasSubstr("has 'from' above 'level'"));
  Case c = basins(4, {0, 0, 6});
  c.gravity = {};
  EXPECT_THAT(refusal(c), HasSubstr("needs gravity"));
}

TEST(FillLevel, IsAKeyInPlaceOfShapes) {
  const auto message = [](const std::string& region) {
    try {
      const Case c = parse_case(
          "[case]\nname='a'\n[resolution]\nspacing=0.1\n[fluid.w]\ndensity=1000\nrheology='newtonian'\n"
          "dynamic_viscosity=1\n[[region]]\n" +
              region + "\n[domain]\nmin=[0,0,0]\nmax=[1,1,1]\n[output]\nend_time=1\n",
          "a.toml");
      return to_toml(parse_case(to_toml(c), "a.toml")) == to_toml(c) ? std::string("fine")
                                                                     : std::string("differs");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(message("fill={level=[0,0,1], from=[0.5,0.5,0.5]}"), "fine");
  EXPECT_THAT(message(""), HasSubstr("key 'region.0.shapes': missing"));
  EXPECT_THAT(message("fill={level=[0,0,1]}"), HasSubstr("key 'region.0.fill.from': missing"));
  EXPECT_THAT(message("fill={level=[0,0,1], from=[0,0,0]}\nshapes=[{shape='box', min=[0,0,0], max=[1,1,1]}]"),
              HasSubstr("key 'region.0.fill': stands beside shapes: allowed: one of them"));
}

}  // namespace
}  // namespace slagflow
