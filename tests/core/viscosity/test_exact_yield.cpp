// The exact yield stress against a dense convex solver, and what it must keep.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "core/simulation_setups.hpp"
#include "core/viscous_scene.hpp"
#include "reference_yield.hpp"
#include "simulation/simulation.hpp"
#include "viscosity/exact_yield.hpp"
#include "viscosity/viscous.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double dt = 2e-3, eta = 0.5;

NumericsSetup exact_numerics() {
  NumericsSetup n;
  n.yield = YieldModel::exact, n.tolerance = 1e-4, n.yield_iterations = 5000, n.max_iterations = 1000;
  return n;
}

// Makes all of the fluid one Bingham fluid.
void make_bingham(Scene& scene, double tau) {
  scene.setup.fluids[0] =
      scene.setup.fluids[1] = {"slag", 2600, {RheologyKind::bingham, {Real(eta), Real(tau), Real(100)}}};
  for (auto& f : scene.world.fluids) f = {2600, eta, tau, 100};
  for (auto& p : scene.world.particles) {
    p.mass = 2600 * std::pow(Scene::spacing, scene.setup.dimensions), p.volume = p.mass / (2600 + p.excess);
    p.viscosity = eta, p.v = 0.5 * p.v, p.fluid = 0;
  }
}

// Every other particle becomes an oil of twice the viscosity without a yield stress.
void mix_in_oil(Scene& scene) {
  scene.setup.fluids[1] = {"oil", 2600, {RheologyKind::newtonian, {Real(2 * eta)}}};
  scene.world.fluids[1] = {2600, 2 * eta, 0, 100};
  for (std::size_t i = 0; i < scene.world.particles.size(); i += 2)
    scene.world.particles[i].fluid = 1, scene.world.particles[i].viscosity = 2 * eta;
}

// Colder from the floor up: thicker, of a higher yield stress, and solid on top. Returns the yield stresses.
std::vector<double> cool(Scene& scene, double tau) {
  constexpr double eta_solid = 50;
  std::vector<double> yield;
  const double top = scene.setup.domain.upper.z;
  for (auto& p : scene.world.particles) {
    const double height = p.x.z / top;
    p.solid = height > 0.8;
    p.viscosity = p.key = rounded(p.solid ? eta_solid : 0.2 * std::exp(3 * height));
    yield.push_back(p.solid || height < 0.2 ? 0 : rounded(2 * tau * height));
  }
  return yield;
}

// Of a Bingham fluid, after upload().
void upload_melt(Scene& scene, const std::vector<double>& yield) {
  std::vector<Quad> melt;
  for (const Index id : download(scene.context, scene.fluid.id.span())) {
    const auto& p = scene.world.particles[static_cast<std::size_t>(id)];
    const auto key = static_cast<Real>(p.key);
    melt.push_back({key, static_cast<Real>(yield[static_cast<std::size_t>(id)]), Real(p.solid ? 1 : 0), key});
  }
  scene.fluid.melt.upload(melt);
}

struct Solved {
  SolveResult result;
  std::vector<Quad> velocity;  // by id
  std::vector<Real> held;
};

Solved advance(Scene& scene, const NumericsSetup& n, const std::vector<double>& melt_yield = {}) {
  scene.upload();
  if (!melt_yield.empty()) upload_melt(scene, melt_yield);
  ViscousStep step(scene.context, n);
  step.exact_yield().follow({scene.fluid_list, scene.wall_list, scene.fluid.id, scene.wall.id},
                            scene.fluid.count);
  const double mass = 2600 * std::pow(Scene::spacing, scene.setup.dimensions);
  const SolveResult result = step.advance(scene.pairs(), scene.rows(), {dt, 9.81 * dt, mass, scene.world.way},
                                          scene.fluid_list.capacity(), scene.fluid);
  return {result, scene.by_id(step.velocity()), scene.by_id(step.exact_yield().held())};
}

class ExactYieldIn : public testing::TestWithParam<SceneOptions> {};

// One side in disorder, the other nearly at rest.
void disturb(Scene& scene) {
  const double border = 0.3 * scene.setup.domain.upper.x;
  for (auto& wall : scene.world.walls) wall.v = {0.1, 0, 0}, wall.pressure = 0;
  for (auto& p : scene.world.particles) p.pressure = 0, p.v = (p.x.x < border ? 1 : 0.01) * p.v;
}

