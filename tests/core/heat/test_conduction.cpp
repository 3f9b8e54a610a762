// A step of conduction against the oracle: between particles, at walls, at free surfaces.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "fluid/lattice_viscosity.hpp"
#include "heat/heat.hpp"
#include "heat/wall_sites.hpp"
#include "reference_heat.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

HeatBalance balance_of(const Heat& heat, Scene& scene) {
  DiagnosticScratch scratch(scene.context);
  GatheredSums sums(scene.context, scratch);
  HeatBalance balance;
  heat.balance(scene.fluid, scene.fluids.span(), sums, balance);
  sums.read();
  return balance;
}

// With conductivities that change with temperature, and walls of three kinds: a thick floor behind a
// resistance, a side that is held, a plate with a flux.
class Conduction : public testing::TestWithParam<SceneOptions> {
 protected:
  static constexpr double dt = 0.5, inside = 0.01;

  Conduction() : scene_(GetParam()), heat_(scene_.context) {
    scene_.upload();
    set_fluids();
    set_walls();
    SimulationSetup& s = scene_.setup;
    s.thermal = {true, 300, 25, true, false, 1700};
    Random random(7);
    for (std::size_t i = 0; i < scene_.world.particles.size(); ++i)
      oracle_.temperature.push_back(random.uniform(1200, 1700));
    for (const Index id : download(scene_.context, scene_.fluid.id.span())) {  // as they are sorted
      const auto i = static_cast<std::size_t>(id);
      s.particles.fluid.push_back(static_cast<std::uint8_t>(scene_.world.particles[i].fluid));
      s.particles.temperature.push_back(oracle_.temperature[i]);
    }
    heat_.start(s, {}, scene_.fluid);
    make_oracle();
  }

  void set_fluids() {
    MaterialSetup m;
    m.heat_capacity = {{300, 1000}}, m.conductivity = {{300, 1}, {1500, 1.4}, {1650, 0.7}};
    m.emissivity = 0.8;
    scene_.setup.fluids[0].material = m;
    m.conductivity = {{300, 3}, {2000, 5}}, m.emissivity = 0;
    scene_.setup.fluids[1].material = m;
  }

  void set_walls() {
    SimulationSetup& s = scene_.setup;
    s.bodies.resize(3);
    s.bodies[0].thermal = {WallHeat::semi_infinite, 400, 0, 800, 40, 7850, 550};
    s.bodies[1].thermal = {WallHeat::temperature, 900, 0, 0, 0, 0, 0};
    s.bodies[2].thermal = {WallHeat::flux, 0, 5e4, 0, 0, 0, 0};
    for (const reference::Wall& w : scene_.world.walls) {
      s.walls.position.push_back({w.x.x, w.x.y, w.x.z});
      s.walls.normal.push_back({w.normal.x, w.normal.y, w.normal.z});
      s.walls.depth.push_back(w.depth);
      s.walls.body.push_back(w.back_depth > 0 ? 2 : w.normal.z > 0 ? 0 : 1);
    }
  }

  void make_oracle() {
    const SimulationSetup& s = scene_.setup;
    oracle_.world = scene_.world;
    for (const FluidSetup& f : s.fluids) {
      oracle_.conductivity.push_back(f.material.conductivity);
      oracle_.emissivity.push_back(f.material.emissivity);
    }
    oracle_.ambient = 300, oracle_.transfer = 25;
    oracle_.factor = 1 / lattice_viscosity(ViscousOperator::laplacian, {}, s.support_ratio, s.dimensions);
    oracle_.bodies = {
        {reference::HeatWall::thick, 400, 0, 800, 1.752 / 2.752 * 40 * 7850 * 550, 7850.0 * 550 * 1e-7},
        {reference::HeatWall::held, 900, 0, 0, 0, 0},
        {reference::HeatWall::flux, 0, 5e4, 0, 0, 0}};
    const WallSites sites = wall_sites(s);
    oracle_.site.assign(sites.of_wall.begin(), sites.of_wall.end());
    oracle_.site_area = sites.area;
    for (const std::uint8_t body : sites.body) oracle_.site_body.push_back(body);
    const double pi = reference::pi;
    const bool flat = s.dimensions == 2;
    const int count = flat ? 132 : 128;
    for (int k = 0; k < count; ++k) {
      const double along = (k + 0.5) / count, z = 1 - 2 * along, r = std::sqrt(1 - z * z);
      const double turn = flat ? 2 * pi * along : pi * (1 + std::sqrt(5.0)) * (k + 0.5);
      oracle_.directions.push_back(flat ? reference::Vec{std::cos(turn), 0, std::sin(turn)}
                                        : reference::Vec{r * std::cos(turn), r * std::sin(turn), z});
    }
    // Of the circle a sixth; of the sphere what is over a square of one spacing, 1.10257 of 4 pi.
    oracle_.flat_share = flat ? 1.0 / 6 : 1.10257119 / (4 * pi);
    const double ball = flat ? 2 * std::sqrt(pi) : std::cbrt(36 * pi);
    oracle_.drop_exponent = std::log(ball / 2) / std::log(1 / (2 * oracle_.flat_share));
  }

