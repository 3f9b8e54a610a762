// Heat in a whole simulation: nothing is lost, a state is kept to the bit, solid fluid is solid.
#include <gtest/gtest.h>

#include <cmath>

#include "core/simulation_setups.hpp"
#include "fluid/constants.hpp"
#include "heat/heat.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

// The dam, of two fluids of which the lower freezes, hot and cold in turn.
SimulationSetup hot_dam() {
  SimulationSetup s = dam();
  MaterialSetup m;
  m.heat_capacity = {{300, 1000}, {2000, 1400}}, m.conductivity = {{300, 1.5}, {1700, 0.8}};
  m.solid_fraction = {{1400, 1}, {1600, 0}}, m.latent_heat = 2e5, m.emissivity = 0.8;
  m.liquid.law = LiquidLaw::arrhenius, m.liquid.a = 5e-6, m.liquid.b = 19000;
  m.max_viscosity = 1e5;
  s.fluids[0].material = m;
  m.solid_fraction.clear(), m.latent_heat = 0, m.liquid = {};
  s.fluids[1].material = m;
  s.thermal = {true, 300, 20, true, false, 1700};
  s.bodies[0].thermal = {WallHeat::semi_infinite, 400, 0, 1000, 40, 7850, 550};
  for (std::size_t i = 0; i < s.particles.position.size(); ++i)
    s.particles.temperature.push_back(i % 3 == 0 ? 1350 : 1700);
  return s;
}

void run(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step();
}

void expect_same(const FluidSnapshot& a, const FluidSnapshot& b) {
  ASSERT_EQ(a.id, b.id);
  EXPECT_EQ(a.temperature, b.temperature);
  EXPECT_EQ(a.solid_fraction, b.solid_fraction);
  EXPECT_EQ(a.viscosity, b.viscosity);
  for (std::size_t i = 0; i < a.id.size(); ++i) EXPECT_TRUE(a.position[i] == b.position[i]);
}

TEST(Heat, IsKeptWhileFluidMovesAndLeaves) {
  Simulation simulation(hot_dam());
  run(simulation, 150);
  const Totals t = simulation.totals();
  ASSERT_TRUE(t.heat_is_on);
  EXPECT_GT(t.mass_left, 0);
  EXPECT_GT(t.heat.left, 0);
  EXPECT_GT(t.heat.surface, 0);
  EXPECT_GT(t.heat.walls.at(0), 0);
  EXPECT_LT(t.heat.hottest, 1700.5);
  EXPECT_NEAR(t.heat.error(), 0, 1e-6 * (t.heat.surface + t.heat.walls.at(0)));
}

// Also with exact yield stresses, of which the cold fluid has more.
SimulationSetup exact_hot_dam() {
  SimulationSetup s = hot_dam();
  s.numerics.yield = YieldModel::exact;
  s.fluids[0].material.yield_stress = {{0, 2}, {0.5, 50}};
  return s;
}

TEST(Heat, OfARestoredStateGoesOnToTheBit) {
  for (const int what : {0, 1, 2}) {
    SimulationSetup setup = what == 2 ? exact_hot_dam() : hot_dam();
    setup.thermal.viscous_heating = what > 0;
    Simulation whole(setup), first(setup), second(setup);
    run(whole, 60), run(first, 30);
    second.restore(first.save());
    run(second, 30);
    FluidSnapshot a, b;
    WallSnapshot walls_a, walls_b;
    whole.read(a, walls_a), second.read(b, walls_b);
    expect_same(a, b);
    EXPECT_EQ(whole.totals().heat.surface, second.totals().heat.surface);
    EXPECT_EQ(whole.totals().heat.walls, second.totals().heat.walls);
    EXPECT_EQ(whole.totals().heat.viscous, second.totals().heat.viscous);
    ASSERT_EQ(walls_a.temperature.size(), walls_b.temperature.size());
    for (std::size_t k = 0; k < walls_a.temperature.size(); ++k)
      EXPECT_TRUE(walls_a.temperature[k] == walls_b.temperature[k] ||
                  (std::isnan(walls_a.temperature[k]) && std::isnan(walls_b.temperature[k])));
  }
}

// From flow_until on, in few steps, while places stay and nothing is lost.
SimulationSetup dam_that_stops(double end) {
  SimulationSetup s = hot_dam();
  s.thermal.flow_until = 0.02, s.end_time = end;
  return s;
}

TEST(Heat, GoesOnAloneOnceTheFlowIsOver) {
  Simulation simulation(dam_that_stops(1000));
  while (simulation.time() < 0.02) simulation.step();
  ASSERT_EQ(simulation.time(), 0.02);
  FluidSnapshot before, after;
  simulation.read(before);
  const auto flow_steps = simulation.steps();
  while (simulation.time() < 1000) simulation.step();
  EXPECT_EQ(simulation.time(), 1000);
  EXPECT_LT(simulation.steps() - flow_steps, 300);
  simulation.read(after);
  EXPECT_EQ(after.time, 1000);
  ASSERT_EQ(before.id, after.id);
  for (std::size_t i = 0; i < before.id.size(); ++i)
    EXPECT_TRUE(before.position[i] == after.position[i]) << i;
  const Totals t = simulation.totals();
  EXPECT_EQ(t.kinetic_energy, 0);
  EXPECT_LT(t.heat.hottest, 1500);
  EXPECT_NEAR(t.heat.error(), 0, 1e-6 * (t.heat.surface + t.heat.walls.at(0)));
}

