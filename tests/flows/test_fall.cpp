// What falls flat on a floor is borne by the sound speed that is chosen for it, and the watch lets it splash.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

void expect_to_bear(const std::vector<std::string>& overrides, double time) {
  Flow flow("verification/fall.toml", overrides);
  EXPECT_NO_THROW(flow.run(time));
  const auto most = flow.simulation().largest_compression();
  std::printf("largest compression %.3f at %.4f s\n", most.value, most.time);
  EXPECT_LT(most.value, 0.25);
  EXPECT_GT(most.value, 0.05) << "nothing fell";
}

TEST(Fall, OfAFlatSlabOfWaterIsBorne) { expect_to_bear({}, 0.6); }

TEST(Fall, OfSlagIsBorne) {
  expect_to_bear({"fluid.water.dynamic_viscosity=2", "fluid.water.density=2600"}, 0.4);
}

// A narrower block splashes up the walls. With these sound speeds walls gave back in ten steps what blows had
// just taken, and the watch ended the run.
TEST(Fall, OfABlockThatSplashesIsNotStopped) {
  for (const char* sound_speed : {"15", "17", "18", "25"}) {
    Flow flow("verification/fall.toml",
              {"region.0.shapes=[{shape=\"box\", min=[0.05, -1, 0.2], max=[0.15, 1, 0.25]}]",
               "domain.max=[0.23, 1, 0.4]", std::string("numerics.sound_speed=") + sound_speed,
               "limits.max_compression=0.9"});
    EXPECT_NO_THROW(flow.run(0.5)) << sound_speed;
  }
}

}  // namespace
}  // namespace slagflow
