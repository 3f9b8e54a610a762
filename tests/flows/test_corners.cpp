// Fluid at rest in corners of walls that do not follow the lattice.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

// Of a depth of fluid [m].
void expect_rest(const std::vector<std::string>& overrides, double depth) {
  Flow flow("verification/trough.toml", overrides);
  ASSERT_NO_THROW(flow.run(0.5));
  const double hydrostatic = 1000 * g * depth;
  double fastest = 0, least = hydrostatic, most = 0;
  flow.run(1, [&] {
    const Totals t = flow.simulation().totals();
    fastest = std::max(fastest, t.max_speed);
    least = std::min(least, t.contacts[0].largest_pressure),
    most = std::max(most, t.contacts[0].largest_pressure);
    return false;
  });
  std::printf("fastest %.4f m/s, largest pressure %.0f to %.0f of %.0f Pa\n", fastest, least, most,
              hydrostatic);
  EXPECT_LT(fastest, 0.005);
  EXPECT_GT(least, 0.85 * hydrostatic);  // the lowest fluid lies above the edge
  EXPECT_LT(most, 1.02 * hydrostatic);
}

std::vector<std::string> trough_of(double half_width) {
  const std::string x = std::to_string(half_width);
  return {"wall.0.subtract=[{shape=\"prism\", along=\"y\", points=[[0,0],[" + x + ",0.2],[-" + x +
          ",0.2]], from=-1, to=1}]"};
}

TEST(Corners, FluidRestsInATroughOfAnyOpening) {
  for (const double half_width : {0.1, 0.1155, 0.15, 0.2, 0.22, 0.27})
    expect_rest(trough_of(half_width), 0.15);
}

TEST(Corners, FluidRestsInATroughWhereverTheLatticeIs) {
  for (const char* origin : {"0.0025", "0.005", "0.001"})
    expect_rest({"resolution.origin=[" + std::string(origin) + ",0,0]"}, 0.15);
}

// The corner of a box of 0.2 m that is turned by 45 degrees lies 0.0707 m below its middle.
TEST(Corners, FluidRestsInATurnedTank) {
  const auto turned = [](const std::string& box, double angle) {
    return "[{shape=\"box\"," + box + ",rotate=[0," + std::to_string(angle) + ",0]}]";
  };
  for (const double angle : {0.2, 0.4636476, 0.7853981634})
    expect_rest({"wall.0.shapes=" + turned("min=[-0.15,-1,-0.05],max=[0.15,1,0.25]", angle),
                 "wall.0.subtract=" + turned("min=[-0.1,-1,0],max=[0.1,1,1]", angle),
                 "region.0.fill={level=[0,0,0.1],from=[0,0,0.06]}", "domain.min=[-0.3,-1,-0.2]",
                 "domain.max=[0.35,1,0.4]"},
                0.1 + 0.1 * std::sin(angle));
}

}  // namespace
}  // namespace slagflow
