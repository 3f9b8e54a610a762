// How thick the sheets are that particles are in.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "fluid/motion.hpp"
#include "observation/sheets.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr int across = 15;
constexpr double spacing = Scene::spacing, middle = across / 2.0 * spacing;
constexpr double kept_radius = 7.2 * spacing;  // what is kept of the block turns without leaving the domain

// What of a block lies in a body about its middle, turned.
struct Cut : Scene {
  template <class Inside>
  Cut(int dimensions, double jitter, Vec3d turn, Inside inside)
      : Scene({dimensions, Surroundings::free, across, jitter, 3}) {
    std::vector<reference::Particle> kept;
    for (auto p : world.particles) {
      Vec3d x{p.x.x - middle, dimensions == 3 ? p.x.y - middle : 0, p.x.z - middle};
      if (norm(x) > kept_radius || !inside(x)) continue;
      x = rotation(turn) * x;
      p.x = {middle + x.x, dimensions == 3 ? middle + x.y : p.x.y, middle + x.z};
      kept.push_back(p);
    }
    world.particles = kept;
    upload();
  }
};

// [spacings], of particles in the middle: at the rim of a sheet the direction of least spread is another.
std::vector<double> thickness(Scene& scene) {
  SheetThickness sheets(scene.context);
  const std::vector<Real> all = scene.by_id(sheets.measure(scene.pairs()).span());
  std::vector<double> result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const reference::Vec x = scene.world.particles[i].x;
    const double across_plane = scene.world.dimensions == 3 ? x.y - middle : 0;
    if (norm(Vec3d{x.x - middle, across_plane, x.z - middle}) < 1.8 * spacing)
      result.push_back(static_cast<double>(all[i]) / spacing);
  }
  return result;
}

std::int64_t thin(Scene& scene) {
  DiagnosticScratch scratch(scene.context);
  GatheredSums sums(scene.context, scratch);
  SheetThickness sheets(scene.context);
  std::int64_t count = 0;
  sheets.count_thin(scene.pairs(), sums, count);
  sums.read();
  return count;
}

class Sheets : public testing::TestWithParam<int> {
 protected:
  Vec3d turn() const { return GetParam() == 3 ? Vec3d{0.4, 0.7, -0.3} : Vec3d{0, 0.7, 0}; }
};

// Layers of a lattice lie at whole spacings from its middle. Five fill the support radius: any direction will
// do.
TEST_P(Sheets, OfOneToFiveLayersAreAsThickAsThat) {
  for (int layers = 1; layers <= 5; layers += 2) {
    Cut scene(GetParam(), 0, turn(), [&](Vec3d x) { return std::abs(x.z) < layers / 2.0 * spacing; });
    const auto count = static_cast<std::int64_t>(scene.world.particles.size());
    ASSERT_GT(count, 10);
    for (const double t : thickness(scene)) EXPECT_NEAR(t, layers, layers < 5 ? 1e-4 : 1);
    EXPECT_EQ(thin(scene), layers < 3 ? count : 0);
  }
}

TEST_P(Sheets, InDisorderAreAsThickAsThatToTheDisorder) {
  Cut two(GetParam(), 0.1, turn(), [&](Vec3d x) { return x.z > -0.7 * spacing && x.z < 1.3 * spacing; });
  for (const double t : thickness(two)) EXPECT_NEAR(t, 2, 0.45);
  EXPECT_EQ(thin(two), static_cast<std::int64_t>(two.world.particles.size()));
  Cut four(GetParam(), 0.1, turn(), [&](Vec3d x) { return x.z > -1.7 * spacing && x.z < 2.3 * spacing; });
  for (const double t : thickness(four)) EXPECT_NEAR(t, 4, 0.7);
  EXPECT_EQ(thin(four), 0);
}

// Particles at the surface see half of what is there, those further in all that the support radius shows.
TEST_P(Sheets, AThickBodyIsThickUpToItsSurface) {
  Cut scene(GetParam(), 0.1, turn(), [](Vec3d) { return true; });
  for (const double t : thickness(scene)) EXPECT_GT(t, 3.5);
  EXPECT_EQ(thin(scene), 0);
}

TEST_P(Sheets, ThreadsAndDropsCountAsWell) {
  Cut thread(GetParam(), 0, turn(), [](Vec3d x) { return std::hypot(x.y, x.z) < 1.1 * spacing; });
  for (const double t : thickness(thread)) EXPECT_NEAR(t, 3, 0.3);
  Cut alone(GetParam(), 0, turn(), [](Vec3d x) { return norm(x) < 0.5 * spacing; });
  ASSERT_EQ(alone.world.particles.size(), 1U);
  EXPECT_NEAR(thickness(alone)[0], 1, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(, Sheets, testing::Values(2, 3),
                         [](const auto& p) { return std::to_string(p.param) + "D"; });

TEST(LeastAxis, IsTheEigenvectorOfTheSmallestEigenvalue) {
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const Rotation turn = rotation(random.vector(2));
    const double values[3] = {random.uniform(0.1, 1), random.uniform(1, 2), k % 3 == 0 ? 1 : 2.5};
    const Vec3d axes[3] = {turn * Vec3d{1, 0, 0}, turn * Vec3d{0, 1, 0}, turn * Vec3d{0, 0, 1}};
    Symmetric3 a;
    for (int axis = 0; axis < 3; ++axis) a.add_outer(static_cast<Real>(values[axis]), to_real(axes[axis]));
    const Vec3d found = to_double(least_axis(a));
    EXPECT_NEAR(norm(found), 1, 20 * epsilon);
    // Where two eigenvalues are close the axis between theirs is as good: what counts is the value.
    EXPECT_NEAR(dot(found, to_double(a * to_real(found))), values[0], 20 * epsilon) << "matrix " << k;
  }
  const Vec3d none = to_double(least_axis({}));
  EXPECT_NEAR(norm(none), 1, epsilon);
}

}  // namespace
}  // namespace slagflow
