// Fluid that comes in through inlets and goes out through outlets: counts, places, speeds, restored states.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "backend/error.hpp"
#include "core/openings/fed_channel.hpp"
#include "core/simulation_setups.hpp"
#include "fluid/constants.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

TEST(FeedRate, TravelsTheIntegralOfItsRows) {
  FeedRate rate;
  rate.time = {1, 2, 4}, rate.speed = {1, 3, 0};
  rate.start = 0.5, rate.stop = 3;
  const auto integral = [&](double end) {
    double sum = 0;
    const int pieces = 100000;
    for (int k = 0; k < pieces; ++k) sum += rate.at((k + 0.5) * end / pieces) * end / pieces;
    return sum;
  };
  for (const double t : {0.2, 0.7, 1.0, 1.5, 2.0, 2.7, 3.0, 5.0})
    EXPECT_NEAR(rate.travelled(t), integral(t), 1e-4);
  EXPECT_DOUBLE_EQ(rate.at(1.5), 2);
  EXPECT_DOUBLE_EQ(rate.at(0.4), 0);
  EXPECT_DOUBLE_EQ(rate.at(3), 0);
  EXPECT_DOUBLE_EQ(rate.fastest(), 3);
}

TEST(Inlets, WhatComesInIsInOrHasGone) {
  SimulationSetup s = fed_channel();
  s.planes = {{0, 1, 0.05}, {0, 1, 0.1}, {0, 1, 0.01}};
  Simulation simulation(s);
  EXPECT_EQ(simulation.particles(), 0);
  while (simulation.time() < 0.35) {
    simulation.step();
    const Totals t = simulation.totals();
    ASSERT_EQ(t.fed[0], t.particles + t.removed[0]);
    EXPECT_NEAR(t.mass_fed, t.mass_in + t.mass_left, 1e-12);
    for (const PlaneState& plane : t.planes)
      ASSERT_EQ(plane.passed + plane.behind + plane.lost_behind, plane.start_behind);
  }
  const Totals t = simulation.totals();
  EXPECT_GT(t.removed[0], 49);
  EXPECT_NEAR(static_cast<double>(t.fed[0]), 49 * 0.35 * 0.3 / dx, 49);  // but for a row
  EXPECT_EQ(t.departed, (std::array<std::int64_t, 6>{}));
  EXPECT_NEAR(static_cast<double>(t.planes[0].passed), 49 * (0.35 * 0.3 - 0.03) / dx,
              98);                   // a row, and one on its way to the plane
  EXPECT_EQ(t.planes[1].passed, 0);  // beyond the outlet
}

// A plug between periodic sides has nothing to hold it back.
TEST(Inlets, PlugGoesOnAsItCameIn) {
  SimulationSetup s = fed_channel();
  s.outlets = {};
  Simulation simulation(s);
  double least = 1;
  while (simulation.time() < 0.25) {
    simulation.step();
    least = std::min(least, simulation.totals().min_density_ratio);
  }
  FluidSnapshot snapshot;
  simulation.read(snapshot);
  ASSERT_GT(snapshot.id.size(), 49U * 5);
  for (std::size_t k = 0; k < snapshot.id.size(); ++k) {
    EXPECT_EQ(snapshot.id[k], static_cast<std::int64_t>(k));
    EXPECT_NEAR(snapshot.velocity[k].x, 0.3, 1e-3);
    EXPECT_NEAR(snapshot.velocity[k].z, 0, 1e-3);
    // Rows stay a spacing apart.
    if (k >= 49) {
      EXPECT_NEAR(snapshot.position[k - 49].x - snapshot.position[k].x, dx, 1e-2 * dx);
    }
  }
  EXPECT_GT(least, 0.999);
  EXPECT_LT(simulation.largest_compression().value, 1e-3);
}

// Columns that come at speeds of their own, over times of a table, into fluid that is there already.
SimulationSetup uneven_channel() {
  SimulationSetup s = fed_channel();
  InletSetup& in = s.inlets[0];
  for (std::size_t k = 0; k < in.share.size(); ++k) in.share[k] = 0.5 + static_cast<double>(k) / 48;
  in.rate.time = {0, 0.02, 0.1}, in.rate.speed = {0.1, 0.3, 0.2};
  in.rate.start = 0.005;
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 3; ++i)
        add_particle(s, {0.02 + (i + 0.5) * dx, (j + 0.5) * dx, (k + 0.5) * dx}, {}, 1);
  return s;
}