struct Compared {
  double error = 0, own_error = 0, shift = 0;  // rms [m/s]: of the program, of the oracle, by the stresses
  std::size_t held = 0, wrongly_yielded = 0;
};

// `yield` [Pa] of each particle.
Compared compare(Scene& scene, const std::vector<double>& yield, bool melts = false) {
  const Solved solved = advance(scene, exact_numerics(), melts ? yield : std::vector<double>{});
  EXPECT_TRUE(solved.result.converged) << solved.result.yield_iterations;
  std::vector<reference::Vec> predicted;
  for (const Quad& q : assemble(scene, dt, 1).predicted) predicted.push_back(to_host(q));
  const auto system = reference::viscous_system(scene.world, predicted, dt, 1);
  const std::size_t n = scene.world.particles.size();
  const auto wanted = reference::YieldOracle(scene.world, system, yield, dt).solve(3000);
  Compared c;
  for (std::size_t i = 0; i < n; ++i) {
    const reference::Vec want{wanted.velocity[3 * i], wanted.velocity[3 * i + 1], wanted.velocity[3 * i + 2]};
    const reference::Vec error = to_host(solved.velocity[i]) - want, change = want - predicted[i];
    c.error += reference::dot(error, error), c.shift += reference::dot(change, change);
    if (wanted.held[i] > 0.95 || yield[i] == 0) continue;
    ++c.held;
    // The stresses of a plug are not unique: they may touch the yield stress, but not shear.
    if (solved.held[i] < Real(0.99)) ++c.wrongly_yielded;
  }
  const auto count = static_cast<double>(n);
  c.error = std::sqrt(c.error / count), c.shift = std::sqrt(c.shift / count);
  // The duality gap bounds the oracle's own error: 1/2 sum m |error|^2.
  c.own_error = std::sqrt(2 * std::max(wanted.gap, 0.0) / (scene.world.particles[0].mass * count));
  return c;
}

Compared compare(Scene& scene, double tau) {
  std::vector<double> yield;
  for (const auto& p : scene.world.particles) yield.push_back(p.fluid == 0 ? tau : 0);
  return compare(scene, yield);
}

TEST_P(ExactYieldIn, MatchesADenseConvexSolver) {
  std::size_t held = 0, all = 0;
  for (const double tau : {1500.0, 3500.0, 5000.0}) {  // from yielded throughout to a rigid body
    Scene scene(GetParam());
    make_bingham(scene, tau), disturb(scene);
    const Compared c = compare(scene, tau);
    // Of 0.2 m/s. The solve is asked for 1e-4 g dt = 2e-6 m/s and converges linearly, slowest at the onset.
    EXPECT_LT(c.error, c.own_error + 1e-4) << "yield stress " << tau;
    EXPECT_LT(c.own_error, 1e-3) << "the oracle has not arrived";
    EXPECT_GT(c.shift, 0.05) << "the stresses do nothing";
    EXPECT_LE(c.wrongly_yielded, c.held / 10);
    held += c.held, all += scene.world.particles.size();
  }
  EXPECT_GT(held, 0) << "there is no plug";
  EXPECT_LT(held, all) << "nothing yields";
}

// What is disturbed does not turn as a rigid body, and no part of it stays one.
TEST_P(ExactYieldIn, KeepsDistancesAlongChordsAsADenseConvexSolverDoes) {
  Scene scene(GetParam());
  make_bingham(scene, 3500), disturb(scene);
  scene.world.way = dt;
  const Compared c = compare(scene, 3500);
  EXPECT_LT(c.error, c.own_error + 1e-4);
  EXPECT_LT(c.own_error, 1e-3) << "the oracle has not arrived";
  EXPECT_GT(c.shift, 0.05) << "the stresses do nothing";
}

// Yield stress, viscosity and (H10) of each particle's temperature.
TEST_P(ExactYieldIn, WithHeatMatchesADenseConvexSolver) {
  std::size_t held = 0;
  for (const double tau : {1500.0, 20000.0}) {
    Scene scene(GetParam());
    make_bingham(scene, tau), disturb(scene);
    const Compared c = compare(scene, cool(scene, tau), true);
    EXPECT_LT(c.error, c.own_error + 1e-4) << "yield stress " << tau;
    EXPECT_LT(c.own_error, 3e-3) << "the oracle has not arrived";
    EXPECT_GT(c.shift, 0.05) << "the stresses do nothing";
    EXPECT_LE(c.wrongly_yielded, c.held / 10);
    held += c.held;
  }
  EXPECT_GT(held, 0) << "there is no plug";
}

