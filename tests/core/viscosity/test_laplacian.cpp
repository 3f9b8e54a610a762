// The viscous step with the plain Laplacian, as the paper has it, against sums over all pairs.
#include <gtest/gtest.h>

#include "core/viscous_scene.hpp"
#include "reference_viscous.hpp"
#include "viscosity/viscous.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double dt = 2e-3;

struct Scheme {
  double theta;
  ExplicitPart explicit_part;
  ViscousSolver solver;
};

// (K v)_i = sum_j w_ij (v_i - v_j),  w_ij = 2 C eta_ij V_i V_j w(r) r^2: one matrix for all components.
struct Laplacian {
  explicit Laplacian(const reference::World& w) : matrix(w.particles.size()), from_walls(w.particles.size()) {
    const auto weight = [&](double eta, double volumes, reference::Vec d) {
      const double r = reference::length(d);
      return 2 * w.correction * eta * volumes * reference::viscous_weight(w, r) * r * r;
    };
    for (std::size_t i = 0; i < w.particles.size(); ++i) {
      const reference::Particle& p = w.particles[i];
      for (std::size_t j = 0; j < w.particles.size(); ++j)
        if (j != i)
          reference::for_images(w, p.x, w.particles[j].x, w.support, [&](reference::Vec d) {
            const reference::Particle& o = w.particles[j];
            const double sum = p.viscosity + o.viscosity, product = p.viscosity * o.viscosity;
            const double s = weight(p.fluid == o.fluid ? sum / 2 : 2 * product / sum, p.volume * o.volume, d);
            matrix(i, i) += s, matrix(i, j) -= s;
          });
      reference::for_wall_pairs(w, i, [&](const reference::Wall& o, reference::Vec d) {
        if (!o.sticks) return;
        const double s =
            reference::no_slip_factor(w, o, d) * weight(p.viscosity, p.volume * w.wall_volume(), d);
        matrix(i, i) += s, from_walls[i] = from_walls[i] + s * o.v;
      });
    }
  }

  reference::Vec times(std::size_t i, const std::vector<reference::Vec>& v) const {
    reference::Vec sum;
    for (std::size_t j = 0; j < v.size(); ++j) sum = sum + matrix(i, j) * v[j];
    return sum;
  }

  reference::Dense matrix;
  std::vector<reference::Vec> from_walls;
};

// m u + theta dt K u = m u* + dt K_wall u_wall - (1 - theta) dt K e, by components.
std::vector<reference::Vec> solution(const reference::World& w, const std::vector<reference::Vec>& predicted,
                                     const Scheme& scheme) {
  const Laplacian k(w);
  const std::size_t n = predicted.size();
  std::vector<reference::Vec> acted_on;
  for (std::size_t i = 0; i < n; ++i)
    acted_on.push_back(scheme.explicit_part == ExplicitPart::predicted ? predicted[i] : w.particles[i].v);
  reference::Dense a(n);
  std::vector<double> b[3];
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) a(i, j) = scheme.theta * dt * k.matrix(i, j);
    a(i, i) += w.particles[i].mass;
    const reference::Vec right = w.particles[i].mass * predicted[i] + dt * k.from_walls[i] -
                                 (1 - scheme.theta) * dt * k.times(i, acted_on);
    b[0].push_back(right.x), b[1].push_back(right.y), b[2].push_back(right.z);
  }
  for (auto& component : b) component = reference::solve_cholesky(a, component);
  std::vector<reference::Vec> u;
  for (std::size_t i = 0; i < n; ++i) u.push_back({b[0][i], b[1][i], b[2][i]});
  return u;
}

class LaplacianIn : public testing::TestWithParam<SceneOptions> {};

TEST_P(LaplacianIn, StepMatchesADenseSolve) {
  for (const Scheme scheme : {Scheme{1, ExplicitPart::old_velocity, ViscousSolver::multigrid},
                              Scheme{0.5, ExplicitPart::old_velocity, ViscousSolver::conjugate_gradient},
                              Scheme{0.5, ExplicitPart::predicted, ViscousSolver::sor}}) {
    Scene scene(GetParam());
    NumericsSetup& n = scene.setup.numerics;
    n.viscous_operator = ViscousOperator::laplacian, n.theta = scheme.theta;
    n.explicit_part = scheme.explicit_part, n.solver = scheme.solver;
    n.tolerance = sizeof(Real) == 4 ? 1e-4 : 1e-9, n.max_iterations = 4000;
    scene.flow = flow_constants(scene.setup), scene.world.correction = viscosity_correction(scene.setup);
    for (auto& wall : scene.world.walls) wall.v = {0.3, 0, -0.1};
    std::vector<reference::Vec> predicted;
    for (const Quad& q : assemble(scene, dt, scheme.theta).predicted) predicted.push_back(to_host(q));
    ViscousStep step(scene.context, n);
    double mass = 1e300;
    for (const auto& p : scene.world.particles) mass = std::min(mass, p.mass);
    const SolveResult result = step.advance(scene.pairs(), scene.rows(), {dt, 9.81 * dt, mass},
                                            scene.fluid_list.capacity(), scene.fluid);
    const std::vector<Quad> velocity = scene.by_id(step.velocity());
    const std::vector<reference::Vec> wanted = solution(scene.world, predicted, scheme);
    double squared = 0, size = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const reference::Vec error = to_host(velocity[i]) - wanted[i];
      squared += reference::dot(error, error), size += reference::dot(wanted[i], wanted[i]);
    }
    // As for the radial operator in test_viscous.cpp.
    EXPECT_LT(std::sqrt(squared / size), sizeof(Real) == 4 ? 2e-5 : 1e-9) << "theta " << scheme.theta;
    EXPECT_TRUE(result.converged);
    EXPECT_GT(result.iterations, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(, LaplacianIn, testing::ValuesIn(all_scenes()),
                         [](const auto& p) { return scene_name(p.param); });

}  // namespace
}  // namespace slagflow
