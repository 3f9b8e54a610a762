// The keys of [[wall]] about slip and motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/case.hpp"
#include "host/setup_builder.hpp"

namespace slagflow {
namespace {

// A pool on a floor; `keys` are put into the floor's table.
std::string pool(const std::string& keys) {
  return R"([case]
name = "pool"
[resolution]
spacing = 2e-3
[fluid.oil]
density = 965
rheology = "newtonian"
dynamic_viscosity = 0.5
[[region]]
shapes = [{shape = "box", min = [0, 0, 0], max = [0.01, 0.01, 0.01]}]
[[wall]]
name = "floor"
shapes = [{shape = "box", min = [-0.004, -0.004, -0.006], max = [0.014, 0.014, 0]}]
)" + keys +
         R"(
[domain]
min = [-0.005, -0.005, -0.008]
max = [0.015, 0.015, 0.02]
[output]
end_time = 1
)";
}

Case read(const std::string& keys) { return parse_case(pool(keys), "pool.toml"); }

std::string message_of(const std::string& keys) {
  try {
    read(keys);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(CaseWalls, SlipAndSurfaceReachTheSetup) {
  const Case c = read(
      "slip = 'partial_slip'\nslip_length = 3e-4\nsurface_velocity = [1, 2, 0]\n"
      "surface_angular_velocity = [0, 0, 4]\nsurface_center = [5, 6, 7]");
  const WallBody body = build_setup(c).setup.bodies.at(0);
  EXPECT_EQ(body.slip, WallSlip::partial_slip);
  EXPECT_EQ(body.slip_length, 3e-4);
  EXPECT_TRUE(body.surface.velocity == (Vec3d{1, 2, 0}));
  EXPECT_TRUE(body.surface.angular_velocity == (Vec3d{0, 0, 4}));
  EXPECT_TRUE(body.surface.center == (Vec3d{5, 6, 7}));
  EXPECT_TRUE(body.surface.at({6, 6, 0}) == (Vec3d{1, 6, 0}));
}

TEST(CaseWalls, AreTheSameWrittenAndReadAgain) {
  for (const char* keys : {"", "slip = 'free_slip'", "slip = 'partial_slip'\nslip_length = 0.1",
                           "surface_velocity = [1, 2, 3]\nsurface_center = [0, 0, 1e-3]"}) {
    const std::string text = to_toml(read(keys));
    EXPECT_EQ(to_toml(parse_case(text, "again.toml")), text) << keys;
  }
}

TEST(CaseWalls, NameWhatIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(message_of("slip = 'partial_slip'"), HasSubstr("key 'wall.0.slip_length': missing"));
  EXPECT_THAT(
      message_of("slip = 'partial_slip'\nslip_length = 0"),
      HasSubstr("pool.toml:15: key 'wall.0.slip_length': value 0 is out of range: allowed: a number > 0"));
  EXPECT_THAT(
      message_of("slip_length = 1"),
      HasSubstr("key 'wall.0.slip_length': does not go with the other keys: only slip = \"partial_slip\""));
  EXPECT_THAT(message_of("slip = 'free_slip'\nsurface_velocity = [1, 0, 0]"),
              HasSubstr("key 'wall.0.surface_velocity': does not go with the other keys"));
  EXPECT_THAT(message_of("slip = 'sticky'"), HasSubstr("allowed: no_slip, free_slip, partial_slip"));
}

}  // namespace
}  // namespace slagflow