INSTANTIATE_TEST_SUITE_P(, ExactYieldIn,
                         testing::Values(SceneOptions{3, Surroundings::walls, 5, 0.2, 1},
                                         SceneOptions{2, Surroundings::walls, 9, 0.2, 4},
                                         SceneOptions{2, Surroundings::periodic, 8, 0.2, 5},
                                         SceneOptions{2, Surroundings::free, 7, 0.3, 6}),
                         [](const auto& p) { return scene_name(p.param); });

// The halves of a pair of two fluids bear one stress: a yield stress does not reach into the other fluid.
TEST(ExactYield, APasteMixedWithOilMatchesADenseConvexSolver) {
  for (const double tau : {1500.0, 5000.0}) {
    Scene scene({2, Surroundings::walls, 5, 0.2, 4});
    make_bingham(scene, tau), mix_in_oil(scene), disturb(scene);
    scene.world.way = dt;
    const Compared c = compare(scene, tau);
    // The oracle converges slowly along the unknowns of the pairs' middles: its own bound is a twentieth of
    // what the stresses do.
    EXPECT_LT(c.own_error, 5e-3) << "the oracle has not arrived";
    EXPECT_LT(c.error, 1e-3) << "yield stress " << tau;
    EXPECT_GT(c.shift, 0.05) << "the stresses do nothing";
  }
}

TEST(ExactYield, AFreeBlockKeepsMomentumAndAngularMomentum) {
  Scene scene({3, Surroundings::free, 6, 0.2, 9});
  make_bingham(scene, 1500);
  scene.flow.gravity = {}, scene.flow.body_acceleration = {};
  for (auto& p : scene.world.particles) p.pressure = 0;
  scene.world.way = dt;
  const Solved solved = advance(scene, exact_numerics());
  reference::Vec linear, angular;
  double size = 0, change = 0;
  for (std::size_t i = 0; i < solved.velocity.size(); ++i) {
    const auto& p = scene.world.particles[i];
    const reference::Vec gain = to_host(solved.velocity[i]) - p.v;
    linear = linear + p.mass * gain, angular = angular + p.mass * reference::cross(p.x, gain);
    size += p.mass * reference::length(p.v), change += p.mass * reference::length(gain);
  }
  EXPECT_LT(reference::length(linear), 1e-6 * size);
  EXPECT_LT(reference::length(angular), 1e-6 * size * 0.06);
  EXPECT_GT(change, 0.1 * size) << "the stresses do nothing";
}

TEST(ExactYield, ARigidMotionOfAFreeBlockIsLeftAlone) {
  Scene scene({3, Surroundings::free, 6, 0.2, 9});
  make_bingham(scene, 1500);
  scene.flow.gravity = {}, scene.flow.body_acceleration = {};
  for (auto& p : scene.world.particles) p.pressure = 0;
  scene.world.way = dt;
  spin_along_chords(scene.world, {20, -30, 40}, dt);
  const Solved solved = advance(scene, exact_numerics());
  // Velocities of 5 m/s rounded to epsilon.
  for (std::size_t i = 0; i < solved.velocity.size(); ++i) {
    EXPECT_LT(reference::length(to_host(solved.velocity[i]) - scene.world.particles[i].v),
              sizeof(Real) == 4 ? 2e-5 : 1e-11);
    EXPECT_EQ(solved.held[i], Real(1));
  }
}

TEST(ExactYield, AStepThatStopsAtTheMostIterationsSaysSo) {
  Scene scene({3, Surroundings::walls, 5, 0.2, 1});
  make_bingham(scene, 1500);
  NumericsSetup n = exact_numerics();
  n.yield_iterations = 1;
  EXPECT_FALSE(advance(scene, n).result.converged);
}

SimulationSetup exact_dam() {
  SimulationSetup s = dam();
  s.numerics.yield = YieldModel::exact;
  return s;
}

