// What of the start is probably not meant: pieces, thin fluid, fronts that have arrived, crushed fluid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> warnings_of(const Case& c) { return build_setup(c).warnings; }

Case with_shapes(std::vector<ShapeSpec> shapes) {
  Case c = unit_case();
  c.regions[0].shapes = std::move(shapes);
  return c;
}

RegionSpec another(const ShapeSpec& shape) {
  RegionSpec region;
  region.shapes = {shape};
  return region;
}

TEST(StartSurvey, ARegionThatAWallPartsIsTold) {
  Case c = with_shapes({box({1, 1, 1}, {9, 9, 5})});
  const auto told = Contains(
      AllOf(HasSubstr("region 0 starts in 2 pieces that do not touch: 71 % at (1.5, 1.5, 1.5) m, 29 %"),
            HasSubstr("walls or earlier regions part it")));
  EXPECT_THAT(warnings_of(c), Not(Contains(HasSubstr("pieces"))));
  c.walls = {wall("dam", {box({6, 0, 0}, {7, 10, 10})})};
  EXPECT_THAT(warnings_of(c), told);
  // Two shapes are two pieces by intent.
  EXPECT_THAT(warnings_of(with_shapes({box({1, 1, 1}, {3, 9, 5}), box({7, 1, 1}, {9, 9, 5})})),
              Not(Contains(HasSubstr("pieces"))));
}

TEST(StartSurvey, RegionsThatAlmostTouchAreTold) {
  const auto gap = [](double x) {
    Case c = with_shapes({box({0, 1, 1}, {4, 9, 5})});
    c.regions.push_back(another(box({x, 1, 1}, {x + 3, 9, 5})));
    return warnings_of(c);
  };
  EXPECT_THAT(gap(4), Not(Contains(HasSubstr("almost touches"))));
  EXPECT_THAT(
      gap(5),
      Contains(HasSubstr(
          "region 0 and of region 1 almost touches: 1 spacings of air along x lie between them at (3.5")));
  EXPECT_THAT(gap(7), Contains(HasSubstr("almost touches: 3 spacings")));
  EXPECT_THAT(gap(8), Not(Contains(HasSubstr("almost touches"))));
}

TEST(StartSurvey, TheThinnestRegionIsTold) {
  const auto thick = [](double height) {
    return warnings_of(with_shapes({box({0, 0, 4}, {10, 10, 4 + height})}));
  };
  EXPECT_THAT(thick(1), Contains(AllOf(HasSubstr("region 0 is 1 particle across"),
                                       HasSubstr("resolution.spacing of 0.25 m"))));
  EXPECT_THAT(thick(2),
              Contains(AllOf(HasSubstr("region 0 is 2 particles across"), HasSubstr("0.5 m gives it four"))));
  EXPECT_THAT(thick(3), Not(Contains(HasSubstr("across over most"))));
  // A film on a deep pool is another fluid if it is one.
  Case c = with_shapes({box({0, 0, 0}, {10, 10, 5})});
  c.regions.push_back(another(box({0, 0, 5}, {10, 10, 6})));
  EXPECT_THAT(warnings_of(c), Not(Contains(HasSubstr("across over most"))));
  c.fluids.push_back(c.fluids[0]);
  c.fluids[1].name = "oil";
  c.regions[1].fluid = 1;
  EXPECT_THAT(warnings_of(c), Contains(HasSubstr("region 1 is 1 particle across")));
}

TEST(StartSurvey, AMeasureThatHasArrivedIsTold) {
  Case c = with_shapes({box({0, 0, 0}, {10, 10, 5})});
  MeasureSpec front;
  front.name = "edge";
  front.direction = {0, 1};
  front.position = 9;
  front.fraction = 0.05;
  c.measures = {front};
  EXPECT_THAT(warnings_of(c), Contains(AllOf(HasSubstr("measure 'edge' has arrived at the start already: 10 "
                                                       "% of the fluid is beyond position = 9.0 m"),
                                             HasSubstr("fraction asks for 5.0 %"))));
  c.measures[0].fraction = 0.11;
  EXPECT_THAT(warnings_of(c), Not(Contains(HasSubstr("arrived"))));
  c.measures[0].type = MeasureType::jet;
  c.measures[0].bottom = 1;
  EXPECT_THAT(warnings_of(c), Contains(HasSubstr("beyond bottom = 1.0 m")));
}

// A full vessel with a plate in it that goes down; `lid` closes it.
Case pressed(double fluid_top, bool lid) {
  Case c = with_shapes({box({2, 2, 2}, {8, 8, fluid_top})});
  c.domain.lower = {-1, -1, -1};
  c.walls = {wall("vessel", {outside(box({2, 2, 2}, {8, 8, lid ? 8.0 : 20.0}))}),
             wall("plate", {box({2, 2, 6}, {8, 8, 9})})};
  c.walls[1].motion.kind = MotionKind::constant;
  c.walls[1].motion.velocity = {0, 0, -1};
  c.walls[1].motion.stop = 2;
  c.numerics.sound_speed = 100;
  c.output.end_time = 5;
  return c;
}

