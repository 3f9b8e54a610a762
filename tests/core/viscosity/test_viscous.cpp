// The viscous step and its solvers against a dense solve, and what it must conserve.
#include <gtest/gtest.h>

#include <cstring>

#include "backend/device.hpp"
#include "core/viscous_scene.hpp"
#include "reference_viscous.hpp"
#include "viscosity/viscous.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double dt = 2e-3;

constexpr ViscousSolver every_solver[] = {ViscousSolver::multigrid, ViscousSolver::conjugate_gradient,
                                          ViscousSolver::sor, ViscousSolver::jacobi};

struct Solved {
  SolveResult result;
  std::vector<Quad> velocity;  // by id
};

// One step to a tight tolerance: velocities of 0.5 m/s to 2e-6 m/s in single precision, which rounds at 3e-8
// m/s.
NumericsSetup numerics(ViscousSolver solver, double theta) {
  NumericsSetup n;
  n.solver = solver, n.theta = theta, n.tolerance = sizeof(Real) == 4 ? 1e-4 : 1e-9, n.max_iterations = 4000;
  return n;
}

double lightest(const reference::World& w) {
  double mass = 1e300;
  for (const auto& p : w.particles) mass = std::min(mass, p.mass);
  return mass;
}

Solved advance(Scene& scene, const NumericsSetup& n) {
  scene.upload();
  ViscousStep step(scene.context, n);
  const SolveResult result =
      step.advance(scene.pairs(), scene.rows(), {dt, 9.81 * dt, lightest(scene.world), scene.world.way},
                   scene.fluid_list.capacity(), scene.fluid);
  return {result, scene.by_id(step.velocity())};
}

// The dense solution for the predicted velocities that the device found.
std::vector<double> exact(Scene& scene, double theta) {
  const HostSystem system = assemble(scene, dt, theta);
  std::vector<reference::Vec> predicted;
  for (const Quad& q : system.predicted) predicted.push_back(to_host(q));
  const auto s = reference::viscous_system(scene.world, predicted, dt, theta);
  return reference::solve_cholesky(s.matrix, s.right_hand_side);
}

class ViscousStepIn : public testing::TestWithParam<SceneOptions> {
 protected:
  ViscousStepIn() : scene_(GetParam()) {
    for (auto& wall : scene_.world.walls) wall.v = {0.3, 0, -0.1};
    scene_.world.way = dt;
  }

  void expect_exact(const Solved& solved, double theta) {
    const std::vector<double> wanted = exact(scene_, theta);
    double squared = 0, size = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double value = static_cast<double>(xyz(solved.velocity[i / 3])[static_cast<int>(i % 3)]);
      squared += square(value - wanted[i]), size += square(wanted[i]);
    }
    // The stop test bounds the rms error by 1e-4 (1e-9) g dt = 2e-6 (2e-11) m/s against 0.3 m/s; the rounding
    // of the coefficients is amplified by the stiffness (viscosities over three decades).
    EXPECT_LT(std::sqrt(squared / size), sizeof(Real) == 4 ? 2e-5 : 1e-9);
    EXPECT_TRUE(solved.result.converged);
    EXPECT_GT(solved.result.iterations, 1);
  }

  Scene scene_;
};

TEST_P(ViscousStepIn, ConjugateGradientMatchesDenseSolve) {
  expect_exact(advance(scene_, numerics(ViscousSolver::conjugate_gradient, 1)), 1);
}
TEST_P(ViscousStepIn, SorMatchesDenseSolve) {
  expect_exact(advance(scene_, numerics(ViscousSolver::sor, 1)), 1);
}
TEST_P(ViscousStepIn, JacobiMatchesDenseSolve) {
  expect_exact(advance(scene_, numerics(ViscousSolver::jacobi, 1)), 1);
}

TEST_P(ViscousStepIn, MultigridMatchesDenseSolve) {
  for (auto& p : scene_.world.particles) p.viscosity *= 10;  // beyond the patience with the diagonal alone
  expect_exact(advance(scene_, numerics(ViscousSolver::multigrid, 1)), 1);
}

TEST_P(ViscousStepIn, CrankNicolsonMatchesDenseSolve) {
  expect_exact(advance(scene_, numerics(ViscousSolver::conjugate_gradient, 0.5)), 0.5);
}

