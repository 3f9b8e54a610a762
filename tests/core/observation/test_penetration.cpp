// Which fluid particles are below faces of walls: particles placed by hand. Lengths in spacings dx.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/simulation_setups.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

SimulationSetup empty() {
  SimulationSetup s = empty_setup({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  s.gravity = {};
  return s;
}

// Particles at these places [dx]; those that are found, sorted along z and then x [dx].
std::vector<Vec3d> found(SimulationSetup s, const std::vector<Vec3d>& places) {
  for (const Vec3d& p : places) add_particle(s, dx * p, {}, 0);
  std::vector<Vec3d> result = Simulation(s).below_wall_faces();
  for (Vec3d& p : result) p = (1 / dx) * p;
  std::sort(result.begin(), result.end(),
            [](Vec3d a, Vec3d b) { return a.z != b.z ? a.z < b.z : a.x < b.x; });
  return result;
}

void expect_same(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(norm(a[i] - b[i]), 1e-9) << i;
}

// Sites of three layers around the origin; `normal_of` gives the face of a site, or a depth <= 0 for none.
template <class Face>
void add_walls(SimulationSetup& s, const Face& face) {
  for (int k = -5; k < 5; ++k)
    for (int j = -5; j < 5; ++j)
      for (int i = -5; i < 5; ++i) {
        const Vec3d x{i + 0.5, j + 0.5, k + 0.5};
        const auto [normal, depth] = face(x);
        if (depth > 0 && depth < 3) add_wall(s, dx * x, normal, dx * depth);
      }
}

std::pair<Vec3d, double> floor_face(Vec3d x) { return {{0, 0, 1}, -x.z}; }

TEST(BelowFaces, FindsParticlesInAFloorFromTheSurfaceToBehindItsLastLayer) {
  SimulationSetup s = empty();
  add_walls(s, floor_face);
  const std::vector<Vec3d> deep{{-3.5, 0.5, -4.5}, {2.2, 0.1, -2}, {-0.6, 0.5, -0.6}, {0.3, 2, -0.1}};
  std::vector<Vec3d> all = deep;
  for (const double z : {0.05, 0.3, 1.2, 2.5, 6.0}) all.push_back({-2, -2, z});
  expect_same(found(s, all), deep);
}

TEST(BelowFaces, FindsNoneBesideTheFacesOfACorner) {
  SimulationSetup s = empty();
  add_walls(s, [](Vec3d x) -> std::pair<Vec3d, double> {
    return x.x < 0 && x.z > x.x ? std::pair{Vec3d{1, 0, 0}, -x.x} : floor_face(x);
  });
  const std::vector<Vec3d> deep{{-0.6, 0, -0.7}, {0.7, 0, -0.6}, {-0.6, 0, 0.7}};
  std::vector<Vec3d> all = deep;
  for (const Vec3d p : {Vec3d{0.1, 0, 0.1}, Vec3d{0.05, 0, 2}, Vec3d{2, 0, 0.05}}) all.push_back(p);
  expect_same(found(s, all), deep);
}

TEST(BelowFaces, FindsThoseInsideOfAThinPlateAndNoneBesideIt) {
  SimulationSetup s = empty();
  for (int j = -5; j < 5; ++j)
    for (int i = -5; i < 5; ++i) {
      add_wall(s, dx * Vec3d{i + 0.5, j + 0.5, 0.5}, {0, 0, 1}, 0.5 * dx);
      s.walls.back_normal.push_back({0, 0, -1}), s.walls.back_depth.push_back(0.5 * dx);
    }
  expect_same(found(s, {{0, 0, -0.2}, {2, 1, 0.4}, {-2, 0.3, 0.9}, {1, 1, 1.1}}),
              {{2, 1, 0.4}, {-2, 0.3, 0.9}});
}

TEST(BelowFaces, FindsThoseInsideOfARod) {
  SimulationSetup s = empty();
  const double radius = 3;  // along y
  add_walls(s, [&](Vec3d x) -> std::pair<Vec3d, double> {
    const double r = std::hypot(x.x, x.z);
    return {Vec3d{x.x / r, 0, x.z / r}, radius - r};
  });
  std::vector<Vec3d> all, inside;
  for (int k = 0; k < 24; ++k) {
    const Vec3d way{std::cos(0.2618 * k + 0.1), 0, std::sin(0.2618 * k + 0.1)};
    all.push_back(3.3 * way), all.push_back(2.4 * way);
    inside.push_back(2.4 * way);
  }
  std::sort(inside.begin(), inside.end(),
            [](Vec3d a, Vec3d b) { return a.z != b.z ? a.z < b.z : a.x < b.x; });
  expect_same(found(s, all), inside);
}

TEST(BelowFaces, LooksAcrossAPeriodicFace) {
  SimulationSetup s = empty();
  s.domain.periodic = {true, false, false};
  add_walls(s, [](Vec3d x) { return x.x > -5 && x.x < 0 ? floor_face(x) : std::pair{Vec3d{}, 0.0}; });
  for (std::size_t i = 0; i < s.walls.position.size(); ++i)
    if (s.walls.position[i].x < -4 * dx) s.walls.position[i].x += 14 * dx;  // the last before the face +x
  expect_same(found(s, {{-9.9, 0.2, -0.6}}), {{-9.9, 0.2, -0.6}});
}

TEST(Simulation, CountsItsParticles) {
  SimulationSetup s = empty();
  EXPECT_TRUE(Simulation(s).below_wall_faces().empty());
  for (int k = 0; k < 3; ++k) add_particle(s, {0.01 * k, 0, 0}, {}, 0);
  EXPECT_EQ(Simulation(s).particles(), 3);
}

}  // namespace
}  // namespace slagflow
