#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/case/case.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/measures/measure_front.hpp"
#include "host/measures/profiles.hpp"
#include "host/temp_folder.hpp"

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

TEST(Jet, LooksAtWhatHasFallenWhereTheSheetHasAGap) {
  // A lump on the wall, 3 spacings from it in the mean.
  const JetShape lump = measure_jet(jet_geometry(), {{0.0115, 0, -0.14}, {0.0145, 0, -0.14}});
  EXPECT_NEAR(lump.inner_offset, 0.0015 + 0.02 * 0.003, 1e-12);
  EXPECT_NEAR(lump.tan_theta, 0.003 / 0.15, 1e-12);
  EXPECT_EQ(lump.flow_class, "wall-flow");
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

SimulationSetup two_fronts() {
  SimulationSetup setup;
  setup.spacing = 0.001;
  setup.fronts = {{2, -1, -0.06}, {2, -1, -0.13}};
  setup.particles.position.resize(10);
  return setup;
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
  Measures measures(two_measures(), two_fronts());
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
  Measures measures(two_measures(), two_fronts());
  const FluidSnapshot none;
  measures.update(0, totals(0, 0), [&]() -> const FluidSnapshot& { return none; });
  EXPECT_TRUE(measures.summary().at("half_way").at("travelling_time").is_null());
  EXPECT_THAT(measures.lines()[0], testing::HasSubstr("not arrived"));
}

Case one_measure(MeasureType type, const std::string& name) {
  Case c;
  c.spacing = 0.01;
  MeasureSpec measure;
  measure.name = name;
  measure.type = type;
  measure.points = 5;
  c.measures = {measure};
  return c;
}

SimulationSetup one_of_each(int dimensions) {
  SimulationSetup setup;
  setup.spacing = 0.01;
  setup.dimensions = dimensions;
  setup.planes = {{0, 1, 0.05}};
  setup.boxes = {{{0, 0, 0}, {1, 1, 1}}};
  setup.lines = {{{0, 0, 0}, {0, 0, 1}, 5}};
  return setup;
}

const Measures::ReadSnapshot no_snapshot = []() -> const FluidSnapshot& {
  static const FluidSnapshot none;
  return none;
};

Totals flow_totals(std::int64_t passed, std::int64_t behind, std::int64_t lost) {
  Totals t;
  t.planes = {{passed, behind, lost, 100}};
  t.boxes = {passed};
  return t;
}

TEST(FlowMeasure, GivesPassedVolumeAndTheRateBetweenLines) {
  Measures measures(one_measure(MeasureType::flow_rate, "lip"), one_of_each(3));
  EXPECT_THAT(measures.columns(), testing::ElementsAre("lip_passed_m3", "lip_behind_m3", "lip_flow_m3_s"));
  const std::vector<double> first = measures.update(0, flow_totals(0, 100, 0), no_snapshot);
  EXPECT_DOUBLE_EQ(first[1], 100e-6);
  EXPECT_TRUE(std::isnan(first[2]));  // no earlier line
  measures.update(0.1, flow_totals(10, 90, 0), no_snapshot);
  const std::vector<double> third = measures.update(0.3, flow_totals(40, 55, 5), no_snapshot);
  EXPECT_DOUBLE_EQ(third[0], 40e-6);
  EXPECT_DOUBLE_EQ(third[1], 55e-6);
  EXPECT_NEAR(third[2], 30e-6 / 0.2, 1e-12);
  const Json summary = measures.summary().at("lip");
  EXPECT_EQ(summary.at("type").text(), "\"flow_rate\"");
  EXPECT_EQ(summary.at("direction").text(), "\"+x\"");
  EXPECT_DOUBLE_EQ(summary.at("lost_behind_volume").number(), 5e-6);
  EXPECT_EQ(summary.at("balance_error").number(), 0);
  measures.update(0.4, flow_totals(40, 54, 5), no_snapshot);  // one was lost from the count
  EXPECT_DOUBLE_EQ(measures.summary().at("lip").at("balance_error").number(), -1e-6);
}

TEST(FlowMeasure, HasNothingBehindOnAPeriodicAxis) {
  SimulationSetup setup = one_of_each(3);
  setup.domain.periodic[0] = true;
  Measures measures(one_measure(MeasureType::flow_rate, "lip"), setup);
  EXPECT_TRUE(std::isnan(measures.update(0, flow_totals(0, 100, 0), no_snapshot)[1]));
  EXPECT_TRUE(measures.summary().at("lip").at("behind_volume").is_null());
}

TEST(VolumeMeasure, GivesTheVolumeInTheBox) {
  Measures solid(one_measure(MeasureType::volume, "pool"), one_of_each(3));
  EXPECT_THAT(solid.columns(), testing::ElementsAre("pool_m3"));
  EXPECT_DOUBLE_EQ(solid.update(0, flow_totals(30, 0, 0), no_snapshot)[0], 30e-6);
  solid.update(1, flow_totals(20, 0, 0), no_snapshot);
  EXPECT_DOUBLE_EQ(solid.summary().at("pool").at("volume").number(), 20e-6);
  EXPECT_DOUBLE_EQ(solid.summary().at("pool").at("largest_volume").number(), 30e-6);
  Measures plane(one_measure(MeasureType::volume, "pool"), one_of_each(2));
  EXPECT_THAT(plane.columns(), testing::ElementsAre("pool_m2"));
  EXPECT_DOUBLE_EQ(plane.update(0, flow_totals(30, 0, 0), no_snapshot)[0], 30e-4);
}

TEST(Measures, OfAFrontCountWhatInletsBringByTheEndWhereverARunPauses) {
  Case c = load_case(std::string(SLAGFLOW_SOURCE_DIR) + "/cases/howto/overflow.toml");
  c.measures.push_back({});
  c.measures.back().name = "arrival", c.measures.back().type = MeasureType::front;
  c.measures.back().direction = {0, 1}, c.measures.back().position = -10;
  const SimulationSetup setup = build_setup(c).setup;
  Simulation simulation(setup);
  Measures whole(c, setup);
  c.output.until = 0.1 * c.output.end_time;
  Measures part(c, setup);
  const std::vector<std::string> names = whole.columns();
  const auto passed =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), "arrival_passed") - names.begin());
  const double share = whole.update(0, simulation.totals(), no_snapshot).at(passed);
  EXPECT_GT(share, 0);
  EXPECT_EQ(part.update(0, simulation.totals(), no_snapshot).at(passed), share);
  EXPECT_GT(fed_particles(setup, c.output.end_time), 2 * fed_particles(setup, c.output.until));
}

TEST(Measures, GoOnFromTheirState) {
  Case c = two_measures();
  for (const MeasureType type : {MeasureType::flow_rate, MeasureType::volume, MeasureType::profile}) {
    c.measures.push_back({});
    c.measures.back().name = "m" + std::to_string(c.measures.size());
    c.measures.back().type = type;
  }
  SimulationSetup setup = one_of_each(3);
  setup.fronts = two_fronts().fronts;
  setup.particles.position.resize(10);
  Measures one(c, setup), other(c, setup);
  const auto both = [](std::int64_t n) {
    Totals t = flow_totals(n, 100 - n, 0);
    t.fronts = totals(n, n / 2).fronts;
    t.particles = 10;
    return t;
  };
  one.update(0, both(0), no_snapshot);
  one.update(0.1, both(3), no_snapshot);
  other.restore(one.state());
  EXPECT_EQ(one.update(0.2, both(7), no_snapshot), other.update(0.2, both(7), no_snapshot));
  EXPECT_EQ(one.summary().text(), other.summary().text());
  EXPECT_EQ(one.lines(), other.lines());
}

}  // namespace
}  // namespace slagflow