TEST_P(ViscousStepIn, ExplicitStepMatchesDenseProduct) {
  NumericsSetup n = numerics(ViscousSolver::multigrid, 1);
  n.viscous_step = ViscousStepping::explicit_step;
  const Solved solved = advance(scene_, n);
  const HostSystem system = assemble(scene_, dt, 1);
  std::vector<reference::Vec> predicted;
  for (const Quad& q : system.predicted) predicted.push_back(to_host(q));
  const reference::ViscousOperator k = reference::viscous_operator(scene_.world);
  std::vector<reference::Vec> old;
  for (const auto& p : scene_.world.particles) old.push_back(p.v);
  const std::vector<double> force = reference::multiply(k.matrix, reference::flatten(old));
  double largest = 0;
  for (std::size_t i = 0; i < force.size(); ++i)
    largest = std::max(largest, std::abs(dt * force[i] / scene_.world.particles[i / 3].mass));
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double wanted = reference::flatten(predicted)[i] +
                          dt * (k.from_walls[i] - force[i]) / scene_.world.particles[i / 3].mass;
    EXPECT_NEAR(static_cast<double>(xyz(solved.velocity[i / 3])[static_cast<int>(i % 3)]), wanted,
                20 * epsilon * largest);
  }
  EXPECT_EQ(solved.result.iterations, 0);
  EXPECT_GT(largest, 0.5);
}

TEST_P(ViscousStepIn, ReportsTheTrueResidual) {
  for (ViscousSolver solver : every_solver) {
    NumericsSetup n = numerics(solver, 1);
    n.tolerance = 0.05;
    const Solved solved = advance(scene_, n);
    const HostSystem system = assemble(scene_, dt, 1);
    const std::vector<double> chords = reference::along_chords(scene_.world, scene_.world.turn(1));
    double residual = 0, right = 0;
    for (std::size_t i = 0; i < solved.velocity.size(); ++i) {
      const Vec3d b = to_double(xyz(system.right_hand_side[i]));
      const Vec3d turned = dt * Vec3d{chords[3 * i], chords[3 * i + 1], chords[3 * i + 2]};
      const Vec3d r = b - turned - to_double(system.apply(i, solved.velocity));
      residual += dot(r, r), right += dot(b, b);
    }
    EXPECT_NEAR(solved.result.right_hand_side, std::sqrt(right), 1e-6 * std::sqrt(right));
    EXPECT_NEAR(solved.result.residual, std::sqrt(residual),
                0.01 * std::sqrt(residual) + 4 * epsilon * std::sqrt(right));
    if (solver == ViscousSolver::multigrid) continue;  // may stop by the energy of the error instead
    EXPECT_LE(solved.result.residual, 0.05 * lightest(scene_.world) * 9.81 * dt *
                                          std::sqrt(static_cast<double>(solved.velocity.size())));
  }
}

// By whichever test a solver stops, the velocities are as near to the solution as was asked for.
TEST_P(ViscousStepIn, ErrorOfTheVelocitiesIsWithinTheTolerance) {
  const std::vector<double> wanted = exact(scene_, 1);
  for (ViscousSolver solver : every_solver)
    for (const double tolerance : {0.5, 0.05}) {
      NumericsSetup n = numerics(solver, 1);
      n.tolerance = tolerance;
      const Solved solved = advance(scene_, n);
      double squared = 0;
      for (std::size_t i = 0; i < wanted.size(); ++i)
        squared +=
            square(static_cast<double>(xyz(solved.velocity[i / 3])[static_cast<int>(i % 3)]) - wanted[i]);
      EXPECT_LT(std::sqrt(squared / static_cast<double>(solved.velocity.size())), tolerance * 9.81 * dt)
          << "solver " << static_cast<int>(solver);
    }
}

TEST_P(ViscousStepIn, SaysWhenItDidNotConverge) {
  for (ViscousSolver solver : every_solver) {
    NumericsSetup n = numerics(solver, 1);
    n.max_iterations = 2;
    const Solved solved = advance(scene_, n);
    EXPECT_FALSE(solved.result.converged);
    EXPECT_EQ(solved.result.iterations, 2);
    EXPECT_GT(solved.result.residual, 0);
  }
}

// A tolerance below rounding ends at rounding instead of failing.
TEST_P(ViscousStepIn, ConvergesToRoundingWhenAskedForMore) {
  for (ViscousSolver solver : every_solver) {
    NumericsSetup n = numerics(solver, 1);
    n.tolerance = 1e-20;
    const SolveResult result = advance(scene_, n).result;
    EXPECT_TRUE(result.converged) << "solver " << static_cast<int>(solver) << ", residual "
                                  << result.residual / result.right_hand_side;
    EXPECT_LT(result.residual, 10 * epsilon * result.right_hand_side);
  }
}

TEST_P(ViscousStepIn, WarmStartNeedsNoIterations) {
  NumericsSetup n = numerics(ViscousSolver::conjugate_gradient, 1);
  scene_.upload();
  ViscousStep step(scene_.context, n);
  auto once = [&] {
    return step.advance(scene_.pairs(), scene_.rows(), {dt, 9.81 * dt, lightest(scene_.world)},
                        scene_.fluid_list.capacity(), scene_.fluid);
  };
  const int cold = once().iterations;
  EXPECT_GT(cold, 3);
  EXPECT_LT(once().iterations, cold / 2);  // the last digits of a residual at rounding level may need a few
}

