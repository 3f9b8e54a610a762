// The second sweep: predicted velocities and the coefficients of the viscous system against the oracle.
#include <gtest/gtest.h>

#include "core/viscous_scene.hpp"
#include "reference_viscous.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double dt = 2e-3;
constexpr double rounding = 40 * epsilon;  // about 100 terms, each of some ten operations

class Predictor : public testing::TestWithParam<SceneOptions> {
 protected:
  Predictor() : scene_(GetParam()) { scene_.world.way = dt; }

  // Against the oracle's.
  void expect_velocities(const HostSystem& system) const {
    for (std::size_t i = 0; i < system.predicted.size(); ++i) {
      const auto& p = scene_.world.particles[i];
      const reference::Sum a = reference::acceleration(scene_.world, i);
      const reference::Vec error = to_host(system.predicted[i]) - (p.v + dt * a.value);
      EXPECT_LT(reference::length(error), rounding * dt * a.size + 4 * epsilon * reference::length(p.v))
          << "particle " << i;
    }
  }

  Scene scene_;
};

TEST_P(Predictor, VelocityMatchesOracle) {
  const HostSystem system = assemble(scene_, dt, 1);
  expect_velocities(system);
}

TEST_P(Predictor, VelocityMatchesOracleWhereWallsHaveLimits) {
  const HostSystem common = assemble(scene_, dt, 1);
  scene_.give_walls_limits();
  const HostSystem system = assemble(scene_, dt, 1);
  expect_velocities(system);
  int changed = 0;
  for (std::size_t i = 0; i < system.predicted.size(); ++i)
    changed += !(xyz(system.predicted[i]) == xyz(common.predicted[i]));
  if (!scene_.world.walls.empty()) {
    EXPECT_GT(changed, 10);
  }
}

TEST_P(Predictor, ForceByPressureIsAllButGravityAndBodyForce) {
  const HostSystem system = assemble(scene_, dt, 1);
  const reference::Vec rest = scene_.world.gravity + scene_.world.body_acceleration;
  for (std::size_t i = 0; i < system.by_pressure.size(); ++i) {
    const reference::Sum a = reference::acceleration(scene_.world, i);
    const double density = scene_.world.kind(scene_.world.particles[i]).rest_density;
    const reference::Vec error = to_host(system.by_pressure[i]) - density * (a.value - rest);
    EXPECT_LT(reference::length(error), rounding * density * a.size) << "particle " << i;
  }
}

TEST_P(Predictor, ImpulseGivenIsThatOfPairingAndWalls) {
  const HostSystem system = assemble(scene_, dt, 1);
  for (std::size_t i = 0; i < system.given.size(); ++i) {
    const auto& p = scene_.world.particles[i];
    reference::Vec given;
    const reference::Sum a = reference::acceleration(scene_.world, i, &given);
    const reference::Vec error = to_host(system.given[i]) - dt * p.mass * given;
    EXPECT_LT(reference::length(error), 2 * rounding * dt * p.mass * a.size) << "particle " << i;
  }
}

// Heavy and light fluid: what one particle gains the other loses.
TEST_P(Predictor, PressureKeepsMomentum) {
  scene_.world.walls.clear();
  const HostSystem system = assemble(scene_, dt, 1);
  reference::Vec sum;
  double size = 0;
  for (std::size_t i = 0; i < system.by_pressure.size(); ++i) {
    const auto& p = scene_.world.particles[i];
    const double volume = p.mass / scene_.world.kind(p).rest_density;
    sum = sum + volume * to_host(system.by_pressure[i]);
    size += volume * scene_.world.kind(p).rest_density * reference::acceleration(scene_.world, i).size;
  }
  EXPECT_LT(reference::length(sum), rounding * size);
}

