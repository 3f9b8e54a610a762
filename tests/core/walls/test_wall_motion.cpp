// Poses of moving walls against closed forms, and what the device makes of them.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "core/simulation_setups.hpp"
#include "walls/moving_walls.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double pi = 3.14159265358979323846;

WallMotion motion(MotionKind kind) {
  WallMotion m;
  m.kind = kind;
  return m;
}

void expect_near(Vec3d a, Vec3d b, double tolerance = 1e-14) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << "axis " << k;
}

TEST(WallMotion, ConstantRunsFromStartToStop) {
  WallMotion m = motion(MotionKind::constant);
  m.velocity = {1, 0, -2}, m.angular_velocity = {0, 3, 0}, m.start = 0.5, m.stop = 2;
  expect_near(m.pose(0.2).shift, {});
  expect_near(m.pose(1.5).shift, {1, 0, -2});
  expect_near(m.pose(1.5).turn, {0, 3, 0});
  expect_near(m.pose(9).shift, {1.5, 0, -3});
}

TEST(WallMotion, RampGrowsToItsVelocity) {
  WallMotion m = motion(MotionKind::ramp);
  m.velocity = {4, 0, 0}, m.ramp_time = 2, m.start = 1;
  expect_near(m.pose(2).shift, {1, 0, 0});  // v t^2 / (2 T)
  expect_near(m.pose(3).shift, {4, 0, 0});  // v T / 2
  expect_near(m.pose(3.5).shift, {6, 0, 0});
}

TEST(WallMotion, SineBeginsAtItsPlace) {
  WallMotion m = motion(MotionKind::sine);
  m.amplitude = {0, 0, 2}, m.angular_amplitude = {1, 0, 0}, m.frequency = 0.5, m.phase = 0.3;
  expect_near(m.pose(0).shift, {});
  expect_near(m.pose(0.7).shift, {0, 0, 2 * (std::sin(pi * 0.7 + 0.3) - std::sin(0.3))});
  expect_near(m.pose(0.7).turn, {std::sin(pi * 0.7 + 0.3) - std::sin(0.3), 0, 0});
}

TEST(WallMotion, TableIsLinearOrSmoothBetweenItsRows) {
  WallMotion m = motion(MotionKind::table);
  m.time = {0, 1, 3, 4}, m.displacement = {{}, {1, 0, 0}, {1, 2, 0}, {0, 4, 0}};
  m.angle = {0, 0.5, 0.5, 0}, m.axis = {0, 0, 2};
  expect_near(m.pose(0.25).shift, {0.25, 0, 0});
  expect_near(m.pose(0.25).turn, {0, 0, 0.125});
  expect_near(m.pose(2).shift, {1, 1, 0});
  expect_near(m.pose(7).shift, {0, 4, 0});
  m.interpolation = Interpolation::smooth;
  for (std::size_t k = 0; k < 4; ++k) expect_near(m.pose(m.time[k]).shift, m.displacement[k]);
  const double d = 1e-5;
  double last = 0;
  for (double t = d; t < 4 - d; t += 0.01) {
    const double before = m.pose(t - d).shift.y, here = m.pose(t).shift.y, after = m.pose(t + d).shift.y;
    EXPECT_LE(std::fabs(after - 2 * here + before) / d, 20 * d) << "the velocity jumps at " << t;
    EXPECT_GE(here, last - 1e-15) << "overshoots at " << t;
    EXPECT_LE(m.pose(t).shift.x, 1 + 1e-15) << "overshoots at " << t;
    last = here;
  }
}

TEST(WallMotion, NothingIsFasterThanItsBound) {
  WallMotion table = motion(MotionKind::table);
  table.time = {0, 1, 3, 4}, table.displacement = {{}, {1, 0, 0}, {1, 2, 0}, {0, 4, 0}};
  table.interpolation = Interpolation::smooth;
  WallMotion sine = motion(MotionKind::sine);
  sine.amplitude = {1, 2, 0}, sine.frequency = 2;
  WallMotion ramp = motion(MotionKind::ramp);
  ramp.velocity = {0, 0, 3}, ramp.ramp_time = 1;
  for (const WallMotion& m : {table, sine, ramp}) {
    double fastest = 0;
    for (double t = 0; t < 4; t += 1e-3)
      fastest = std::max(fastest, norm(m.pose(t + 1e-6).shift - m.pose(t).shift) / 1e-6);
    EXPECT_LE(fastest, m.fastest().linear * (1 + 1e-6));
    EXPECT_GT(fastest, 0.5 * m.fastest().linear);
  }
}