TEST_P(ViscousStepIn, ConjugateGradientNeedsFarFewerIterationsThanJacobi) {
  for (auto& p : scene_.world.particles) p.viscosity *= 100;
  NumericsSetup cg = numerics(ViscousSolver::conjugate_gradient, 1),
                other = numerics(ViscousSolver::jacobi, 1);
  cg.tolerance = other.tolerance = 1e-2;
  EXPECT_LT(2 * advance(scene_, cg).result.iterations, advance(scene_, other).result.iterations);
}

INSTANTIATE_TEST_SUITE_P(, ViscousStepIn, testing::ValuesIn(all_scenes()),
                         [](const auto& p) { return scene_name(p.param); });

// Blocks over a floor, stiff enough to move as a whole, from rest.
TEST(Multigrid, IterationsGrowNeitherWithStiffnessNorWithTheNumberOfParticles) {
  int most = 0, fewest = 1000, diagonal_alone = 0;
  for (const int across : {7, 15})
    for (const double viscosity : {1e3, 1e4, 1e5}) {
      Scene scene({3, Surroundings::walls, across, 0.2, 1});
      for (auto& p : scene.world.particles) p.viscosity = viscosity;
      NumericsSetup n = numerics(ViscousSolver::multigrid, 1);
      n.tolerance = 1e-2;
      const Solved loose = advance(scene, n);
      EXPECT_TRUE(loose.result.converged);
      most = std::max(most, loose.result.iterations), fewest = std::min(fewest, loose.result.iterations);
      n.solver = ViscousSolver::conjugate_gradient;
      diagonal_alone = advance(scene, n).result.iterations;
      const Solved tight = advance(scene, numerics(ViscousSolver::conjugate_gradient, 1));
      double squared = 0;
      for (std::size_t i = 0; i < tight.velocity.size(); ++i)
        squared += square(reference::length(to_host(loose.velocity[i]) - to_host(tight.velocity[i])));
      EXPECT_LT(std::sqrt(squared / static_cast<double>(tight.velocity.size())), 1e-2 * 9.81 * dt);
    }
  EXPECT_LE(most, 30);
  EXPECT_LE(most, 2 * fewest);
  EXPECT_GT(diagonal_alone, 2 * most);
}

// A free block of two fluids without forces.
class FreeBlock : public testing::TestWithParam<int> {
 protected:
  FreeBlock() : scene_({GetParam(), Surroundings::free, 6, 0.2, 9}) {
    scene_.flow.gravity = {}, scene_.flow.body_acceleration = {};
    for (auto& p : scene_.world.particles) p.pressure = 0;
  }

  struct Momenta {
    reference::Vec linear, angular;
    double size = 0;
  };
  Momenta momenta(const std::vector<reference::Vec>& velocity) const {
    Momenta m;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      const auto& p = scene_.world.particles[i];
      m.linear = m.linear + p.mass * velocity[i];
      m.angular = m.angular + p.mass * reference::cross(p.x, velocity[i]);
      m.size += p.mass * reference::length(velocity[i]);
    }
    return m;
  }
  static std::vector<reference::Vec> after(const Solved& s) {
    std::vector<reference::Vec> v;
    for (const Quad& q : s.velocity) v.push_back(to_host(q));
    return v;
  }
  std::vector<reference::Vec> before() const {
    std::vector<reference::Vec> v;
    for (const auto& p : scene_.world.particles) v.push_back(p.v);
    return v;
  }

  Scene scene_;
};

TEST_P(FreeBlock, KeepsLinearAndAngularMomentum) {
  scene_.world.way = dt;
  for (double theta : {1.0, 0.5}) {
    const Solved solved = advance(scene_, numerics(ViscousSolver::conjugate_gradient, theta));
    const Momenta old = momenta(before()), now = momenta(after(solved));
    const double arm = 0.06;  // the block's width: angular momentum is judged by size times arm
    EXPECT_LT(reference::length(now.linear - old.linear), 1e-6 * old.size);
    EXPECT_LT(reference::length(now.angular - old.angular), 1e-6 * old.size * arm);
    EXPECT_GT(reference::length(after(solved)[0] - before()[0]), 1e-3) << "viscosity did nothing";
  }
}

