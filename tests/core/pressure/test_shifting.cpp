// Particle shifting against the oracle.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "pressure/shifting.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double amount = 0.3, dt = 1e-3;

struct Crowding {
  reference::Vec gradient;    // of the concentration [1/m]
  double fill = 0, size = 0;  // T; sum of the sizes of the gradient's terms [1/m]
  double wall = 1e30;         // distance of the nearest wall particle [m]
};

// (1/r) dW/dr of W = s (1 - q^2)^18, s by its integral over the support.
double steep_slope(const reference::World& w, double r) {
  const double h = w.support, q2 = square(r / h);
  double integral = 0;
  constexpr int steps = 500;
  for (int k = 0; k < steps; ++k) {
    const double q = (k + 0.5) / steps;
    integral += std::pow(1 - q * q, 18) * (w.dimensions == 2 ? 2 * q : 4 * q * q) * 3.14159265358979 / steps;
  }
  return q2 < 1 ? -36 * std::pow(1 - q2, 17) / (integral * std::pow(h, w.dimensions + 2)) : 0;
}

Crowding crowding(const reference::World& w, std::size_t i) {
  Crowding result;
  auto pair = [&](reference::Vec d, double volume) {
    const double r = reference::length(d), steep = volume * steep_slope(w, r);
    result.gradient = result.gradient + steep * d;
    result.fill -= volume * reference::slope_over_distance(w, r) * r * r / w.dimensions;
    result.size -= steep * r;
  };
  reference::for_fluid_pairs(w, i,
                             [&](const reference::Particle& j, reference::Vec d) { pair(d, j.volume); });
  reference::for_wall_pairs(w, i, [&](const reference::Wall&, reference::Vec d) {
    pair(d, w.wall_volume());
    result.wall = std::min(result.wall, reference::length(d));
  });
  return result;
}

// How far each particle goes, in the order of the world. `rate`: its shear rate [1/s].
template <class Rate>
std::vector<Vec3d> shifts(Scene& scene, Rate rate) {
  scene.upload();
  const auto n = static_cast<std::size_t>(scene.fluid.count);
  std::vector<Index> id;
  scene.fluid.id.download(id);
  std::vector<Real> rates(n);
  for (std::size_t k = 0; k < n; ++k) rates[k] = static_cast<Real>(rate(static_cast<std::size_t>(id[k])));
  Buffer<Real> shear_rate(scene.context, "rates");
  shear_rate.upload(rates);
  const std::vector<Vec3d> before = scene.by_id(Span<const Vec3d>(scene.fluid.position.span()));
  shift_particles(scene.context, scene.pairs(),
                  {static_cast<Real>(amount), static_cast<Real>(dt), shear_rate.span()},
                  scene.fluid.position.span());
  std::vector<Vec3d> after = scene.by_id(Span<const Vec3d>(scene.fluid.position.span()));
  for (std::size_t i = 0; i < n; ++i) after[i] -= before[i];
  return after;
}

class Shifting : public testing::TestWithParam<SceneOptions> {
 protected:
  Scene scene_{GetParam()};
};

TEST_P(Shifting, MatchesOracle) {
  for (auto& p : scene_.world.particles) p.fluid = 0;
  auto rate = [](std::size_t i) { return static_cast<double>(i % 5) * 30; };  // amount x 0.12 in the step
  const std::vector<Vec3d> shift = shifts(scene_, rate);
  const reference::World& w = scene_.world;
  int moved = 0, kept = 0;
  for (std::size_t i = 0; i < shift.size(); ++i) {
    const Crowding c = crowding(w, i);
    auto ramp = [](double x) { return std::min(1.0, std::max(0.0, x)); };
    const double share = ramp((c.fill - 0.92) / 0.05) * ramp(c.wall / Scene::spacing - 1);
    const reference::Particle& p = w.particles[i];
    const double inertia = p.mass / p.volume * rate(i) * square(w.support) / p.viscosity;
    const double factor = square(w.support) * std::min(amount * rate(i) * dt, 0.024) / (1 + inertia / 20);
    const double rounding = 100 * epsilon * factor * c.size * (1 + c.fill / 0.05);
    EXPECT_NEAR(shift[i].x, -factor * share * c.gradient.x, rounding) << i;
    EXPECT_NEAR(shift[i].y, -factor * share * c.gradient.y, rounding) << i;
    EXPECT_NEAR(shift[i].z, -factor * share * c.gradient.z, rounding) << i;
    moved += share * rate(i) > 0, kept += share * rate(i) == 0;
  }
  EXPECT_GT(kept, 0);
  if (GetParam().surroundings != Surroundings::free) {
    EXPECT_GT(moved, 0);
  }
}

TEST_P(Shifting, MovesNothingWithoutShear) {
  for (const Vec3d shift : shifts(scene_, [](std::size_t) { return 0.0; })) EXPECT_EQ(norm(shift), 0);
}

INSTANTIATE_TEST_SUITE_P(, Shifting, testing::ValuesIn(all_scenes()),
                         [](const auto& p) { return scene_name(p.param); });

// Two particles that are close in an even lattice part, and go by as much.
TEST(ShiftingInALattice, PartsAPairAndLeavesTheRest) {
  Scene scene({3, Surroundings::free, 9, 0, 1});
  auto& particles = scene.world.particles;
  for (auto& p : particles) p.volume = 1e-6, p.fluid = 0, p.viscosity = 1000;
  const std::size_t left = 4 + 9 * (4 + 9 * 4), right = left + 1, corner = 0;
  particles[left].x.x += 0.3 * Scene::spacing, particles[right].x.x -= 0.3 * Scene::spacing;
  const std::vector<Vec3d> shift = shifts(scene, [](std::size_t) { return 50.0; });
  EXPECT_LT(shift[left].x, -1e-3 * Scene::spacing);
  EXPECT_NEAR(shift[right].x, -shift[left].x, 1e-5 * Scene::spacing);
  EXPECT_EQ(norm(shift[corner]), 0);
}

// A particle keeps its place where another fluid is within reach of it.
TEST(ShiftingInALattice, LeavesThePlacesNextToAnotherFluid) {
  Scene scene({2, Surroundings::periodic, 12, 0.2, 3});
  auto& w = scene.world;
  const double middle = 0.5 * (w.particles.front().x.x + w.particles.back().x.x);
  for (auto& p : w.particles) p.fluid = p.x.x < middle;
  const std::vector<Vec3d> shift = shifts(scene, [](std::size_t) { return 50.0; });
  int kept = 0, moved = 0;
  for (std::size_t i = 0; i < shift.size(); ++i) {
    bool meets = false;
    reference::for_fluid_pairs(w, i, [&](const reference::Particle& j, reference::Vec d) {
      meets = meets || (j.fluid != w.particles[i].fluid && reference::length(d) < w.support);
    });
    EXPECT_TRUE(!meets || norm(shift[i]) == 0) << i;
    kept += meets, moved += norm(shift[i]) > 0;
  }
  EXPECT_GT(kept, 10);
  EXPECT_GT(moved, 10);
}

}  // namespace
}  // namespace slagflow