// To second order: temperatures are those after steps of a hundredth of the longest.
TEST(Heat, AloneIsAsRightInItsOwnStepsAsInShortOnes) {
  const double length = conduction_time_step(dam_that_stops(1));
  for (const double steps : {0.3, 1.5, 4.0}) {
    const double end = steps * length;
    SimulationSetup setup = dam_that_stops(end);
    setup.thermal.flow_until = 0;
    FluidSnapshot own, fine;
    Simulation longest(setup);
    while (longest.time() < end) longest.step();
    longest.read(own);
    setup.numerics.max_time_step = length / 100;
    Simulation shorter(setup);
    while (shorter.time() < end) shorter.step();
    shorter.read(fine);
    ASSERT_EQ(own.id, fine.id);
    for (std::size_t i = 0; i < own.id.size(); ++i) {
      EXPECT_NEAR(own.temperature[i], fine.temperature[i], 1) << end << " s, " << i;
    }
    EXPECT_NEAR(longest.totals().heat.surface, shorter.totals().heat.surface,
                0.0005 * shorter.totals().heat.surface);
  }
}

TEST(Heat, AloneOfARestoredStateGoesOnToTheBit) {
  const SimulationSetup setup = dam_that_stops(100);
  Simulation whole(setup), first(setup), second(setup);
  while (first.time() < 30) first.step(), whole.step();
  second.restore(first.save());
  EXPECT_EQ(second.time(), first.time());
  EXPECT_EQ(second.time_step(), first.time_step());
  while (whole.time() < 100) whole.step(), second.step();
  FluidSnapshot a, b;
  whole.read(a), second.read(b);
  expect_same(a, b);
  EXPECT_EQ(whole.totals().heat.surface, second.totals().heat.surface);
}

TEST(Heat, TellsWhatIsSolid) {
  SimulationSetup setup = hot_dam();
  setup.solids = {{{{-1, -1, -1}, {1, 1, 1}}, 1.0}};
  Simulation simulation(setup);
  FluidSnapshot s;
  simulation.read(s);
  std::int64_t solid = 0;
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const bool cold = s.fluid[i] == 0 && i % 3 == 0;
    solid += cold;
    EXPECT_EQ(s.solid_fraction[i], cold ? 1.0F : 0.0F);
    EXPECT_NEAR(s.temperature[i], i % 3 == 0 ? 1350 : 1700, 1e-2);
    if (cold) {
      EXPECT_NEAR(s.viscosity[i], 1e5, 1);
      EXPECT_EQ(s.yielded[i], 0);
    }
  }
  EXPECT_EQ(simulation.totals().solids.at(0), solid);
}

// One temperature, far from freezing, no surface or wall that takes any: the flow is that without heat but
// for the rounding of the pairs' viscosity.
TEST(Heat, OfOneTemperatureChangesNothing) {
  SimulationSetup warm = hot_dam(), plain = dam();
  warm.thermal = {true, 300, 0, false, false, 1700};
  warm.bodies[0].thermal = {};
  for (double& t : warm.particles.temperature) t = 1700;
  for (FluidSetup& f : warm.fluids) f.material.liquid = {}, f.material.max_viscosity = 1e8;
  warm.fluids[0].material.suspended = false;
  Simulation a(warm), b(plain);
  run(a, 50), run(b, 50);
  FluidSnapshot sa, sb;
  a.read(sa), b.read(sb);
  ASSERT_EQ(sa.id, sb.id);
  for (std::size_t i = 0; i < sa.id.size(); ++i)
    EXPECT_LT(norm(sa.position[i] - sb.position[i]), 1e-4 * dx) << i;
  EXPECT_NEAR(a.totals().heat.content, a.totals().heat.start - a.totals().heat.left,
              1e-9 * a.totals().heat.start);
}

// To the bit where the rheology is Newtonian and exp(ln eta) is eta.
TEST(Heat, OfOneTemperatureKeepsTheBitsOfARunWithout) {
  SimulationSetup plain = dam(), warm = hot_dam();
  for (SimulationSetup* s : {&plain, &warm})
    for (FluidSetup& f : s->fluids) f.rheology = {RheologyKind::newtonian, {Real(1)}};
  warm.thermal = {true, 300, 0, false, false, 1700};
  warm.bodies[0].thermal = {};
  for (double& t : warm.particles.temperature) t = 1700;
  for (FluidSetup& f : warm.fluids) f.material.liquid = {}, f.material.suspended = false;
  Simulation a(warm), b(plain);
  run(a, 100), run(b, 100);
  FluidSnapshot sa, sb;
  a.read(sa), b.read(sb);
  ASSERT_EQ(sa.id, sb.id);
  EXPECT_EQ(sa.pressure, sb.pressure);
  for (std::size_t i = 0; i < sa.id.size(); ++i) EXPECT_TRUE(sa.position[i] == sb.position[i]) << i;
}

