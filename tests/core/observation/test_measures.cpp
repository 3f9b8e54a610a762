// What is measured of the fluid: particles placed by hand.
#include <gtest/gtest.h>

#include "core/simulation_setups.hpp"
#include "observation/measures.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

// Particles that fly freely along x at given speeds; nothing else acts on them.
SimulationSetup flight(const std::vector<Vec3d>& positions, const std::vector<Vec3d>& velocities) {
  SimulationSetup s = empty_setup({0, 0, 0}, {1, 1, 1});
  s.gravity = {};
  for (std::size_t i = 0; i < positions.size(); ++i) add_particle(s, positions[i], velocities[i], 0);
  return s;
}

void fly(Simulation& simulation, double time) {
  while (simulation.time() < time) simulation.step();
}

void expect_balance(const PlaneState& p) { EXPECT_EQ(p.passed + p.behind + p.lost_behind, p.start_behind); }

TEST(PlaneCounters, CountsWhatPassesAndWhatComesBack) {
  // Three pass x = 0.5 towards +x, one passes back, one stays.
  SimulationSetup s =
      flight({{0.45, 0.1, 0.5}, {0.4, 0.3, 0.5}, {0.3, 0.5, 0.5}, {0.6, 0.7, 0.5}, {0.2, 0.9, 0.5}},
             {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 0}});
  s.planes = {{0, 1, 0.5}, {0, -1, 0.5}};
  Simulation simulation(s);
  Totals t = simulation.totals();
  EXPECT_EQ(t.planes[0].passed, 0);
  EXPECT_EQ(t.planes[0].behind, 4);
  EXPECT_EQ(t.planes[1].behind, 1);
  fly(simulation, 0.075);  // only the first has passed
  EXPECT_EQ(simulation.totals().planes[0].passed, 1);
  fly(simulation, 0.25);
  t = simulation.totals();
  EXPECT_EQ(t.planes[0].passed, 3 - 1);
  EXPECT_EQ(t.planes[0].behind, 2);
  EXPECT_EQ(t.planes[1].passed, 1 - 3);
  for (const PlaneState& p : t.planes) expect_balance(p);
}

TEST(PlaneCounters, ParticlesThatLeaveTheDomainHaveOrHaveNotPassed) {
  // The first leaves beyond the plane through +x, the second beside it through +y, before the plane; the
  // third beyond it through -z.
  SimulationSetup s = flight({{0.45, 0.5, 0.5}, {0.4, 0.9, 0.5}, {0.48, 0.2, 0.1}, {0.1, 0.2, 0.9}},
                             {{2, 0, 0}, {0, 1, 0}, {1, 0, -0.5}, {0, 0, 0}});
  s.planes = {{0, 1, 0.5}};
  Simulation simulation(s);
  for (int k = 0; k < 8; ++k) {
    fly(simulation, 0.05 * k);
    expect_balance(simulation.totals().planes[0]);
  }
  const Totals t = simulation.totals();
  EXPECT_EQ(t.particles, 1);
  EXPECT_EQ(t.planes[0].passed, 2);
  EXPECT_EQ(t.planes[0].behind, 1);
  EXPECT_EQ(t.planes[0].lost_behind, 1);
}

TEST(PlaneCounters, PlaneOfAPeriodicAxisRepeats) {
  // 2.5 rounds of a unit period, the plane in the middle or at the edge of the domain.
  SimulationSetup s = flight({{0.25, 0.5, 0.5}}, {{1, 0, 0}});
  s.domain.periodic = {true, false, false};
  s.numerics.sound_speed = 1;  // long steps
  s.planes = {{0, 1, 0.5}, {0, 1, 0.0}, {0, -1, 0.5}};
  Simulation simulation(s);
  fly(simulation, 2.5);
  const Totals t = simulation.totals();
  EXPECT_EQ(t.planes[0].passed, 3);  // at 0.25, 1.25 and 2.25 s
  EXPECT_EQ(t.planes[1].passed, 2);  // at 0.75 and 1.75 s
  EXPECT_EQ(t.planes[2].passed, -3);
}

TEST(PlaneCounters, BalanceHoldsInADamThatLosesParticles) {
  SimulationSetup s = dam();
  s.planes = {{0, 1, 0.05}, {2, -1, -0.01}, {1, 1, 0.01}};
  Simulation simulation(s);
  for (int k = 0; k < 150; ++k) {
    simulation.step();
    const Totals t = simulation.totals();
    expect_balance(t.planes[0]);
    expect_balance(t.planes[1]);
  }
  const Totals t = simulation.totals();
  EXPECT_LT(t.particles, 294);  // some have left
  EXPECT_GT(t.planes[0].passed, 50);
}

