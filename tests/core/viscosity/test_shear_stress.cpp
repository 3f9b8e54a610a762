// The viscous stress of particles against the oracle and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/viscous_scene.hpp"
#include "viscosity/shear_stress.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

// |tau_i|, and the sum of the sizes of what it is made of.
struct Stress {
  double value = 0, size = 0;
};

Stress oracle(const reference::World& w, std::size_t i) {
  const reference::Particle& p = w.particles[i];
  std::array<std::array<double, 3>, 3> sigma{};
  Stress result;
  auto pair = [&](reference::Vec apart, reference::Vec d, double eta, double volume,
                  reference::Vec velocity) {
    const double r2 = dot(d, d);
    const double weight = w.correction * (w.dimensions + 2) * eta * volume *
                          reference::viscous_weight(w, reference::length(apart));
    const double force = weight * dot(p.v - velocity, d);
    const std::array<double, 3> x{d.x, d.y, d.z};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) sigma[a][b] += force * x[a] * x[b];
    result.size += weight * reference::length(p.v - velocity) * std::pow(r2, 1.5);
  };
  reference::for_fluid_pairs(w, i, [&](const reference::Particle& j, reference::Vec d) {
    const double mean =
        p.fluid == j.fluid ? (p.viscosity + j.viscosity) / 2 : 2 / (1 / p.viscosity + 1 / j.viscosity);
    pair(d, w.half_way(p, j, d), mean, j.volume, j.v);
  });
  reference::for_wall_pairs(w, i, [&](const reference::Wall& j, reference::Vec d) {
    if (j.sticks) pair(d, d, p.viscosity, reference::no_slip_factor(w, j, d) * w.wall_volume(), j.v);
  });
  const double mean = (sigma[0][0] + sigma[1][1] + sigma[2][2]) / w.dimensions;
  double squares = 0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) squares += square(sigma[a][b]);
  // In two dimensions the mean is that of the two axes in the plane.
  result.value = std::sqrt(std::max(0.0, (squares - w.dimensions * square(mean)) / 2));
  return result;
}

constexpr double way = 2e-3;  // [s] that the particles have come

std::vector<Real> stresses(Scene& scene) {
  scene.upload();
  Buffer<Real> stress(scene.context, "stress", scene.fluid.count);
  measure_shear_stress(scene.context, scene.pairs(), static_cast<Real>(-scene.world.way), stress.span());
  return scene.by_id(Span<const Real>(stress.span()));
}

class ShearStress : public testing::TestWithParam<SceneOptions> {};

TEST_P(ShearStress, MatchesOracle) {
  Scene scene(GetParam());
  scene.world.way = -way;
  for (auto& wall : scene.world.walls) wall.v = {0.2, 0, -0.1};
  const std::vector<Real> stress = stresses(scene);
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const Stress expected = oracle(scene.world, i);
    // The root of a difference of squares: what is lost in it counts where little is left.
    EXPECT_NEAR(static_cast<double>(stress[i]), expected.value, 100 * epsilon * expected.size)
        << "particle " << i;
  }
}

TEST_P(ShearStress, IsZeroInARigidMotion) {
  Scene scene(GetParam());
  scene.world.walls.clear();
  scene.world.period = {};  // a rotation does not fit into a periodic box
  scene.box = {};
  scene.world.way = -way;
  spin_along_chords(scene.world, scene.world.dimensions == 3 ? Vec3d{20, -30, 40} : Vec3d{0, 50, 0}, -way);
  for (auto& p : scene.world.particles) p.viscosity = 1;
  for (const Real value : stresses(scene)) EXPECT_LT(static_cast<double>(value), 10000 * epsilon);
}

INSTANTIATE_TEST_SUITE_P(, ShearStress, testing::ValuesIn(all_scenes()),
                         [](const auto& p) { return scene_name(p.param); });

// A stress that grows evenly through a lattice, eta u' = (1 + 10 z) Pa with z in m from the middle, under an
// even shear and under one that grows: up to the lattice's factor, that of a uniform shear, both tell 1 Pa.
// The viscosity of the second is curved, and the mean of two of its points is beside the one between them, by
// 18.75 z^2 + 4219 z^4 of a pair.
double wanted_ratio(double slope) {
  double sums[2] = {0, 0};
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const reference::Vec d = Scene::spacing * reference::Vec{double(i), double(j), double(k)};
        const double weight = reference::lattice_weight(reference::length(d), 2.6 * Scene::spacing, 3);
        for (const int which : {0, 1}) {
          const double s = which * slope, z = d.z;
          const double mean = (0.5 + (1 + 10 * z) / (2 + s * z)) / 2;
          sums[which] += weight * d.x * d.x * z * mean * (2 * z + s * z * z / 2);
        }
      }
  return sums[1] / sums[0];
}

TEST(ShearStressOnALattice, OfALinearStressIsThatStress) {
  Scene scene({3, Surroundings::free, 9, 0, 1});
  const double middle = 4.5 * Scene::spacing;
  double uniform = 0;
  for (const double slope : {0.0, 30.0}) {
    for (auto& p : scene.world.particles) {
      const double z = p.x.z - middle;
      p.v = {2 * z + slope * z * z / 2, 0, 0}, p.fluid = 0, p.excess = 0, p.mass = 9e-4, p.volume = 1e-6;
      p.viscosity = (1 + 10 * z) / (2 + slope * z);
    }
    const auto stress = stresses(scene);
    const double centre = static_cast<double>(stress[4 + 9 * (4 + 9 * 4)]);
    if (slope == 0)
      uniform = centre;
    else
      EXPECT_NEAR(centre / uniform, wanted_ratio(slope), 1e-4);
  }
  EXPECT_NEAR(uniform, viscosity_correction(scene.setup) * 0.998, 0.002);
}

}  // namespace
}  // namespace slagflow