// Against second differences of the pose, in the middle of each stretch.
TEST(WallMotion, AccelerationIsThatOfThePose) {
  WallMotion table = motion(MotionKind::table);
  table.time = {0, 1, 3, 4}, table.displacement = {{}, {1, 0, 0}, {1, 2, 0}, {0, 4, 0}};
  table.angle = {0, 0.5, 0.5, 0}, table.axis = {0, 3, 4};
  WallMotion smooth = table;
  smooth.interpolation = Interpolation::smooth;
  WallMotion sine = motion(MotionKind::sine);
  sine.amplitude = {1, 2, 0}, sine.angular_amplitude = {0, 0.2, 1}, sine.frequency = 0.7, sine.phase = 0.4;
  sine.start = 0.3;
  WallMotion ramp = motion(MotionKind::ramp);
  ramp.velocity = {0, 0, 3}, ramp.angular_velocity = {1, 2, 0}, ramp.ramp_time = 1.7, ramp.stop = 3.6;
  WallMotion constant = motion(MotionKind::constant);
  constant.velocity = {1, 2, 3}, constant.stop = 3;
  const double d = 1e-4;
  double largest = 0;
  for (const WallMotion& m : {table, smooth, sine, ramp, constant})
    for (double t = 0.05; t < 5; t += 0.1) {
      const BodyPose before = m.pose(t - d), now = m.pose(t), after = m.pose(t + d), a = m.acceleration(t);
      expect_near(a.shift, (after.shift - 2.0 * now.shift + before.shift) * (1 / (d * d)), 1e-5);
      expect_near(a.turn, (after.turn - 2.0 * now.turn + before.turn) * (1 / (d * d)), 1e-5);
      largest = std::max(largest, norm(a.shift) + norm(a.turn));
    }
  EXPECT_GT(largest, 10);
}

TEST(WallMotion, RotationIsRightHanded) {
  expect_near(rotation({0, 0, pi / 2}) * Vec3d{1, 0, 0}, {0, 1, 0});
  expect_near(rotation({0, 2 * pi / 3, 0}) * Vec3d{0, 0, 1}, {std::sin(2 * pi / 3), 0, std::cos(2 * pi / 3)});
  const Rotation r = rotation({0.3, -0.7, 1.1});
  expect_near(r * Vec3d{0.3, -0.7, 1.1}, {0.3, -0.7, 1.1});
  EXPECT_NEAR(dot(r * Vec3d{1, 2, 3}, r * Vec3d{-2, 1, 4}), 12, 1e-13);
}

