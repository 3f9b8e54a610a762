// The pressure of wall particles against the oracle.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double rounding = 40 * epsilon;  // sums of at most 60 terms of one weight each

std::vector<Real> extrapolate(Scene& scene) {
  scene.upload();
  extrapolate_wall_pressure(scene.context, scene.pairs(), scene.wall_to_fluid.view(), scene.wall);
  return scene.by_wall_id(view(scene.wall).pressure);
}

class WallPressure : public testing::TestWithParam<SceneOptions> {};

TEST_P(WallPressure, MatchesOracle) {
  Scene scene(GetParam());
  const auto pressure = extrapolate(scene);
  ASSERT_FALSE(pressure.empty());
  for (std::size_t w = 0; w < pressure.size(); ++w) {
    const reference::Sum wanted = reference::wall_pressure(scene.world, scene.world.walls[w]);
    EXPECT_NEAR(static_cast<double>(pressure[w]), wanted.value.x, rounding * wanted.size)
        << "wall particle " << w;
  }
}

TEST_P(WallPressure, MatchesOracleWhereWallsAccelerate) {
  Scene scene(GetParam());
  Random random(7);
  for (auto& w : scene.world.walls) {
    const Vec3d a = random.vector(50);
    w.acceleration = {a.x, a.y, a.z};
  }
  scene.walls_move = true;
  const auto pressure = extrapolate(scene);
  int changed = 0;
  for (std::size_t w = 0; w < pressure.size(); ++w) {
    reference::Wall wall = scene.world.walls[w];
    const reference::Sum wanted = reference::wall_pressure(scene.world, wall);
    EXPECT_NEAR(static_cast<double>(pressure[w]), wanted.value.x, rounding * wanted.size)
        << "wall particle " << w;
    wall.acceleration = {};
    if (std::fabs(reference::wall_pressure(scene.world, wall).value.x - wanted.value.x) > 100) ++changed;
  }
  EXPECT_GT(changed, 5);
}

// A wall at rest among others that move: the same bits as where none ever does.
TEST_P(WallPressure, IsTheSameOfWallsAtRest) {
  Scene scene(GetParam());
  const auto alone = extrapolate(scene);
  scene.walls_move = true;
  EXPECT_EQ(extrapolate(scene), alone);
}

TEST_P(WallPressure, IsCutOffAtTheTensionLimit) {
  Scene scene(GetParam());
  for (auto& p : scene.world.particles) p.pressure = -500;
  const auto pressure = extrapolate(scene);
  EXPECT_EQ(*std::min_element(pressure.begin(), pressure.end()), Real(-40));
}

TEST_P(WallPressure, MatchesOracleWhereWallsHaveLimits) {
  Scene scene(GetParam());
  scene.give_walls_limits();
  scene.world.gravity = {}, scene.flow.gravity = {};
  for (auto& p : scene.world.particles) p.excess = std::min(p.excess, -2.0);
  const auto pressure = extrapolate(scene);
  int cut = 0;
  for (std::size_t w = 0; w < pressure.size(); ++w) {
    const reference::Sum wanted = reference::wall_pressure(scene.world, scene.world.walls[w]);
    EXPECT_NEAR(static_cast<double>(pressure[w]), wanted.value.x, rounding * wanted.size)
        << "wall particle " << w;
    const double limit = scene.world.walls[w].tension_limit;
    cut += limit > 0 && limit < 40 && static_cast<double>(pressure[w]) < -limit * (1 - rounding);
  }
  EXPECT_GT(cut, 3);
}

TEST_P(WallPressure, IsZeroFarFromTheFluid) {
  Scene scene(GetParam());
  for (auto& p : scene.world.particles) p.x.x = 0.05, p.x.z = 0.05;
  const auto pressure = extrapolate(scene);
  int far = 0;
  for (std::size_t w = 0; w < pressure.size(); ++w) {
    if (reference::wall_pressure(scene.world, scene.world.walls[w]).size > 0) continue;
    EXPECT_EQ(pressure[w], 0) << "wall particle " << w;
    ++far;
  }
  EXPECT_GT(far, 20);
}

// Fluid at rest under gravity: the wall continues the linear pressure exactly.
TEST_P(WallPressure, ContinuesTheHydrostaticPressure) {
  Scene scene(GetParam());
  const double density = 900;
  for (auto& p : scene.world.particles) {
    p.fluid = 0, p.excess = 0;
    p.pressure = 1000 + density * reference::dot(scene.world.gravity, p.x);
  }
  if (GetParam().surroundings == Surroundings::periodic) {
    scene.world.gravity.x = 0, scene.flow.gravity.x = 0;  // no hydrostatic state along a periodic axis
    for (auto& p : scene.world.particles)
      p.pressure = 1000 + density * reference::dot(scene.world.gravity, p.x);
  }
  const auto pressure = extrapolate(scene);
  for (std::size_t w = 0; w < pressure.size(); ++w) {
    const auto& wall = scene.world.walls[w];
    const double wanted = 1000 + density * reference::dot(scene.world.gravity, wall.x);
    if (reference::wall_pressure(scene.world, wall).size == 0) continue;
    EXPECT_NEAR(static_cast<double>(pressure[w]), wanted, rounding * 1500);
  }
}

std::vector<SceneOptions> scenes_with_walls() {
  std::vector<SceneOptions> result;
  for (const SceneOptions& o : all_scenes())
    if (o.surroundings != Surroundings::free) result.push_back(o);
  return result;
}

INSTANTIATE_TEST_SUITE_P(, WallPressure, testing::ValuesIn(scenes_with_walls()),
                         [](const auto& p) { return scene_name(p.param); });

}  // namespace
}  // namespace slagflow