TEST_P(Predictor, AntiPairingPushesClosePairsApartAtEitherSignOfPressure) {
  scene_.world.walls.clear();
  scene_.world.particles.resize(2);
  scene_.world.anti_pairing = 0.1, scene_.flow.anti_pairing = Real(0.1);
  auto& p = scene_.world.particles;
  for (double pressure : {100.0, -100.0}) {
    p[0].pressure = p[1].pressure = pressure;
    p[0].v = p[1].v = {};
    p[1].x = p[0].x + reference::Vec{0.1 * Scene::spacing, 0, 0};
    const HostSystem close = assemble(scene_, dt, 1);
    // (W(0.1 dx)/W(dx))^4 - 1 is 14, times 0.1: the term outweighs a tension that alone would attract.
    EXPECT_GT(static_cast<double>(close.predicted[1].x - close.predicted[0].x), 1e-6) << pressure;
  }
}

TEST_P(Predictor, MatrixMatchesOracle) {
  for (double theta : {1.0, 0.5}) {
    const HostSystem system = assemble(scene_, dt, theta);
    const reference::ViscousSystem wanted =
        reference::viscous_system(scene_.world, {system.predicted.size(), reference::Vec{}}, dt, theta);
    const reference::Dense matrix = system.dense();
    for (std::size_t i = 0; i < matrix.size; ++i) {
      const double scale = std::max({wanted.matrix(i, i), wanted.matrix(i / 3 * 3, i / 3 * 3),
                                     wanted.matrix(i / 3 * 3 + 2, i / 3 * 3 + 2)});
      for (std::size_t j = 0; j < matrix.size; ++j)
        ASSERT_NEAR(matrix(i, j), wanted.matrix(i, j), rounding * scale) << "row " << i << ", column " << j;
      EXPECT_NEAR(system.diagonal_entry(i), wanted.matrix(i, i), rounding * scale) << "row " << i;
    }
  }
}

TEST_P(Predictor, MatrixIsSymmetric) {
  const HostSystem system = assemble(scene_, dt, 1);
  Random random(11);
  std::vector<Quad> x, y;
  for (std::size_t i = 0; i < system.predicted.size(); ++i)
    x.push_back(quad(to_real(random.vector(1)), 0)), y.push_back(quad(to_real(random.vector(1)), 0));
  double forward = 0, backward = 0, size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3d ax = to_double(system.apply(i, x)), ay = to_double(system.apply(i, y));
    forward += dot(to_double(xyz(y[i])), ax), backward += dot(to_double(xyz(x[i])), ay);
    size += norm(ax) + norm(ay);
  }
  EXPECT_NEAR(forward, backward, 10 * epsilon * size);
}

TEST_P(Predictor, MovingWallEntersTheRightHandSide) {
  for (auto& wall : scene_.world.walls) wall.v = {0.7, -0.2, 0.4};
  const HostSystem system = assemble(scene_, dt, 1);
  const reference::ViscousOperator k = reference::viscous_operator(scene_.world);
  const double largest = *std::max_element(k.from_walls.begin(), k.from_walls.end());
  if (!scene_.world.walls.empty()) {
    EXPECT_GT(dt * largest, 1e-4 * scene_.world.particles[0].mass) << "the wall does not matter";
  }
  for (std::size_t i = 0; i < system.predicted.size(); ++i) {
    const double mass = scene_.world.particles[i].mass;
    const reference::Vec part = to_host(system.right_hand_side[i]) - mass * to_host(system.predicted[i]);
    const double scale = static_cast<double>(system.diagonal[i].x + system.diagonal[i].z);
    EXPECT_NEAR(part.x, dt * k.from_walls[3 * i], rounding * scale);
    EXPECT_NEAR(part.y, dt * k.from_walls[3 * i + 1], rounding * scale);
    EXPECT_NEAR(part.z, dt * k.from_walls[3 * i + 2], rounding * scale);
  }
}

TEST_P(Predictor, CoincidentParticlesStayFinite) {
  auto& p = scene_.world.particles;
  p[1].x = p[0].x;
  p[2].x = p[0].x, p[2].x.z += 1e-9;
  const HostSystem system = assemble(scene_, dt, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isfinite(norm(xyz(system.predicted[i]))));
    EXPECT_TRUE(std::isfinite(norm(xyz(system.diagonal[i]))));
  }
}

INSTANTIATE_TEST_SUITE_P(, Predictor, testing::ValuesIn(all_scenes()),
                         [](const auto& p) { return scene_name(p.param); });

}  // namespace
}  // namespace slagflow
