#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/measures.hpp"

namespace slagflow {
namespace {

TEST(ArrivalClock, InterpolatesBetweenTheLinesAroundTheFraction) {
  ArrivalClock clock(0.002);
  EXPECT_FALSE(clock.update(0.00, 0));
  EXPECT_FALSE(clock.update(0.10, 0.001));
  EXPECT_TRUE(clock.update(0.20, 0.005));
  EXPECT_NEAR(clock.arrival().value(), 0.125, 1e-12);  // a quarter of the way
}

TEST(ArrivalClock, KeepsTheFirstArrival) {
  ArrivalClock clock(0.5);
  clock.update(0, 0);
  EXPECT_TRUE(clock.update(1, 1));
  EXPECT_FALSE(clock.update(2, 0));
  EXPECT_FALSE(clock.update(3, 1));
  EXPECT_DOUBLE_EQ(clock.arrival().value(), 0.5);
}

TEST(ArrivalClock, TakesTheFirstTimeWhenAllHasPassedAlready) {
  ArrivalClock clock(0.1);
  EXPECT_TRUE(clock.update(0.25, 0.9));
  EXPECT_DOUBLE_EQ(clock.arrival().value(), 0.25);
}

TEST(ArrivalClock, HasNoArrivalBelowTheFraction) {
  ArrivalClock clock(0.5);
  clock.update(0, 0);
  clock.update(1, 0.499);
  EXPECT_FALSE(clock.arrival().has_value());
}

// A lip at x = 0.01, z = 0.02; the level 0.15 below it at z = -0.13.
JetGeometry jet_geometry() { return {{0.01, 0, 0.02}, {0, 1}, {2, -1, -0.13}, 0.001}; }

TEST(Jet, FreeJetHasItsAngleFromThePointsBeyondTheLevel) {
  // Beyond the level at 0.03 and 0.06 from the lip: mean 0.045 on a drop of 0.15.
  const std::vector<Vec3d> positions{{0.04, 0, -0.131},
                                     {0.07, 0, -0.14},
                                     {0.5, 0, -0.129},
                                     // at 2/3 of the drop, z = -0.08
                                     {0.035, 0, -0.0805},
                                     {0.05, 0, -0.0795},
                                     {0.012, 0, -0.0812}};
  const JetShape shape = measure_jet(jet_geometry(), positions);
  EXPECT_NEAR(shape.tan_theta, 0.3, 1e-12);
  EXPECT_NEAR(shape.inner_offset, 0.025 + 0.02 * 0.015, 1e-12);  // 2nd percentile of 0.025 and 0.04
  EXPECT_EQ(shape.flow_class, "free-jet");
}

TEST(Jet, WallFlowHasItsInnerSurfaceWithinTwoSpacings) {
  std::vector<Vec3d> positions{{0.011, 0, -0.14}};
  for (int i = 0; i < 101; ++i) positions.push_back({0.0115 + 0.0001 * i, 0, -0.08});
  const JetShape shape = measure_jet(jet_geometry(), positions);
  EXPECT_NEAR(shape.tan_theta, 0.001 / 0.15, 1e-12);
  EXPECT_NEAR(shape.inner_offset, 0.0015 + 2 * 0.0001, 1e-12);
  EXPECT_EQ(shape.flow_class, "wall-flow");
}

TEST(Jet, IgnoresAFewStraysAtTheInnerSurface) {
  std::vector<Vec3d> positions{{0.0101, 0, -0.08}, {0.06, 0, -0.14}};  // one in 200 touches the wall
  for (int i = 0; i < 199; ++i) positions.push_back({0.03, 0, -0.08});
  EXPECT_EQ(measure_jet(jet_geometry(), positions).flow_class, "free-jet");
}

TEST(Jet, TakesTheAngleWhereTheSheetHasAGap) {
  EXPECT_EQ(measure_jet(jet_geometry(), {{0.0115, 0, -0.14}}).flow_class, "wall-flow");  // 1.5 spacings
  EXPECT_EQ(measure_jet(jet_geometry(), {{0.0125, 0, -0.14}}).flow_class, "free-jet");   // 2.5 spacings
}

TEST(Jet, FollowsTheOutwardDirection) {
  JetGeometry jet = jet_geometry();
  jet.outward = {1, -1};  // -y
  const JetShape shape = measure_jet(jet, {{5, -0.03, -0.14}, {7, -0.03, -0.08}});
  EXPECT_NEAR(shape.tan_theta, 0.2, 1e-12);
  EXPECT_NEAR(shape.inner_offset, 0.03, 1e-12);
}

TEST(Jet, IsUnknownWithoutParticles) {
  const JetShape shape = measure_jet(jet_geometry(), {});
  EXPECT_TRUE(std::isnan(shape.tan_theta));
  EXPECT_TRUE(shape.flow_class.empty());
}

Case two_measures() {
  Case c;
  c.spacing = 0.001;
  MeasureSpec front;
  front.name = "half_way";
  front.fraction = 0.1;
  MeasureSpec jet;
  jet.name = "jet";
  jet.type = MeasureType::jet;
  jet.fraction = 0.5;
  jet.lip = {0.01, 0, 0.02};
  c.measures = {front, jet};
  return c;
}

Totals totals(std::int64_t first, std::int64_t second) {
  Totals t;
  t.particles = 10;
  t.fronts.resize(2);
  t.fronts[0].passed = first;
  t.fronts[0].extreme = -0.07;
  t.fronts[1].passed = second;
  t.fronts[1].extreme = -0.14;
  return t;
}

TEST(Measures, ReportColumnsAndSummaryByName) {
  Measures measures(two_measures(), {{2, -1, -0.06}, {2, -1, -0.13}}, 10);
  EXPECT_THAT(measures.columns(),
              testing::ElementsAre("half_way_front_m", "half_way_passed", "jet_front_m", "jet_passed"));
  FluidSnapshot snapshot;
  snapshot.position = {{0.04, 0, -0.14}, {0.03, 0, -0.08}};
  int reads = 0;
  const auto read = [&]() -> const FluidSnapshot& { return ++reads, snapshot; };
  measures.update(0, totals(0, 0), read);
  EXPECT_THAT(measures.update(1, totals(2, 4), read), testing::ElementsAre(-0.07, 0.2, -0.14, 0.4));
  EXPECT_EQ(reads, 0);
  measures.update(2, totals(8, 6), read);
  measures.update(3, totals(9, 9), read);
  EXPECT_EQ(reads, 1);  // at the arrival of the jet alone

  const Json summary = measures.summary();
  EXPECT_NEAR(summary.at("half_way").at("travelling_time").number(), 0.5, 1e-12);
  EXPECT_NEAR(summary.at("jet").at("travelling_time").number(), 1.5, 1e-12);
  EXPECT_NEAR(summary.at("jet").at("tan_theta").number(), 0.2, 1e-12);
  EXPECT_EQ(summary.at("jet").at("class").text(), "\"free-jet\"");
  EXPECT_TRUE(summary.at("half_way").at("class").is_null());
}

TEST(Measures, HaveNoTravellingTimeBeforeTheArrival) {
  Measures measures(two_measures(), {{2, -1, -0.06}, {2, -1, -0.13}}, 10);
  const FluidSnapshot none;
  measures.update(0, totals(0, 0), [&]() -> const FluidSnapshot& { return none; });
  EXPECT_TRUE(measures.summary().at("half_way").at("travelling_time").is_null());
  EXPECT_THAT(measures.lines()[0], testing::HasSubstr("not arrived"));
}

}  // namespace
}  // namespace slagflow
