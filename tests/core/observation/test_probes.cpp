// Fluxes through rectangles, surfaces, contact with walls and residence times: particles placed by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "core/openings/fed_channel.hpp"
#include "core/simulation_setups.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

SimulationSetup flight(const std::vector<Vec3d>& positions, const std::vector<Vec3d>& velocities) {
  SimulationSetup s = empty_setup({0, 0, 0}, {1, 1, 1});
  s.gravity = {};
  for (std::size_t i = 0; i < positions.size(); ++i)
    add_particle(s, positions[i], velocities[i], static_cast<std::uint8_t>(i % 2));
  return s;
}

void go_on(Simulation& simulation, double until) {
  while (simulation.time() < until) simulation.step();
}

using Counts = std::vector<std::int64_t>;

TEST(Flux, CountsEachWayByFluidWhatGoesThroughTheRectangle) {
  // Through the rectangle forwards: slag and oil; back: slag; past it: oil, at y = 0.8, slag, at z = 0.75.
  SimulationSetup s =
      flight({{0.4, 0.5, 0.5}, {0.42, 0.6, 0.4}, {0.6, 0.5, 0.62}, {0.4, 0.8, 0.5}, {0.4, 0.5, 0.75}},
             {{1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  const RectangleSetup whole{{0.5, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.2, 0.2};
  RectangleSetup reversed = whole;
  reversed.normal = {-1, 0, 0};
  s.rectangles = {whole, reversed};
  Simulation simulation(s);
  EXPECT_EQ(simulation.totals().fluxes[0].forward, (Counts{0, 0}));
  go_on(simulation, 0.09);  // the second has passed alone
  EXPECT_EQ(simulation.totals().fluxes[0].forward, (Counts{0, 1}));
  go_on(simulation, 0.25);
  const Totals t = simulation.totals();
  EXPECT_EQ(t.fluxes[0].forward, (Counts{1, 1}));
  EXPECT_EQ(t.fluxes[0].backward, (Counts{1, 0}));
  EXPECT_EQ(t.fluxes[1].forward, (Counts{1, 0}));
  EXPECT_EQ(t.fluxes[1].backward, (Counts{1, 1}));
}

TEST(Flux, RectanglesStandAtAnyAngle) {
  // A rectangle of 0.2 by 0.6 at 45 degrees between x and z, its long side up the slope: the second goes
  // beyond its end, the third beside it.
  const double r = std::sqrt(0.5);
  SimulationSetup s = flight({{0.5, 0.5, 0.2}, {0.8, 0.5, 0.2}, {0.5, 0.65, 0.2}, {0.68, 0.45, 0.2}},
                             {{0, 0, 2}, {0, 0, 2}, {0, 0, 2}, {0, 0, 2}});
  s.rectangles = {{{0.5, 0.5, 0.5}, {-r, 0, r}, {0, 1, 0}, {r, 0, r}, 0.1, 0.3}};
  Simulation simulation(s);
  go_on(simulation, 0.35);
  EXPECT_EQ(simulation.totals().fluxes[0].forward, (Counts{1, 1}));
  EXPECT_EQ(simulation.totals().fluxes[0].backward, (Counts{0, 0}));
}

TEST(Flux, APeriodicFaceIsNoWay) {
  // 2.5 rounds of a unit period through a rectangle in the middle and one in the face.
  SimulationSetup s = flight({{0.25, 0.5, 0.5}}, {{1, 0, 0}});
  s.domain.periodic = {true, false, false};
  s.numerics.sound_speed = 1;  // long steps
  for (const double x : {0.5, 0.0})
    s.rectangles.push_back({{x, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.1, 0.1});
  Simulation simulation(s);
  go_on(simulation, 2.5);
  const Totals t = simulation.totals();
  EXPECT_EQ(t.fluxes[0].forward, (Counts{3, 0}));
  EXPECT_EQ(t.fluxes[1].forward, (Counts{2, 0}));
  EXPECT_EQ(t.fluxes[0].backward, (Counts{0, 0}));
}

TEST(Flux, AgreesWithThePlaneInADam) {
  SimulationSetup s = dam();
  s.planes = {{0, 1, 0.05}};
  s.rectangles = {{{0.05, 0, 0.05}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1}};
  Simulation simulation(s);
  for (int k = 0; k < 100; ++k) simulation.step();
  const Totals t = simulation.totals();
  const FluxState& flux = t.fluxes[0];
  EXPECT_GT(t.planes[0].passed, 50);
  EXPECT_EQ(flux.forward[0] + flux.forward[1] - flux.backward[0] - flux.backward[1], t.planes[0].passed);
}

// Two columns into a tank 6 deep from its floor upwards, one that begins above its surface.
TEST(Surface, IsWhereALevelIsInEachColumn) {
  SimulationSetup s = tank(oil());
  const auto up = [](double x, double y, double z) { return LineSetup{{x, y, z}, {x, y, 0.12}, 49}; };
  s.surfaces = {{{up(0.035, 0.04, 0), up(0.05, 0.01, 0.02), up(0.04, 0.04, 0.08)}}};
  s.levels = {up(0.035, 0.04, 0)};
  Simulation simulation(s);
  const Totals t = simulation.totals();
  const std::vector<LevelState>& levels = t.surfaces[0];
  EXPECT_NEAR(levels[0].surface, 0.06, 0.0005);
  EXPECT_NEAR(levels[0].thickness, 0.06, 0.001);
  EXPECT_NEAR(levels[1].surface, 0.04, 0.0005);
  EXPECT_TRUE(std::isnan(levels[2].surface));
  EXPECT_EQ(levels[2].thickness, 0);
  EXPECT_NEAR(levels[0].surface, t.levels[0].surface, 1e-6);
}

// Of the floor of a tank, each particle of the uppermost row a cell.
void measure_floor(SimulationSetup& s) {
  const double cell = s.dimensions == 2 ? dx : dx * dx;
  s.contacts = {0};
  for (const double depth : s.walls.depth) s.site_area.push_back(depth < dx ? cell : 0);
}

TEST(Contact, AFullTankRestsOnItsFloor) {
  for (SimulationSetup s : {tank(slag()), flat_tank(slag())}) {
    measure_floor(s);
    Simulation simulation(s);
    const ContactState c = simulation.totals().contacts[0];
    EXPECT_NEAR(c.area, s.dimensions == 2 ? 0.08 : 0.0064, 1e-12);
    EXPECT_EQ(c.wetted, c.area);
    const double weight = 2600 * 9.81 * 0.06;
    // The lowest half spacing is of fluid compressed by p/(rho c^2), 3.7 %.
    EXPECT_NEAR(c.mean_pressure, weight, 4e-3 * weight);
    EXPECT_NEAR(c.largest_pressure, weight, 4e-3 * weight);
    EXPECT_NEAR(c.place.z, 0, 1e-6);
  }
}

TEST(Contact, FluidOnAQuarterOfTheFloorWetsAQuarter) {
  SimulationSetup s = tank(slag());
  s.domain.periodic = {false, true, false};
  measure_floor(s);
  FluidParticles all = std::move(s.particles);
  s.particles = {};
  for (std::size_t i = 0; i < all.position.size(); ++i)
    if (all.position[i].x < 0.02)
      add_particle(s, all.position[i], {}, 0), s.particles.pressure.back() = all.pressure[i];
  Simulation simulation(s);
  const ContactState c = simulation.totals().contacts[0];
  EXPECT_NEAR(c.wetted, 0.25 * c.area, 1e-12);
  EXPECT_LT(c.place.x, 0.02);
}

TEST(Contact, AboveTheFloorThereIsNone) {
  SimulationSetup s = tank(slag());
  measure_floor(s);
  for (Vec3d& x : s.particles.position) x.z += 0.01;
  Simulation simulation(s);
  const ContactState c = simulation.totals().contacts[0];
  EXPECT_EQ(c.wetted, 0);
  EXPECT_GT(c.area, 0);
  EXPECT_TRUE(std::isnan(c.largest_pressure));
  EXPECT_TRUE(std::isnan(c.mean_pressure));
}

// A plug at 0.3 m/s from a face at 0.02 to an outlet at 0.09.
TEST(Residence, APlugStaysForItsLengthOverItsSpeed) {
  SimulationSetup s = fed_channel();
  s.residences = {0};
  Simulation simulation(s);
  EXPECT_TRUE(std::isnan(simulation.totals().residences[0].mean));
  go_on(simulation, 0.6);
  const Totals t = simulation.totals();
  const ResidenceState& r = t.residences[0];
  EXPECT_EQ(r.left, t.removed[0]);
  EXPECT_GT(r.left, 49 * 8);
  const double whole = 0.07 / 0.3, row = dx / 0.3;
  EXPECT_NEAR(r.mean, whole, 0.5 * row);
  EXPECT_LT(r.deviation, 0.3 * row);
  EXPECT_NEAR(r.percentiles[2], whole, 0.5 * row);
  EXPECT_NEAR(r.mean_inside, 0.5 * whole, 0.5 * row);
}

// Fluid of the start is as old as the run.
TEST(Residence, TellsTheAgeOfWhatWasThereAtTheStart) {
  SimulationSetup s =
      flight({{0.25, 0.5, 0.5}, {0.3, 0.5, 0.2}, {0.1, 0.5, 0.5}}, {{1, 0, 0}, {1, 0, 0}, {}});
  s.outlets = {{"end", {0.5, -1, -1}, {2, 2, 2}}, {"other", {-1, -1, 0.9}, {2, 2, 2}}};
  s.residences = {0, 1};
  Simulation simulation(s);
  go_on(simulation, 0.3);
  const Totals t = simulation.totals();
  EXPECT_EQ(t.residences[0].left, 2);
  EXPECT_NEAR(t.residences[0].mean, 0.225, 0.02);
  EXPECT_NEAR(t.residences[0].mean_inside, simulation.time(), 1e-9);
  EXPECT_EQ(t.residences[1].left, 0);
}

TEST(Probes, StateSurvivesSaveAndRestore) {
  SimulationSetup s = fed_channel();
  s.rectangles = {{{0.06, 0.035, 0.035}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.01, 0.02}};
  s.residences = {0};
  Simulation unbroken(s), first(s);
  for (int k = 0; k < 150; ++k) unbroken.step(), first.step();
  Simulation second(s);
  second.restore(first.save());
  for (int k = 0; k < 150; ++k) unbroken.step(), second.step();
  const Totals a = unbroken.totals(), b = second.totals();
  EXPECT_GT(a.fluxes[0].forward[0], 0);
  EXPECT_EQ(a.fluxes[0].forward, b.fluxes[0].forward);
  EXPECT_EQ(a.residences[0].left, b.residences[0].left);
  EXPECT_GT(a.residences[0].left, 0);
  EXPECT_EQ(a.residences[0].mean, b.residences[0].mean);
  EXPECT_EQ(a.residences[0].mean_inside, b.residences[0].mean_inside);
}

}  // namespace
}  // namespace slagflow