TEST(Box, CountsTheParticlesInside) {
  SimulationSetup s = flight({{0.25, 0.5, 0.5}, {0.35, 0.5, 0.5}, {0.45, 0.5, 0.5}, {0.35, 0.9, 0.5}},
                             {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  s.boxes = {{{0.3, 0, 0}, {0.4, 0.6, 1}}, {{0, 0, 0}, {1, 1, 1}}, {{0.6, 0, 0}, {1, 1, 1}}};
  Simulation simulation(s);
  EXPECT_EQ(simulation.totals().boxes, (std::vector<std::int64_t>{1, 4, 0}));
}

// A block of oil on a lattice with a velocity that is linear in space.
SimulationSetup sheared_block(int dimensions) {
  SimulationSetup s = empty_setup({0, 0, 0}, {0.2, 0.2, 0.2});
  s.gravity = {};
  s.dimensions = dimensions;
  s.domain.lower.y = dimensions == 2 ? -0.5 * dx : 0;
  s.domain.upper.y = dimensions == 2 ? 0.5 * dx : 0.2;
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < (dimensions == 2 ? 1 : 12); ++j)
      for (int i = 0; i < 12; ++i) {
        const double y = dimensions == 2 ? 0 : 0.04 + j * dx;
        const Vec3d x{0.04 + i * dx, y, 0.04 + k * dx};
        add_particle(s, x, {0.3 + 2 * x.z - x.x, -0.5 * x.y, 0.1 + x.x + x.z}, 1);
      }
  return s;
}

TEST(Profile, LinearVelocityComesOutExactly) {
  for (const int dimensions : {2, 3}) {
    SimulationSetup s = sheared_block(dimensions);
    const double y = dimensions == 2 ? 0 : 0.083;
    s.lines = {{{0.045, y, 0.041}, {0.148, y, 0.149}, 14}};  // to the edges of the block
    const Simulation simulation(s);
    for (const ProfilePoint& p : simulation.profile(0)) {
      const Vec3d x = p.position;
      // Single precision of the positions and the ridge of 1e-6.
      EXPECT_NEAR(p.velocity.x, 0.3 + 2 * x.z - x.x, 2e-5);
      EXPECT_NEAR(p.velocity.y, dimensions == 2 ? 0 : -0.5 * x.y, 2e-5);
      EXPECT_NEAR(p.velocity.z, 0.1 + x.x + x.z, 2e-5);
      EXPECT_NEAR(p.viscosity, 0.3, 1e-6);
    }
  }
}

TEST(Profile, PointsAreEvenlySpacedAndFillTellsTheFluid) {
  SimulationSetup s = sheared_block(3);
  s.lines = {{{0.1, 0.1, 0.1}, {0.1, 0.1, 0.19}, 10}};
  const Simulation simulation(s);
  const std::vector<ProfilePoint> profile = simulation.profile(0);
  ASSERT_EQ(profile.size(), 10u);
  EXPECT_NEAR(profile[3].distance, 0.03, 1e-12);
  EXPECT_NEAR(profile[3].position.z, 0.13, 1e-12);
  EXPECT_NEAR(profile[0].fill, 1, 0.02);
  EXPECT_FALSE(std::isnan(profile[5].velocity.x));  // z = 0.15, the last layer
  EXPECT_TRUE(std::isnan(profile[7].velocity.x));   // two spacings above it
  EXPECT_TRUE(std::isnan(profile[7].viscosity));
  EXPECT_EQ(profile[9].fill, 0);
}

TEST(Profile, FollowsParticlesThatMovedSinceTheyWereSorted) {
  SimulationSetup s = sheared_block(3);
  for (Vec3d& v : s.particles.velocity) v = {0.4, 0, 0};
  s.lines = {{{0.09, 0.095, 0.095}, {0.14, 0.095, 0.095}, 3}};
  Simulation simulation(s);
  for (int k = 0; k < 12; ++k) {
    simulation.step();
    for (const ProfilePoint& p : simulation.profile(0)) {
      EXPECT_NEAR(p.velocity.x, 0.4, 1e-4);
      EXPECT_NEAR(p.fill, 1, 0.03);
    }
  }
}

TEST(Profile, SeesAcrossAPeriodicFace) {
  SimulationSetup s = empty_setup({0, 0, 0}, {0.12, 0.12, 0.12});
  s.gravity = {};
  s.domain.periodic = {true, true, true};
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i)
        add_particle(s, {(i + 0.5) * dx, (j + 0.5) * dx, (k + 0.5) * dx}, {0.2, 0, 0}, 1);
  s.lines = {{{0, 0, 0}, {0.12, 0.12, 0.12}, 5}};
  const Simulation simulation(s);
  for (const ProfilePoint& p : simulation.profile(0)) EXPECT_NEAR(p.fill, 1, 0.02);
}

TEST(Measured, StateSurvivesSaveAndRestore) {
  SimulationSetup s = dam();
  s.planes = {{0, 1, 0.05}, {2, -1, -0.01}};
  Simulation unbroken(s), first(s);
  for (int k = 0; k < 40; ++k) unbroken.step(), first.step();
  Simulation second(s);
  second.restore(first.save());
  for (int k = 0; k < 60; ++k) unbroken.step(), second.step();
  const Totals a = unbroken.totals(), b = second.totals();
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(a.planes[k].passed, b.planes[k].passed);
    EXPECT_EQ(a.planes[k].behind, b.planes[k].behind);
    EXPECT_EQ(a.planes[k].lost_behind, b.planes[k].lost_behind);
    EXPECT_EQ(a.planes[k].start_behind, b.planes[k].start_behind);
  }
}

}  // namespace
}  // namespace slagflow