  std::vector<double> changes() {
    const std::vector<double> before = scene_.by_id(Span<const double>(scene_.fluid.enthalpy.span()));
    heat_.conduct(scene_.pairs(), scene_.wall_to_fluid.view(), dt, scene_.fluid);
    std::vector<double> after = scene_.by_id(Span<const double>(scene_.fluid.enthalpy.span()));
    for (std::size_t i = 0; i < after.size(); ++i) after[i] -= before[i];
    return after;
  }

  Scene scene_;
  Heat heat_;
  reference::HeatWorld oracle_;
};

TEST_P(Conduction, AgreesWithTheOracle) {
  const std::vector<double> change = changes();
  const auto walls = oracle_.from_walls();
  int open = 0;
  bool unclear = false;
  double surface = 0;
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (std::fabs(oracle_.deficit(i) - inside) < 1e-5) continue;  // either is right
    const double lost = oracle_.lost(i, inside);
    if (std::isnan(lost)) {
      unclear = true;
      continue;
    }
    const reference::HeatWorld::Flow conducted = oracle_.conducted(i);
    const double power = conducted.value + walls.particle[i] - lost;
    const double size = std::fabs(walls.particle[i]) + lost + conducted.size;
    const double mass = static_cast<double>(static_cast<Real>(scene_.world.particles[i].mass));
    EXPECT_NEAR(change[i] * mass / dt, power, 2e-4 * size) << "particle " << i;
    open += lost > 0, surface += lost * dt;
  }
  EXPECT_GT(open, 0);
  const HeatBalance balance = balance_of(heat_, scene_);
  if (!unclear) {
    EXPECT_NEAR(balance.surface, surface, 2e-4 * surface);
  }
  double all = 0;
  for (std::size_t body = 0; body < oracle_.bodies.size(); ++body) {
    double taken = 0;
    for (std::size_t s = 0; s < walls.site.size(); ++s)
      if (oracle_.site_body[s] == static_cast<int>(body)) taken -= walls.site[s] * dt;
    EXPECT_NEAR(balance.walls[body], taken, 2e-4 * std::fabs(taken) + 1e-9) << "wall " << body;
    all += std::fabs(taken);
  }
  EXPECT_EQ(all > 0, !scene_.world.walls.empty());
  // What the fluid lost is what was told to have left it.
  EXPECT_NEAR(balance.error(), 0, 1e-6 * (surface + all));
}

// The mean over a site's pairs of T + q d/k, the fluid's side of the contact; unknown where there is no
// fluid.
TEST_P(Conduction, TellsTheSurfaceOfAWallWithAFlux) {
  changes();
  const std::vector<float> told = heat_.wall_temperatures();
  for (std::size_t w = 0; w < told.size(); ++w) {
    const int s = oracle_.site[w];
    if (s < 0 || oracle_.site_body[static_cast<std::size_t>(s)] != 2) continue;
    double covered = 0, touches = 0;
    oracle_.each_pair(s, [&](std::size_t i, reference::HeatWorld::Contact c) {
      const double t = oracle_.temperature[i];
      covered += c.area, touches += c.area * (t + oracle_.bodies[2].flux_in * c.distance / oracle_.k(i, t));
    });
    if (covered > 0)
      EXPECT_NEAR(told[w], touches / covered, 1e-4 * touches / covered) << w;
    else
      EXPECT_TRUE(std::isnan(told[w])) << w;
  }
}

TEST_P(Conduction, KeepsTheHeatOfFluidBetweenParticles) {
  SimulationSetup& s = scene_.setup;
  s.thermal.surface_heat_transfer = 0, s.thermal.radiation = false;
  for (WallBody& body : s.bodies) body.thermal = {};
  Heat heat(scene_.context);
  heat.start(s, {}, scene_.fluid);
  for (int step = 1; step <= 10; ++step)
    heat.conduct(scene_.pairs(), scene_.wall_to_fluid.view(), step * dt, scene_.fluid);
  const HeatBalance balance = balance_of(heat, scene_);
  EXPECT_GT(balance.coolest, 1200);
  EXPECT_LT(balance.hottest, 1700);
  EXPECT_NEAR(balance.content, balance.start, 1e-9 * balance.start);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Conduction, testing::ValuesIn(all_scenes()),
                         [](const auto& test) { return scene_name(test.param); });

}  // namespace
}  // namespace slagflow