// What viscosity takes from the motion warms the fluid: a block that is sheared in a box by itself.
class HeatOfFriction : public testing::TestWithParam<YieldModel> {};

TEST_P(HeatOfFriction, IsTheEnergyThatIsLost) {
  SimulationSetup s = spinning_block(0);
  s.fluids = {{"oil", 900, {RheologyKind::newtonian, {Real(5)}}}};
  if (GetParam() == YieldModel::exact) s.fluids[0].rheology = {RheologyKind::bingham, {Real(2), Real(10)}};
  s.numerics.yield = GetParam();
  s.fluids[0].material.heat_capacity = {{300, 10}}, s.fluids[0].material.conductivity = {{300, 1}};
  s.thermal = {true, 300, 0, false, true, 400};
  for (std::size_t i = 0; i < s.particles.position.size(); ++i) {
    s.particles.velocity[i] = {3 * s.particles.position[i].z, 0, 0};
    s.particles.temperature.push_back(400);
  }
  Simulation simulation(s);
  const double before = simulation.totals().kinetic_energy;
  run(simulation, 40);
  const Totals t = simulation.totals();
  EXPECT_GT(t.heat.viscous, 0.1 * before);
  EXPECT_NEAR(t.heat.viscous, t.dissipated_energy, 0.02 * t.dissipated_energy);
  EXPECT_NEAR(t.heat.error(), 0, 1e-6 * t.heat.viscous);
  EXPECT_GT(t.heat.hottest, 400);
}

INSTANTIATE_TEST_SUITE_P(Yields, HeatOfFriction, testing::Values(YieldModel::regularised, YieldModel::exact),
                         [](const auto& test) {
                           return test.param == YieldModel::exact ? "Exact" : "Regularised";
                         });

// Solid fluid moves as a body: a bar that is thrown turning keeps its shape.
TEST(Heat, SolidFluidKeepsItsShape) {
  SimulationSetup s = spinning_block(20);
  MaterialSetup m;
  m.heat_capacity = {{300, 1000}}, m.conductivity = {{300, 1}}, m.solid_fraction = {{1400, 1}, {1600, 0}};
  for (FluidSetup& f : s.fluids) f.material = m;
  s.thermal = {true, 300, 0, false, false, 1200};
  s.particles.temperature.assign(s.particles.position.size(), 1200);
  const std::vector<Vec3d> start = s.particles.position;
  Simulation simulation(s);
  run(simulation, 100);
  FluidSnapshot now;
  simulation.read(now);
  for (std::size_t k : {9UL, 90UL, 900UL, 999UL})
    EXPECT_NEAR(norm(now.position[k] - now.position[0]), norm(start[k] - start[0]), 2e-3 * dx) << k;
}

// Also where there is no fluid yet.
class HeatOfInlets : public testing::TestWithParam<bool> {};

TEST_P(HeatOfInlets, ComesIn) {
  SimulationSetup s = hot_dam();
  if (GetParam()) s.particles = {};
  InletSetup in;
  in.name = "feed", in.body = s.bodies.size(), in.fluid = 0, in.normal = {1, 0, 0}, in.stride = dx;
  in.rate.speed = {0.5}, in.temperature = 1650;
  s.bodies.push_back({"feed", WallSlip::no_slip});
  for (int j = 0; j < 7; ++j) {
    in.origin.push_back({0.10, -0.02 + (j + 0.5) * dx, 0.095}), in.share.push_back(1);
    for (int row = 0; row < inlet_rows(s); ++row) {
      s.walls.position.push_back(in.origin.back() -
                                 inlet_row_place(row, inlet_moving_rows(s)) * dx * in.normal);
      s.walls.normal.push_back(in.normal), s.walls.depth.push_back((row + 0.5) * dx);
      s.walls.body.push_back(static_cast<std::uint8_t>(in.body));
    }
  }
  s.inlets.push_back(in);
  Simulation simulation(s);
  run(simulation, 200);
  const Totals t = simulation.totals();
  ASSERT_GT(t.fed.at(0), 20);
  EXPECT_GT(t.heat.fed, 0);
  EXPECT_NEAR(t.heat.error(), 0, 1e-6 * (t.heat.surface + t.heat.walls.at(0)));
  EXPECT_NEAR(t.heat.hottest, GetParam() ? 1650 : 1700, 1);
}

INSTANTIATE_TEST_SUITE_P(Vessels, HeatOfInlets, testing::Values(false, true),
                         [](const auto& test) { return test.param ? "Empty" : "Filled"; });

}  // namespace
}  // namespace slagflow