TEST(StartSurvey, APlateThatCrushesFluidIsTold) {
  const auto crushed = Contains(HasSubstr("crushes enclosed fluid"));
  EXPECT_THAT(warnings_of(pressed(6, true)),
              Contains(AllOf(HasSubstr("wall 'plate' crushes enclosed fluid"),
                             HasSubstr("1.44e+05 litres of fluid, with 0 litres of air"),
                             HasSubstr("wall.1.motion"))));
  EXPECT_THAT(warnings_of(pressed(5, true)), crushed);
  EXPECT_THAT(warnings_of(pressed(4, true)), Not(crushed)) << "there is as much air as it takes";
  Case away = pressed(6, true);
  away.walls[1].motion.velocity = {0, 0, 1};
  EXPECT_THAT(warnings_of(away), Not(crushed));
  Case narrow = pressed(6, false);
  narrow.walls[1].shapes = {box({3, 2, 6}, {8, 8, 9})};
  EXPECT_THAT(warnings_of(narrow), Not(crushed)) << "a gap beside the plate";
  Case late = pressed(6, true);
  late.output.end_time = 0.05;
  EXPECT_THAT(warnings_of(late), Not(crushed)) << "the run ends before";
  Case both = pressed(6, true);
  both.walls[0].motion = both.walls[1].motion;
  EXPECT_THAT(warnings_of(both), Not(crushed)) << "vessel and plate move as one";
  Case gone = pressed(6, true);
  gone.walls[1].motion.remove_at = 1;
  EXPECT_THAT(warnings_of(gone), Not(crushed)) << "the plate vanishes";
}

TEST(StartSurvey, APaddleInFluidCrushesNothing) {
  Case c = with_shapes({box({1, 1, 1}, {9, 9, 9})});
  c.walls = {wall("vessel", {outside(box({1, 1, 1}, {9, 9, 9}))}),
             wall("paddle", {box({4, 3, 3}, {6, 7, 7})})};
  c.walls[1].motion.kind = MotionKind::sine;
  c.walls[1].motion.amplitude = {2, 0, 0};
  c.walls[1].motion.frequency = 1;
  EXPECT_THAT(warnings_of(c), Not(Contains(HasSubstr("crushes"))));
}

TEST(SetupWarnings, AYieldStressThatIsLostIsTold) {
  const auto yields = [](double yield_stress) {
    Case c = with_shapes({box({0, 0, 0}, {10, 10, 5})});
    c.fluids[0].rheology = RheologyKind::bingham;
    c.fluids[0].parameters = {1, yield_stress, 1000};
    return warnings_of(c);
  };
  for (const double lost : {1e-6, 1e-12, 1e13, 1e25})
    EXPECT_THAT(yields(lost), Contains(HasSubstr("the computation hold nothing"))) << lost;
  for (const double fine : {0.0, 0.1, 10.0, 1e6})
    EXPECT_THAT(yields(fine), Not(Contains(HasSubstr("hold nothing")))) << fine;
}

TEST(SetupWarnings, ValuesOfAnotherUnitAreToldIt) {
  const auto warnings = [](double tension, double turn) {
    Case c = unit_case();
    c.fluids[0].surface_tension = tension;
    c.walls = {wall("roll", {box({0, 0, 0}, {10, 10, 3})})};
    c.walls[0].surface.angular_velocity = {0, turn, 0};
    return warnings_of(c);
  };
  EXPECT_THAT(warnings(0.45, 1), Not(Contains(HasSubstr("meant in mN/m"))));
  EXPECT_THAT(warnings(450, 1), Contains(HasSubstr("is it meant in mN/m? Then surface_tension = 0.45")));
  EXPECT_THAT(warnings(0, 1), Not(Contains(HasSubstr("rad/s"))));
  EXPECT_THAT(warnings(0, 300), Contains(HasSubstr("angular velocities are in rad/s: 60 rpm are 6.28")));
}

TEST(SetupWarnings, AFileAtMapCoordinatesIsToldItsSteps) {
  const auto warnings_at = [](Vec3d origin) {
    Case c = unit_case();
    c.origin = origin;
    c.domain.lower += origin, c.domain.upper += origin;
    c.regions[0].shapes = {box(origin + Vec3d{4, 4, 7}, origin + Vec3d{6, 6, 9})};
    const std::vector<Triangle> floor = box_triangles(origin, origin + Vec3d{10, 10, 3});
    c.walls = {wall("floor", {stl_shape(write_temp_file("floor.stl", binary_stl(floor)))})};
    return warnings_of(c);
  };
  EXPECT_THAT(
      warnings_at({500000, 4500000, 1200}),
      Contains(HasSubstr("' has coordinates up to 4.5e+06, which single precision holds to 0.27 m, 0.27 "
                         "spacings: export it around an origin that is near")));
  EXPECT_THAT(warnings_at({5000, 45000, 1200}), Not(Contains(HasSubstr("single precision"))));
}

TEST(SetupWarnings, ASupportRatioThatWasNotTestedIsTold) {
  const auto ratio = [](double value) {
    Case c = unit_case();
    c.support_ratio = value;
    return warnings_of(c);
  };
  EXPECT_THAT(ratio(2.6), Not(Contains(HasSubstr("support_ratio"))));
  EXPECT_THAT(ratio(2),
              Contains(AllOf(HasSubstr("resolution.support_ratio = 2.0"), HasSubstr("resists flow"))));
  EXPECT_THAT(ratio(4), Contains(HasSubstr("resolution.support_ratio = 4.0")));
}

}  // namespace
}  // namespace slagflow