// A turn by 0.1 in the step, along chords: tangents would part from them by a twentieth of the velocities.
TEST_P(FreeBlock, KeepsARigidMotion) {
  const Vec3d spin = GetParam() == 3 ? Vec3d{20, -30, 40} : Vec3d{0, 50, 0};
  scene_.world.way = dt;
  spin_along_chords(scene_.world, spin, dt);
  for (ViscousSolver solver : every_solver) {
    const auto now = after(advance(scene_, numerics(solver, 1)));
    // Velocities of 5 m/s rounded to epsilon, which the stiff operator evens out.
    for (std::size_t i = 0; i < now.size(); ++i)
      EXPECT_LT(reference::length(now[i] - scene_.world.particles[i].v), sizeof(Real) == 4 ? 2e-5 : 1e-11);
  }
}

TEST_P(FreeBlock, LosesKineticEnergyByWhatTheShearRateDissipates) {
  for (auto& p : scene_.world.particles)
    p.viscosity = 0.3;  // slow: the mean of old and new rates tells the loss
  const auto now = after(advance(scene_, numerics(ViscousSolver::conjugate_gradient, 1)));
  auto kinetic_and_power = [&](const std::vector<reference::Vec>& v) {
    std::pair<double, double> result;
    for (std::size_t i = 0; i < v.size(); ++i) scene_.world.particles[i].v = v[i];
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto& p = scene_.world.particles[i];
      result.first += 0.5 * p.mass * reference::dot(p.v, p.v);
      result.second += p.volume * p.viscosity * reference::shear_rate_squared(scene_.world, i).value.x;
    }
    return result;
  };
  const auto old = kinetic_and_power(before());
  const auto later = kinetic_and_power(now);
  const double loss = old.first - later.first, power = 0.5 * (old.second + later.second);
  EXPECT_GT(loss, 0.01 * old.first);
  EXPECT_NEAR(loss / (dt * power), 1, 0.1);  // the trapezoidal rule over one step
}

INSTANTIATE_TEST_SUITE_P(, FreeBlock, testing::Values(2, 3),
                         [](const auto& p) { return std::to_string(p.param) + "D"; });

// One stiff pair: its forces act along the line between the two, however that lies to the axes.
TEST(ViscousStep, APairIsSolvedWhateverItsDirectionByEverySolver) {
  for (const reference::Vec line :
       {reference::Vec{1, 0, 0}, reference::Vec{1, 0, 1}, reference::Vec{1, 1, 1}})
    for (ViscousSolver solver : every_solver) {
      Scene scene({3, Surroundings::free, 6, 0, 1});
      scene.flow.gravity = {}, scene.flow.body_acceleration = {};
      auto& p = scene.world.particles;
      p.resize(2);
      p[1].x = p[0].x + Scene::spacing / reference::length(line) * line;
      p[0].v = {}, p[1].v = 0.1 / reference::length(line) * line;
      for (auto& particle : p) particle.viscosity = 1000, particle.pressure = 0;
      NumericsSetup n = numerics(solver, 1);
      n.tolerance = 1e-3;  // of g dt: 2e-5 m/s
      const Solved solved = advance(scene, n);
      const std::vector<double> wanted = exact(scene, 1);
      EXPECT_TRUE(solved.result.converged) << "solver " << static_cast<int>(solver) << ", line z " << line.z;
      const reference::Vec error =
          to_host(solved.velocity[0]) - reference::Vec{wanted[0], wanted[1], wanted[2]};
      EXPECT_LT(reference::length(error), 1e-4)
          << "solver " << static_cast<int>(solver) << ", line z " << line.z;
      EXPECT_GT(wanted[0], 0.02) << "the pair is hardly coupled";
    }
}

// Large enough that threads share the cells of a colour; with an odd ring of cells along x.
TEST(ViscousStep, ThreadsDoNotChangeABit) {
  const int threads = device_info().threads;
  Scene scene({2, Surroundings::periodic, 148, 0.2, 3});
  ASSERT_EQ(CellGrid::cover(scene.setup.domain.upper, {true, false, false}, scene.reach()).count[0] % 2, 1);
  for (ViscousSolver solver : every_solver) {
    NumericsSetup n = numerics(solver, 1);
    n.max_iterations = 6;
    set_threads(1);
    const Solved one = advance(scene, n);
    for (int more : {2, 3}) {
      set_threads(more);
      const Solved again = advance(scene, n);
      EXPECT_EQ(std::memcmp(one.velocity.data(), again.velocity.data(), one.velocity.size() * sizeof(Quad)),
                0)
          << "solver " << static_cast<int>(solver) << ", " << more << " threads";
    }
  }
  set_threads(threads);
}

TEST(ViscousStep, WorksWithoutParticles) {
  Scene scene({3, Surroundings::walls, 3, 0.2, 1});
  scene.world.particles.clear();
  const Solved solved = advance(scene, [] {
    NumericsSetup n;
    return n;
  }());
  EXPECT_TRUE(solved.velocity.empty());
  EXPECT_TRUE(solved.result.converged);
}

}  // namespace
}  // namespace slagflow