TEST(ExactYield, AStepThatStopsAtTheMostIterationsIsRetriedWithASmallerStep) {
  SimulationSetup s = exact_dam();
  Simulation enough(s);
  enough.step();
  ASSERT_EQ(enough.solver_totals().retried, 0);
  s.numerics.yield_iterations = static_cast<int>(enough.solver_totals().yield_iterations) - 1;
  ASSERT_GE(s.numerics.yield_iterations, 1);
  Simulation simulation(s);
  const double full = simulation.time_step();
  simulation.step();
  EXPECT_GE(simulation.solver_totals().retried, 1);
  EXPECT_EQ(simulation.solver_totals().retried, simulation.solver_totals().yield_unconverged);
  EXPECT_TRUE(simulation.last_solve().converged);
  EXPECT_LT(simulation.time_step(), 0.6 * full);
  EXPECT_DOUBLE_EQ(simulation.time(), simulation.time_step());
}

TEST(ExactYield, AStepThatNeverConvergesEndsTheRun) {
  SimulationSetup s = exact_dam();
  s.numerics.yield_iterations = 1, s.numerics.tolerance = 1e-6;
  Simulation simulation(s);
  try {
    simulation.step();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did not converge in step 1"));
    EXPECT_THAT(error.what(), testing::HasSubstr("numerics.yield_iterations = 1; try more yield_iterations"));
  }
  EXPECT_EQ(simulation.solver_totals().retried, 4);
  EXPECT_EQ(simulation.solver_totals().yield_unconverged, 5);
}

// Across rebuilds of the lists, with particles that leave and walls that move.
TEST(ExactYield, ARestoredRunGoesOnToTheSameBits) {
  SimulationSetup s = exact_dam();
  s.measure_walls = true;
  s.numerics.skin = 0.02;  // lists are soon built anew
  for (WallBody& body : s.bodies) {
    body.motion.kind = MotionKind::sine, body.motion.frequency = 20;
    body.motion.amplitude = {0.4 * dx, 0, 0.1 * dx};
  }
  Simulation whole(s);
  for (int k = 0; k < 15; ++k) whole.step();
  const SavedState saved = whole.save();
  Simulation restored(s);
  restored.restore(saved);
  const std::int64_t builds = whole.list_builds();
  for (int k = 0; k < 60 && whole.list_builds() < builds + 2; ++k) whole.step(), restored.step();
  ASSERT_GT(whole.list_builds(), builds + 1);
  const SavedState a = whole.save(), b = restored.save();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].bytes, b[k].bytes) << a[k].name;
}

// A layer of slag at rest on a floor of slope 0.1 stays at rest when it is too thin to yield.
TEST(ExactYield, ALayerBelowYieldDoesNotCreep) {
  SimulationSetup s = tank(slag());
  s.gravity = {};
  s.body_acceleration = {0.8 * 5 / (2600 * 0.06), 0, 0};  // 0.8 of the yield stress on the floor
  s.particles.pressure.assign(s.particles.pressure.size(), 0);
  auto creep = [&](YieldModel yield) {
    s.numerics.yield = yield;
    Simulation simulation(s);
    for (int k = 0; k < 100; ++k) simulation.step();
    FluidSnapshot after;
    simulation.read(after);
    for (std::uint8_t y : after.yielded) EXPECT_EQ(y, 0);
    return simulation.totals().max_speed;
  };
  // Regularised: half the shear at the floor over the depth, 1/2 (0.8 tau / m tau) 0.06 m.
  EXPECT_GT(creep(YieldModel::regularised), 1e-5);
  EXPECT_LT(creep(YieldModel::exact), 1e-9);
}

TEST(ExactYield, NeedsAnImplicitEulerStepWithTheRadialOperatorAndAYieldStressItKnows) {
  for (const int what : {0, 1, 2, 3}) {
    SimulationSetup s = exact_dam();
    if (what == 0) s.numerics.theta = 0.5;
    if (what == 1) s.numerics.viscous_operator = ViscousOperator::laplacian;
    if (what == 2) s.numerics.viscous_step = ViscousStepping::explicit_step;
    if (what == 3) s.fluids[0].rheology.kind = RheologyKind::casson;
    EXPECT_THROW(validate(s), InputError) << what;
  }
}

}  // namespace
}  // namespace slagflow
