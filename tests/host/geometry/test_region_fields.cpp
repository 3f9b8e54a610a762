// How fluid starts: jitter, waves of velocity, uniform pressure. Spacing 1, sites at n + 1/2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/geometry.hpp"
#include "host/geometry/region_fields.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

Vec3d site_of(Vec3d p) { return {std::floor(p.x) + 0.5, std::floor(p.y) + 0.5, std::floor(p.z) + 0.5}; }

TEST(Jitter, SpreadsEvenlyAroundTheSites) {
  Case c = unit_case();
  c.regions[0].shapes = {box({0, 0, 0}, {10, 10, 10})};
  c.regions[0].jitter = 0.25;
  const auto position = fill(c).fluid.position;
  ASSERT_EQ(position.size(), 1000u);
  Vec3d mean;
  for (int k = 0; k < 3; ++k) {
    double squares = 0, largest = 0;
    for (const Vec3d& p : position) {
      const double offset = p[k] - site_of(p)[k];
      mean[k] += offset / 1000, squares += offset * offset / 1000;
      largest = std::max(largest, std::abs(offset));
    }
    // A uniform spread over +-0.25 has a standard deviation of 0.1443; 1000 draws give it to 2 %, three
    // sigma.
    EXPECT_NEAR(std::sqrt(squares), 0.25 / std::sqrt(3), 0.006);
    EXPECT_NEAR(mean[k], 0, 3 * 0.1443 / std::sqrt(1000));
    EXPECT_LE(largest, 0.25);
    EXPECT_GT(largest, 0.245);
  }
}

TEST(Jitter, IsTheSameEveryTimeAndOnEveryMachine) {
  const Vec3d first = jitter_of(0);
  // The generator's published first output for the seed 0 is 0xe220a8397b1dcdaf.
  EXPECT_DOUBLE_EQ(first.x, 2 * static_cast<double>(0xe220a8397b1dcdafu >> 11) / 9007199254740992.0 - 1);
  EXPECT_TRUE(first == jitter_of(0));
  EXPECT_FALSE(first == jitter_of(1));
}

TEST(Jitter, KeepsOffWallsAndInsideTheDomain) {
  Case c = unit_case();
  c.walls = {wall("floor", {{PlaneSpec{{0, 0, 2}, {0, 0, 1}}, false}})};
  c.regions[0].shapes = {box({0, 0, 2}, {10, 10, 10})};
  c.regions[0].jitter = 0.5;
  c.domain.periodic[0] = true;
  const auto position = fill(c).fluid.position;
  ASSERT_EQ(position.size(), 800u);
  bool wrapped = false;
  for (const Vec3d& p : position) {
    EXPECT_GE(p.z, 2.25);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(p[k], 0);
      EXPECT_LT(p[k], 10);
    }
    wrapped = wrapped || p.x > 9.9;
  }
  EXPECT_TRUE(wrapped);
}

TEST(Jitter, StaysInThePlaneWithTwoDimensions) {
  Case c = unit_case();
  c.dimensions = 2;
  c.regions[0].shapes = {box({2, -1, 2}, {6, 1, 6})};
  c.regions[0].jitter = 0.3;
  const auto position = fill(c).fluid.position;
  ASSERT_EQ(position.size(), 16u);
  for (const Vec3d& p : position) EXPECT_EQ(p.y, 0);
}

TEST(Waves, AddUpToTaylorAndGreensVortices) {
  RegionSpec region;
  const double u = 0.3, f = 0.25;  // [m/s], [1/m]
  region.waves = {{{u / 2, 0, -u / 2}, {f, 0, f}, 0}, {{u / 2, 0, u / 2}, {f, 0, -f}, 0}};
  region.velocity = {1, 2, 3};
  const double k = 2 * 3.14159265358979323846 * f;
  for (const Vec3d p : {Vec3d{0.1, 5, 0.7}, Vec3d{3.3, -1, 2.9}, Vec3d{1, 0, 0}}) {
    const Vec3d v = initial_velocity(region, p) - region.velocity;
    EXPECT_NEAR(v.x, u * std::sin(k * p.x) * std::cos(k * p.z), 1e-12);
    EXPECT_EQ(v.y, 0);
    EXPECT_NEAR(v.z, -u * std::cos(k * p.x) * std::sin(k * p.z), 1e-12);
  }
}

TEST(Waves, ReadFromACaseAndWrittenBack) {
  const std::string text = to_toml(unit_case());
  Case c = parse_case(text, "unit.toml",
                      {"region.0.waves=[{amplitude=[0.5,0,0], wave_vector=[0,0,2], phase=1.5}]",
                       "region.0.jitter=0.125", "region.0.pressure=7"});
  ASSERT_EQ(c.regions[0].waves.size(), 1u);
  EXPECT_EQ(c.regions[0].waves[0].wave_vector.z, 2);
  const Case again = parse_case(to_toml(c), "again.toml");
  EXPECT_EQ(again.regions[0].waves[0].amplitude.x, 0.5);
  EXPECT_EQ(again.regions[0].waves[0].phase, 1.5);
  EXPECT_EQ(again.regions[0].jitter, 0.125);
  EXPECT_EQ(again.regions[0].uniform_pressure, 7);
  EXPECT_EQ(to_toml(again), to_toml(c));
}

TEST(UniformPressure, IsThatOfEveryParticle) {
  Case c = unit_case();
  c.regions[0].pressure = InitialPressure::uniform;
  c.regions[0].uniform_pressure = 12;
  EXPECT_THAT(fill(c).fluid.pressure, testing::Each(12.0));
}

}  // namespace
}  // namespace slagflow
