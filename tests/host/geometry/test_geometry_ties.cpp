// Sites that lie on a face of a wall, but for rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "host/case/case.hpp"
#include "host/geometry/setup_builder.hpp"

namespace slagflow {
namespace {

// A slope of 45 degrees through sites, cut off at its lower end: rounding puts some of the sites before the
// slope, where the cut would be the only face they know of.
TEST(GeometryTies, ASlopeThroughSitesTakesAllOfThemWithItsOwnNormal) {
  const SimulationSetup setup = build_setup(parse_case(R"(
[case]
name = "slope"
[resolution]
spacing = 0.002
dimensions = 2
[fluid.oil]
density = 1000
rheology = "newtonian"
dynamic_viscosity = 0.1
[[region]]
shapes = [{shape = "box", min = [0.012, -1, 0.03], max = [0.02, 1, 0.04]}]
[[wall]]
name = "slope"
shapes = [{shape = "plane", point = [0.008, 0, 0], normal = [-1, 0, 1]}]
subtract = [{shape = "box", min = [-10, -1, -1], max = [0.008, 1, 1]}]
[domain]
min = [-0.12, -1, -0.1]
max = [0.12, 1, 0.16]
[output]
end_time = 0.01
)",
                                                       "case.toml"))
                                    .setup;
  const Vec3d normal{-std::sqrt(0.5), 0, std::sqrt(0.5)};
  int on_slope = 0;
  for (std::size_t i = 0; i < setup.walls.position.size(); ++i) {
    const Vec3d x = setup.walls.position[i];
    if (std::fabs(dot(x - Vec3d{0.008, 0, 0}, normal)) > 1e-6) continue;
    ++on_slope;
    EXPECT_NEAR(dot(setup.walls.normal[i], normal), 1, 1e-6) << "at " << x.x << ", " << x.z;
    EXPECT_LT(setup.walls.depth[i], 0.01 * setup.spacing);
  }
  EXPECT_GT(on_slope, 50);
}

}  // namespace
}  // namespace slagflow
