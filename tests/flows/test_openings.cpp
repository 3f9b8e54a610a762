// Inlets that fluid stands around, and inlets in walls, off the lattice.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

std::string tank(const std::string& inlet, const std::string& region) {
  return R"([case]
name = "tank"
[resolution]
spacing = 0.01
dimensions = 2
[fluid.slag]
density = 2600
rheology = "newtonian"
dynamic_viscosity = 2
[[wall]]
name = "tank"
shapes = [{shape="box", min=[-0.2,-1,-0.05], max=[0.2,1,0.3]}]
subtract = [{shape="box", min=[-0.15,-1,0], max=[0.15,1,0.4]}]
)" + region +
         "\n[[inlet]]\nname = \"lance\"\nface = \"rectangle\"\n" + inlet + R"(
[domain]
min = [-0.2,-1,-0.05]
max = [0.2,1,0.35]
[output]
end_time = 1
)";
}

struct Fed {
  double compression, highest_speed;
  Totals totals;
};

Fed run(const std::string& text, double time) {
  const BuiltCase built = build_setup(parse_case(text, "tank.toml"));
  Simulation simulation(built.setup);
  while (simulation.time() < time) simulation.step();
  Fed fed{simulation.largest_compression().value, 0, simulation.totals()};
  fed.highest_speed = fed.totals.max_speed;
  std::printf("compression %.4f, %.3f m/s, fed %lld\n", fed.compression, fed.highest_speed,
              static_cast<long long>(fed.totals.fed[0]));
  return fed;
}

const std::string bath = "[[region]]\nfill = {level=[0,0,0.15], from=[0,0,0.05]}";

// The columns come on and step back in the bath: nothing may get behind or between them.
TEST(Openings, ALanceUnderABathFeedsIt) {
  for (const char* normal : {"[0,0,-1]", "[1,0,0]"}) {
    const Fed fed =
        run(tank("center = [0,0,0.08]\nheight = 0.06\nvelocity = 0.2\nnormal = " + std::string(normal), bath),
            0.7);
    EXPECT_LT(fed.compression, 0.05);
    EXPECT_LT(fed.highest_speed, 1);
    EXPECT_NEAR(static_cast<double>(fed.totals.fed[0]), 0.7 * 0.2 * 0.06 / 1e-4, 6);
    EXPECT_EQ(fed.totals.mass_left, 0);
  }
}

TEST(Openings, ABathMayRiseOverALance) {
  const Fed fed = run(tank("center = [0,0,0.08]\nheight = 0.06\nvelocity = 0.2\nnormal = [0,0,-1]",
                           "[[region]]\nfill = {level=[0,0,0.07], from=[0,0,0.05]}"),
                      1);
  EXPECT_LT(fed.compression, 0.1);
  EXPECT_EQ(fed.totals.mass_left, 0);
}

// Edges of the face half a spacing beside the walls' particles: no seam, open or shut.
TEST(Openings, WallsCloseAroundAFaceOffTheLattice) {
  for (const char* start : {"0", "0.9"}) {
    const Fed fed =
        run(tank("center = [-0.15,0,0.05]\nheight = 0.05\nvelocity = 0.05\nnormal = [1,0,0]\nstart = " +
                     std::string(start),
                 bath),
            1);
    EXPECT_LT(fed.compression, 0.03);
    EXPECT_LT(fed.highest_speed, 0.5);
    EXPECT_EQ(fed.totals.mass_left, 0);
  }
}

}  // namespace
}  // namespace slagflow
