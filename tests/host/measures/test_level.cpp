// The measure `level`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/setup_builder.hpp"
#include "host/measures/measures.hpp"
#include "observation/measures.hpp"

namespace slagflow {
namespace {

ProfilePoint at(double distance, double fill) {
  ProfilePoint p;
  p.distance = distance, p.fill = fill;
  return p;
}

TEST(LevelOf, IsTheFarthestHalfAndTheLengthAbove) {
  const LevelState one = level_of({at(0, 0.6), at(1, 1), at(2, 0.75), at(3, 0.25), at(4, 0)});
  EXPECT_DOUBLE_EQ(one.surface, 2.5);
  EXPECT_DOUBLE_EQ(one.thickness, 2.5);
  const LevelState two = level_of({at(0, 0), at(1, 1), at(2, 0), at(3, 0.5), at(4, 1)});
  EXPECT_DOUBLE_EQ(two.surface, 4);
  EXPECT_DOUBLE_EQ(two.thickness, 1 + 1);
  const LevelState none = level_of({at(0, 0.4), at(1, 0)});
  EXPECT_TRUE(std::isnan(none.surface));
  EXPECT_DOUBLE_EQ(none.thickness, 0);
}

// A tank 12 deep of spacing 0.01; a line into it from above, and one beside it.
TEST(LevelMeasure, TellsTheDepthOfATank) {
  const Case c = parse_case(R"(
[case]
name = "tank"
[resolution]
spacing = 0.01
dimensions = 2
[fluid.oil]
density = 1000
rheology = "newtonian"
dynamic_viscosity = 1
[[region]]
shapes = [{shape="box", min=[0, -1, 0], max=[0.2, 1, 0.12]}]
[[wall]]
name = "tank"
shapes = [{shape="box", min=[0, -1, 0], max=[0.2, 1, 1], outside=true}]
[domain]
min = [-0.03, -1, -0.03]
max = [0.5, 1, 0.3]
[output]
end_time = 1
[[measure]]
name = "depth"
type = "level"
start = [0.1, 0, 0]
end = [0.1, 0, 0.25]
[[measure]]
name = "beside"
type = "level"
start = [0.4, 0, 0]
end = [0.4, 0, 0.25]
)",
                            "tank.toml");
  const BuiltCase built = build_setup(c);
  Measures measures(c, built.setup);
  Simulation simulation(built.setup);
  const auto read = []() -> const FluidSnapshot& {
    static const FluidSnapshot none;
    return none;
  };
  const std::vector<double> values = measures.update(0, simulation.totals(), read);
  EXPECT_EQ(measures.columns(), (std::vector<std::string>{"depth_surface_m", "depth_thickness_m",
                                                          "beside_surface_m", "beside_thickness_m"}));
  EXPECT_NEAR(values[0], 0.12, 0.0005);
  EXPECT_NEAR(values[1], 0.12, 0.001);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_DOUBLE_EQ(values[3], 0);
  EXPECT_THAT(measures.lines()[0], testing::StartsWith("depth (level): surface at 0.12"));
  EXPECT_EQ(measures.lines()[1], "beside (level): no fluid came to it");
  Measures again(c, built.setup);
  again.restore(measures.state());
  EXPECT_EQ(again.lines(), measures.lines());
}

}  // namespace
}  // namespace slagflow