FluidSnapshot state_of(Simulation& simulation) {
  FluidSnapshot snapshot;
  simulation.read(snapshot);
  return snapshot;
}

TEST(Inlets, RestoredStatesGoOnToTheSameBits) {
  for (const YieldModel yield : {YieldModel::regularised, YieldModel::exact}) {
    SimulationSetup s = uneven_channel();
    s.numerics.yield = yield;
    Simulation whole(s);
    const bool exact = yield == YieldModel::exact;  // which takes its time
    const int before = exact ? 20 : 30, after = exact ? 5 : 40;
    for (int step = 0; step < before; ++step) whole.step();
    const SavedState saved = whole.save();
    const std::vector<std::int64_t> fed = whole.totals().fed;
    for (int step = 0; step < after; ++step) whole.step();
    Simulation restored(s);
    restored.restore(saved);
    EXPECT_EQ(restored.totals().fed, fed);
    for (int step = 0; step < after; ++step) restored.step();
    const FluidSnapshot a = state_of(whole), b = state_of(restored);
    ASSERT_EQ(a.id, b.id);
    EXPECT_GT(a.id.back(), 147);  // some have come in
    EXPECT_EQ(whole.totals().fed, restored.totals().fed);
    for (std::size_t k = 0; k < a.id.size(); ++k) {
      ASSERT_TRUE(a.position[k] == b.position[k] && a.velocity[k] == b.velocity[k]);
      ASSERT_EQ(a.pressure[k], b.pressure[k]);
    }
  }
}

TEST(Inlets, IdsRiseByTimeThenColumn) {
  SimulationSetup s = uneven_channel();
  Simulation simulation(s);
  std::set<std::int64_t> seen;
  std::int64_t highest = 146;
  for (int step = 0; step < 80; ++step) {
    simulation.step();
    for (const std::int64_t id : state_of(simulation).id) {
      if (!seen.insert(id).second || id < 147) continue;
      EXPECT_GT(id, highest);
      highest = std::max(highest, id);
    }
  }
  EXPECT_EQ(highest, 146 + simulation.totals().fed[0]);
}

// Where the wall particles of a column are said to be, they are: behind the face by less than its reach.
TEST(Inlets, WallsShowTheColumnsBehindTheFluid) {
  SimulationSetup s = uneven_channel();
  Simulation simulation(s);
  for (int step = 0; step < 60; ++step) {
    simulation.step();
    FluidSnapshot fluid;
    WallSnapshot walls;
    simulation.read(fluid, walls);
    const auto rows = static_cast<std::size_t>(inlet_rows(s));
    const int moving = inlet_moving_rows(s);
    ASSERT_EQ(walls.position.size(), 49 * rows);
    for (std::size_t k = 0; k < walls.position.size(); ++k) {
      const int row = static_cast<int>(k % rows);
      const double behind = (0.02 - walls.position[k].x) / dx, home = inlet_row_place(row, moving);
      if (row >= moving) {
        EXPECT_NEAR(behind, home, 1e-9);
      } else {
        EXPECT_LE(behind, home + 0.5 + 1e-9);
        EXPECT_GT(behind, home - 1.5);
      }
    }
  }
}

TEST(Inlets, SetupsWithoutColumnsAreRefused) {
  SimulationSetup s = fed_channel();
  s.inlets[0].share.pop_back();
  EXPECT_THROW(Simulation{s}, InputError);
}

// What comes in brings energy, which the watch would stop the run for if it did not count it.
TEST(Inlets, WatchTakesWhatComesInForASource) {
  SimulationSetup s = fed_channel();
  s.gravity = {0, 0, -9.81};
  s.domain.periodic = {false, true, false};
  s.outlets = {};
  s.limits.interval = 1;
  s.domain.lower.z = -0.2;
  Simulation simulation(s);
  while (simulation.time() < 0.2) simulation.step();
  EXPECT_GT(simulation.totals().fed[0], 49 * 4);
}

}  // namespace
}  // namespace slagflow