// A block of wall that turns about an axis beside it.
TEST(MovingWalls, PlacesAndVelocitiesAreThoseOfTheRotation) {
  SimulationSetup s = empty_setup({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  s.bodies[0].motion = motion(MotionKind::constant);
  s.bodies[0].motion.angular_velocity = {0, 0, 2}, s.bodies[0].motion.velocity = {0, 0, 0.1};
  s.bodies[0].motion.center = {0.1, 0, 0};
  add_wall(s, {0.2, 0, 0}, {1, 0, 0}, 0.005);
  add_wall(s, {0.1, 0.05, 0.01}, {0, 1, 0}, 0.015);
  Context context;
  WallArrays wall(context);
  MovingWalls walls(context);
  walls.upload(s, wall);
  const double dt = 1e-6;
  walls.place({pi / 4, dt, dt}, wall);  // a quarter of a turn
  std::vector<Quad> place, normal, velocity;
  wall.place.download(place), wall.normal.download(normal), wall.velocity.download(velocity);
  const double rise = 0.1 * pi / 4;
  expect_near(to_double(xyz(place[0])), Vec3d{0.6, 0.6, 0.5 + rise}, 1e-6);
  expect_near(to_double(xyz(place[1])), Vec3d{0.55, 0.5, 0.51 + rise}, 1e-6);
  expect_near(to_double(xyz(normal[0])), Vec3d{0, 1, 0}, 1e-6);
  expect_near(to_double(xyz(normal[1])), Vec3d{-1, 0, 0}, 1e-6);
  expect_near(to_double(xyz(velocity[0])), Vec3d{-2 * 0.1, 0, 0.1}, 1e-6);  // of its own place
  expect_near(to_double(xyz(velocity[1])), Vec3d{0, -2 * 0.05, 0.1}, 1e-6);
  EXPECT_NEAR(walls.largest_speed(), 0.3, 1e-6);  // at most 0.1 + 2 * 0.1
  EXPECT_NEAR(walls.largest_displacement(0, 0.1), 0.1 * 0.1 + 0.2 * 0.1, 1e-6);
}

// In steps of a fifth of a radian: the velocity goes along the chord of the step to come, and what has been
// moved is the chord of the last.
TEST(MovingWalls, VelocitiesAndDisplacementsGoAlongChords) {
  SimulationSetup s = empty_setup({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  WallMotion& m = s.bodies[0].motion = motion(MotionKind::constant);
  m.angular_velocity = {0, 0, 2}, m.velocity = {0, 0.3, 0.1}, m.center = {0.1, 0, 0};
  add_wall(s, {0.2, 0, 0}, {1, 0, 0}, 0.005);
  Context context;
  WallArrays wall(context);
  MovingWalls walls(context);
  walls.upload(s, wall);
  const double now = 0.4, dt = 0.1, last_dt = 0.07;
  walls.place({now, dt, last_dt}, wall);
  std::vector<Quad> velocity, moved;
  wall.velocity.download(velocity), wall.moved.download(moved);
  const auto at = [&](Vec3d x, double t) { return walls.position_at(x, 0, t); };
  const Vec3d own{0.2, 0, 0};
  expect_near(to_double(xyz(velocity[0])), (at(own, now + dt) - at(own, now)) * (1 / dt), 1e-6);
  expect_near(to_double(xyz(moved[0])), at(own, now) - at(own, now - last_dt), 1e-7);
}

// A block that is pushed and turned ever faster: second differences of its particles' places.
TEST(MovingWalls, AccelerationsAreThoseOfTheParticles) {
  SimulationSetup s = empty_setup({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  s.bodies.push_back({"floor", WallSlip::no_slip});
  WallMotion& m = s.bodies[0].motion = motion(MotionKind::ramp);
  m.velocity = {1, 0, -2}, m.angular_velocity = {3, 0, 5}, m.ramp_time = 2, m.center = {0.1, 0, 0};
  for (const Vec3d x : {Vec3d{0.2, 0, 0}, Vec3d{0.1, 0.05, 0.01}, Vec3d{-0.3, 0.2, 0.1}})
    add_wall(s, x, {1, 0, 0}, 0.005);
  s.walls.body.back() = 1;
  Context context;
  WallArrays wall(context);
  MovingWalls walls(context);
  walls.upload(s, wall);
  const double time = 0.7, dt = 1e-6, d = 1e-4;
  walls.place({time, dt, dt}, wall);
  std::vector<Quad> acceleration;
  wall.acceleration.download(acceleration);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t body = s.walls.body[i];
    const auto at = [&](double t) { return walls.position_at(s.walls.position[i], body, t); };
    const Vec3d wanted = (at(time + d) - 2.0 * at(time) + at(time - d)) * (1 / (d * d));
    expect_near(to_double(xyz(acceleration[i])), wanted, 1e-5);
    EXPECT_EQ(norm(wanted) > 0.1, body == 0);
  }
}

TEST(MovingWalls, AWallThatVanishesLeavesTheSort) {
  SimulationSetup s = empty_setup({0, 0, 0}, {0.3, 0.3, 0.3});
  s.bodies.push_back({"gate", WallSlip::no_slip});
  s.bodies[1].motion.remove_at = 2;
  for (int k = 0; k < 6; ++k) {
    add_wall(s, {0.05 * k, 0.1, 0.1}, {1, 0, 0}, 0.005);
    s.walls.body.back() = k % 2 == 0 ? 0 : 1;
  }
  Context context;
  WallArrays wall(context);
  MovingWalls walls(context);
  Ordering ordering(context, {0.3, 0.3, 0.3}, {false, false, false},
                    CellGrid::cover({0.3, 0.3, 0.3}, {false, false, false}, 0.03));
  walls.upload(s, wall);
  EXPECT_FALSE(walls.vanishes(0, 1.9));
  EXPECT_TRUE(walls.vanishes(1.9, 2));
  walls.place({1.9, 1e-3, 1e-3}, wall), ordering.sort(wall);
  EXPECT_EQ(wall.count, 6);
  walls.place({2, 1e-3, 1e-3}, wall), ordering.sort(wall);
  EXPECT_EQ(wall.count, 3);
  for (const Index id : download(context, wall.id.span())) EXPECT_EQ(id % 2, 0);
}

}  // namespace
}  // namespace slagflow
