// The keys of [[wall]] about slip and motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/measures/measures.hpp"

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

TEST(CaseWalls, BearAsMuchTensionAsTheFluidOrLess) {
  const std::string fluid = "[numerics]\ntension_limit = 20\n";
  auto limit = [&](const std::string& keys) {
    return build_setup(read(keys + fluid)).setup.bodies.at(0).tension_limit;
  };
  EXPECT_EQ(limit(""), -1);
  EXPECT_EQ(limit("tension_limit = 'auto'\n"), -1);
  EXPECT_EQ(limit("tension_limit = 5\n"), 5);
  EXPECT_EQ(limit("tension_limit = 20\n"), 20);
  EXPECT_THAT(message_of("tension_limit = 21\n" + fluid),
              testing::HasSubstr("key 'wall.0.tension_limit': value 21: allowed: up to what the fluid bears, "
                                 "numerics.tension_limit = 20 [Pa]"));
  EXPECT_THAT(message_of("tension_limit = -1"),
              testing::HasSubstr("value -1 is out of range: allowed: a number >= 0.0 [Pa, or \"auto\"]"));
  EXPECT_THAT(message_of("tension_limit = 'none'"), testing::HasSubstr("[Pa, or \"auto\"]"));
}

TEST(CaseWalls, AreTheSameWrittenAndReadAgain) {
  for (const char* keys :
       {"", "slip = 'free_slip'", "tension_limit = 'auto'", "tension_limit = 0",
        "slip = 'partial_slip'\nslip_length = 0.1",
        "surface_velocity = [1, 2, 3]\nsurface_center = [0, 0, 1e-3]", "remove_at = 0.25",
        "motion = {type='constant', velocity=[0,0,0.1], angular_velocity=[0,1,0], center=[1,2,3]}",
        "motion = {type='ramp', velocity=[0,0,0.1], duration=0.3, start=0.1, stop=0.7}",
        "motion = {type='sine', amplitude=[0,0,0.1], frequency=2, phase=0.4}",
        "motion = {type='table', time=[0,1,3], displacement=[[0,0,0],[1,0,0],[1,0,2]],"
        " angle=[0,1,1], axis=[0,0,1], interpolation='smooth'}"}) {
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

TEST(CaseWalls, MotionReachesTheSetup) {
  const WallMotion m =
      build_setup(read("remove_at = 0.4\nmotion = {type='ramp', velocity=[0,0,0.1], duration=0.3,"
                       " start=0.1, center=[1,0,0], angular_velocity=[0,2,0]}"))
          .setup.bodies.at(0)
          .motion;
  EXPECT_EQ(m.kind, MotionKind::ramp);
  EXPECT_EQ(m.remove_at, 0.4);
  EXPECT_EQ(m.ramp_time, 0.3);
  EXPECT_EQ(m.start, 0.1);
  EXPECT_TRUE(m.velocity == (Vec3d{0, 0, 0.1}) && m.angular_velocity == (Vec3d{0, 2, 0}));
  EXPECT_TRUE(m.center == (Vec3d{1, 0, 0}));
  EXPECT_FALSE(build_setup(read("")).setup.bodies.at(0).motion.moves());
}

TEST(CaseWalls, NameWhatIsWrongWithAMotion) {
  using testing::HasSubstr;
  const auto table = [](const std::string& rows) {
    return message_of("motion = {type='table', " + rows + "}");
  };
  EXPECT_THAT(message_of("motion = {velocity=[0,0,1]}"), HasSubstr("key 'wall.0.motion.type': missing"));
  EXPECT_THAT(message_of("motion = {type='jump'}"), HasSubstr("allowed: rest, constant, ramp, table, sine"));
  EXPECT_THAT(message_of("motion = {type='ramp', velocity=[0,0,1]}"),
              HasSubstr("'wall.0.motion.duration': missing"));
  EXPECT_THAT(message_of("motion = {type='constant', frequency=1}"),
              HasSubstr("'wall.0.motion.frequency': unknown"));
  EXPECT_THAT(message_of("motion = {type='constant', start=2, stop=1}"),
              HasSubstr("'wall.0.motion.stop': value 1"));
  EXPECT_THAT(message_of("remove_at = -1"), HasSubstr("'wall.0.remove_at': value -1"));
  EXPECT_THAT(table("displacement=[[0,0,0]]"),
              HasSubstr("'wall.0.motion.time': missing: required: increasing times [s]"));
  EXPECT_THAT(table("time=[0, 2, 1], displacement=[[0,0,0],[1,0,0],[1,0,0]]"),
              HasSubstr("'wall.0.motion.time': value 1.0 follows 2.0: allowed: increasing times"));
  EXPECT_THAT(table("time=[0], displacement=[[0,0,0]]"), HasSubstr("'wall.0.motion.time': has 1 entries"));
  EXPECT_THAT(table("time=[0, nan], angle=[0, 1], axis=[0, 1, 0]"),
              HasSubstr("'wall.0.motion.time': entry nan is out of range"));
  EXPECT_THAT(table("time=[0, 1], angle=[0, inf], axis=[0, 1, 0]"),
              HasSubstr("'wall.0.motion.angle': entry inf is out of range"));
  EXPECT_THAT(table("time=[0, 1], displacement=[[0,0,0],[nan,0,1]]"),
              HasSubstr("'wall.0.motion.displacement': entry [nan, 0, 1] is out of range"));
  EXPECT_THAT(table("time=[0, 1], displacement=[[0,0,0]]"), HasSubstr("1 entries for 2 times"));
  EXPECT_THAT(table("time=[0, 1], displacement=[[1,0,0],[1,0,0]]"),
              HasSubstr("does not begin with [0, 0, 0]"));
  EXPECT_THAT(table("time=[0, 1]"),
              HasSubstr("'wall.0.motion': without displacement or angle it moves nothing"));
  EXPECT_THAT(table("time=[0, 1], angle=[0, 1]"), HasSubstr("'wall.0.motion.axis': missing"));
  EXPECT_THAT(message_of("motion = {type='table', time=[0, 'a'], displacement=[[0,0,0]]}"),
              HasSubstr("'wall.0.motion.time'"));
}

TEST(CaseWalls, AFastWallIsWarnedOf) {
  Case c = read("motion = {type='constant', velocity=[0, 0, 3]}");
  EXPECT_TRUE(build_setup(c).warnings.empty());  // the automatic sound speed follows
  c.numerics.sound_speed = 10;
  const BuiltCase built = build_setup(c);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(built.warnings[0], testing::HasSubstr("wall 'floor' moves at up to 3.000000 m/s"));
}

// A floor of half a millimetre, and in two dimensions one that begins beside the plane.
TEST(CaseWalls, AWallWithoutAParticleIsWarnedOf) {
  const Case thin = parse_case(pool(""), "pool.toml",
                               {"wall.0.shapes=[{shape='box', min=[0, 0, -5e-4], max=[0.01, 0.01, 0]}]"});
  ASSERT_EQ(build_setup(thin).warnings.size(), 1u);
  EXPECT_THAT(build_setup(thin).warnings[0], testing::HasSubstr("wall 'floor' has no particle"));
  const std::string region = "region.0.shapes=[{shape='box', min=[0, -1, 0], max=[0.01, 1, 0.01]}]";
  const Case flat = parse_case(pool(""), "pool.toml",
                               {"resolution.dimensions=2", region,
                                "wall.0.shapes=[{shape='box', min=[-1, 1e-3, -0.006], max=[1, 0.01, 0]}]"});
  ASSERT_EQ(build_setup(flat).warnings.size(), 1u);
  EXPECT_THAT(build_setup(flat).warnings[0], testing::HasSubstr("in the plane y = 0"));
  EXPECT_TRUE(build_setup(read("")).warnings.empty());
}

// A plate on the floor hides no site of it, and has a face below: either is bare when it lifts.
TEST(CaseWalls, AWallThatMovesAndItsNeighboursHaveFacesToEachOther) {
  const std::string plate =
      "[[wall]]\nname = 'plate'\nshapes = [{shape = 'box', min = [0.01, -0.004, 0], max = [0.0145, 0.014, "
      "0.01]}]\n";
  const WallParticles fixed = build_setup(read(plate)).setup.walls;
  const WallParticles moving =
      build_setup(read(plate + "motion = {type='constant', velocity=[0,0,0.1]}")).setup.walls;
  const auto facing = [](const WallParticles& w, int body, double z) {
    int count = 0;
    for (std::size_t i = 0; i < w.position.size(); ++i)
      count += w.body[i] == body && w.normal[i].z == z && w.depth[i] < 1.1e-3 && w.position[i].x > 0.0105 &&
               w.position[i].x < 0.0135;
    return count;
  };
  EXPECT_EQ(facing(fixed, 1, -1), 0);
  EXPECT_GT(facing(moving, 1, -1), 0);
  EXPECT_GT(facing(moving, 0, 1), facing(fixed, 0, 1));
}

TEST(CaseWalls, AForceIsMeasuredOfAWall) {
  const std::string measure =
      "[[measure]]\nname = 'load'\ntype = 'force'\nwall = 'floor'\nabout = [1, 2, 3]\n";
  const Case c = parse_case(pool("") + measure, "pool.toml");
  EXPECT_EQ(c.measures.at(0).wall, 0);
  EXPECT_TRUE(c.measures.at(0).about == (Vec3d{1, 2, 3}));
  EXPECT_TRUE(build_setup(c).setup.measure_walls);
  EXPECT_EQ(to_toml(parse_case(to_toml(c), "again.toml")), to_toml(c));
  EXPECT_THROW(
      parse_case(pool("") + "[[measure]]\nname = 'load'\ntype = 'force'\nwall = 'roof'\n", "pool.toml"),
      InputError);
}

// 3 N up during 0.2 s, then 5 N aside, at the point (0, 0, 2). The velocities, and with them the impulses,
// are half a step behind the lines' times.
TEST(ForceMeasure, IsTheMeanBetweenLines) {
  Case c =
      parse_case(pool("") + "[[measure]]\nname='load'\ntype='force'\nwall='floor'\nabout=[1, 0, 2]\n", "p");
  const SimulationSetup setup = build_setup(c).setup;
  Measures measures(c, setup);
  const Measures::ReadSnapshot none = []() -> const FluidSnapshot& { throw Error("no snapshot is needed"); };
  Totals totals;
  totals.walls.resize(1);
  EXPECT_TRUE(std::isnan(measures.update(0, totals, none).at(0)));
  totals.walls[0].pressure = {0, 0, 0.6}, totals.walls[0].work = 7, totals.impulse_time = 0.2;
  const std::vector<double> first = measures.update(0.21, totals, none);
  EXPECT_DOUBLE_EQ(first[2], 3);
  EXPECT_DOUBLE_EQ(first[7], 3);  // (-1, 0, 0) x (0, 0, 3) = (0, 3, 0)
  EXPECT_DOUBLE_EQ(first[9], 7);
  totals.impulse_time = 0.3, totals.walls[0].viscous = {0.5, 0, 0},
  totals.walls[0].viscous_torque = {0, 1, 0};  // (0, 0, 2) x (0.5, 0, 0)
  Measures resumed(c, setup);
  resumed.restore(measures.state());
  const std::vector<double> second = measures.update(0.302, totals, none);
  EXPECT_NEAR(second[2], 0, 1e-12);
  EXPECT_DOUBLE_EQ(second[3], 5);
  EXPECT_NEAR(second[7], 0, 1e-12);
  EXPECT_EQ(resumed.update(0.302, totals, none), second);
  EXPECT_EQ(first.size(), measures.columns().size());
  EXPECT_THAT(measures.columns()[0], "load_pressure_x_N");
  EXPECT_THAT(measures.lines()[0], testing::HasSubstr("on floor, at last (5, 0, 0) N, largest 5 N"));
  EXPECT_THAT(measures.summary().text(), testing::HasSubstr("\"wall\": \"floor\""));
}

}  // namespace
}  // namespace slagflow
