// Faces of inlets: their columns, areas and speeds; what they take of walls and regions. Spacing 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "fluid/constants.hpp"
#include "host/geometry/inlet_profile.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry_cases.hpp"
#include "host/run/check.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double pi = 3.14159265358979323846;

InletSpec inlet(InletFace face, Vec3d center, Vec3d normal) {
  InletSpec in;
  in.name = "spout", in.face = face, in.center = center, in.normal = normal, in.value = 2;
  return in;
}

Case with(const InletSpec& in, std::vector<WallSpec> walls = {}) {
  Case c = unit_case();
  c.domain.lower = {0, 0, 0}, c.domain.upper = {40, 40, 40};
  c.regions.clear();
  c.inlets = {in};
  c.walls = std::move(walls);
  return c;
}

InletColumns columns_of(const Case& c) { return fill(c).inlets.at(0); }

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

std::string refusal(const Case& c) {
  try {
    fill(c);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(InletFaces, RectangleOnTheLatticeFeedsItsSites) {
  InletSpec in = inlet(InletFace::rectangle, {0, 10, 10}, {3, 0, 0});
  in.width = 4, in.height = 6;
  const InletColumns c = columns_of(with(in));
  ASSERT_EQ(c.origin.size(), 24U);
  EXPECT_DOUBLE_EQ(c.area, 24);
  EXPECT_DOUBLE_EQ(c.stride, 1);
  EXPECT_DOUBLE_EQ(c.across, 4);
  for (const Vec3d& p : c.origin) {
    EXPECT_NEAR(p.x, 0, 1e-12);
    EXPECT_NEAR(std::abs(p.y - std::floor(p.y)), 0.5, 1e-12);
    EXPECT_LT(std::abs(p.y - 10), 2);
    EXPECT_LT(std::abs(p.z - 10), 3);
  }
}

// Whatever the number of columns, a column has its part of the area, and a particle its volume.
TEST(InletFaces, VolumeIsThatOfTheFace) {
  for (const double tilt : {0.0, 0.3}) {
    InletSpec disc = inlet(InletFace::disc, {20, 20, 20}, {tilt, 0, -1});
    disc.radius = 4.3;
    InletSpec ring = inlet(InletFace::annulus, {20, 20, 20}, {tilt, 0, -1});
    ring.radius = 9, ring.inner_radius = 3.7;
    InletSpec slot = inlet(InletFace::rectangle, {20, 20, 20}, {tilt, 0, -1});
    slot.width = 7.3, slot.height = 5.6;
    const double areas[] = {pi * 4.3 * 4.3, pi * (81 - 3.7 * 3.7), 7.3 * 5.6};
    int k = 0;
    for (const InletSpec& in : {disc, ring, slot}) {
      const InletColumns c = columns_of(with(in));
      EXPECT_NEAR(c.area, areas[k], 1e-9) << k;
      EXPECT_NEAR(c.stride * c.area / static_cast<double>(c.origin.size()), 1, 1e-12);
      EXPECT_NEAR(c.stride, 1, 0.12);
      for (const Vec3d& p : c.origin) EXPECT_NEAR(dot(p - in.center, c.normal), 0, 1e-9);
      ++k;
    }
  }
}

TEST(InletFaces, DiscAlongAnAxisIsOnTheLattice) {
  InletSpec in = inlet(InletFace::disc, {20.2, 19.7, 30}, {0, 0, -1});
  in.radius = 4;
  for (const Vec3d& p : columns_of(with(in)).origin) {
    EXPECT_NEAR(p.x - std::floor(p.x), 0.5, 1e-9);
    EXPECT_NEAR(p.y - std::floor(p.y), 0.5, 1e-9);
  }
}

TEST(InletFaces, FlatPatchOfAnStlIsAFace) {
  const Triangle a{{{0, 0, 30}, {8, 0, 30}, {8, 6, 30}}}, b{{{0, 0, 30}, {8, 6, 30}, {0, 6, 30}}};
  InletSpec in = inlet(InletFace::stl, {}, {0, 0, -1});
  in.stl.file = write_temp_file("patch.stl", binary_stl({a, b}));
  in.stl.translate = {10, 10, 0};
  const InletColumns c = columns_of(with(in));
  EXPECT_EQ(c.origin.size(), 48U);
  EXPECT_NEAR(c.area, 48, 1e-6);
  EXPECT_NEAR(c.origin[0].z, 30, 1e-6);
  in.normal = {1, 0, -1};
  EXPECT_THAT(refusal(with(in)), HasSubstr("key 'inlet.0.file': its triangles lie up to"));
}

// What walls cover at the face gets no column; the flow goes through the others.
TEST(InletFaces, WallsBeforeTheFaceTakeColumns) {
  InletSpec in = inlet(InletFace::rectangle, {0, 10, 10}, {1, 0, 0});
  in.width = 10, in.height = 10, in.feed = InletFeed::volume_flow;
  Case c = with(in, {wall("floor", {box({-20, -20, -20}, {60, 60, 8})})});
  const Filling filling = fill(c);
  const InletColumns& columns = filling.inlets.at(0);
  EXPECT_EQ(columns.origin.size(), 70U);
  EXPECT_EQ(columns.blocked, 30U);
  EXPECT_DOUBLE_EQ(columns.area, 70);
  EXPECT_NEAR(feed_rate(c, c.inlets[0], columns.area).fastest() * columns.area, 2, 1e-12);
  EXPECT_THAT(filling.warnings, Contains(HasSubstr("inlet 'spout': walls stand before 30 of 100 columns")));
}

TEST(InletFaces, OpenTheirWayThroughWallsAndRegions) {
  InletSpec in = inlet(InletFace::rectangle, {10, 20, 20}, {1, 0, 0});
  in.width = 6, in.height = 6;
  Case c = with(in, {wall("end", {box({0, 0, 0}, {10, 40, 40})})});
  RegionSpec region;
  region.shapes = {box({10, 0, 0}, {14, 40, 40})};
  c.regions = {region};
  const BuiltCase built = build_setup(c);
  const WallParticles& w = built.setup.walls;
  const std::size_t columns = built.setup.inlets.at(0).origin.size();
  ASSERT_EQ(columns, 36U);
  std::size_t behind = 0;
  for (std::size_t i = 0; i < w.position.size(); ++i) {
    const Vec3d p = w.position[i];
    if (p.x > 7 && p.x < 10 && std::abs(p.y - 20) < 3 && std::abs(p.z - 20) < 3) {
      ++behind;
      EXPECT_EQ(w.body[i], 1);
      EXPECT_NEAR(w.depth[i], 10 - p.x, 1e-12);
    }
  }
  EXPECT_EQ(behind, 3 * columns);
  EXPECT_EQ(built.setup.bodies.at(1).name, "spout");
  // No fluid where an inlet's columns are, all of it before them.
  InletSpec inside = in;
  inside.center.x = 13;
  c.inlets = {inside};
  const std::size_t all = built.setup.particles.position.size();
  EXPECT_EQ(build_setup(c).setup.particles.position.size(), all - 3 * 36);
}

TEST(InletFaces, SpeedsAreThoseOfTheFlowOverTheArea) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 4;
  const double area = pi * 16;
  for (const auto& [feed, speed] : {std::pair{InletFeed::velocity, 2.0},
                                    {InletFeed::volume_flow, 2 / area},
                                    {InletFeed::mass_flow, 2 / (1000 * area)}}) {
    in.feed = feed;
    const Case c = with(in);
    EXPECT_NEAR(feed_rate(c, c.inlets[0], columns_of(c).area).at(0.5), speed, 1e-12);
  }
  in.feed = InletFeed::velocity, in.rows = {{1, 0}, {2, 3}};
  const Case c = with(in);
  const FeedRate rate = feed_rate(c, c.inlets[0], area);
  EXPECT_DOUBLE_EQ(rate.at(1.5), 1.5);
  EXPECT_DOUBLE_EQ(rate.at(9), 3);
}

TEST(InletFaces, DevelopedSpeedsHaveTheMeanAndThePeakOfTheParabola) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 10, in.profile = InletProfile::developed;
  const InletColumns disc = columns_of(with(in));
  EXPECT_NEAR(mean(disc.share), 1, 1e-12);
  EXPECT_NEAR(*std::max_element(disc.share.begin(), disc.share.end()), 2, 0.03);
  InletSpec slot = inlet(InletFace::rectangle, {20, 20, 20}, {0, 0, -1});
  slot.width = 30, slot.height = 20, slot.profile = InletProfile::developed;
  const InletColumns columns = columns_of(with(slot));
  EXPECT_NEAR(mean(columns.share), 1, 1e-12);
  EXPECT_NEAR(*std::max_element(columns.share.begin(), columns.share.end()), 1.5, 0.01);
}

TEST(InletFaces, ImpossibleOnesAreRefused) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 0.2;
  EXPECT_THAT(refusal(with(in)), HasSubstr("its face holds no particle"));
  in.radius = 1e30;
  EXPECT_THAT(refusal(with(in)), HasSubstr("key 'inlet.0': its face is 2e+30 m across, the domain 69.2"));
  in.radius = 3, in.center = {20, 20, 60};
  EXPECT_THAT(refusal(with(in)), HasSubstr("key 'inlet.0.center': fluid would come in outside the domain"));
  in.center = {20, 20, 20}, in.value = 0;
  EXPECT_THAT(refusal(with(in)), HasSubstr("feeds nothing: allowed: a flow above 0"));
  in.value = 1;
  EXPECT_THAT(refusal(with(in, {wall("lid", {box({0, 0, 10}, {40, 40, 20})})})),
              HasSubstr("walls stand before all of its face"));
}

TEST(InletFaces, AFlowThatCannotBeIsNamedWithTheSpeedThatFollows) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 3, in.feed = InletFeed::volume_flow, in.value = 1e8;
  EXPECT_THAT(refusal(with(in)),
              HasSubstr("key 'inlet.0.volume_flow': volume_flow = 1e+08 m^3/s through 28.27 m^2 is 3.537e+06 "
                        "m/s: allowed: up to 1e+05 m/s, a tenth of the largest numerics.sound_speed; is it "
                        "meant in l/s, l/min or m^3/h?"));
  in.value = 1e4;
  EXPECT_THAT(fill(with(in)).warnings,
              Contains(HasSubstr("m^2 is 353.7 m/s, faster than anything is poured")));
  in.rows = {{0, 0}, {1, 1e-12}};
  EXPECT_THAT(
      fill(with(in)).warnings,
      Contains(AllOf(HasSubstr("inlet 'spout': volume_flow of up to 1e-12 m^3/s through 28.27 m^2 is "),
                     HasSubstr("rows of particles by the end: nothing comes; is the unit right?"))));
}

// 8 by 6 in a domain of 40.
TEST(InletFaces, APatchInAnotherUnitIsToldItsScale) {
  InletSpec in = inlet(InletFace::stl, {}, {0, 0, -1});
  const auto patch = [&](double scale) {
    const Vec3d a{10 * scale, 10 * scale, 30 * scale}, b{18 * scale, 10 * scale, 30 * scale};
    const Vec3d c{18 * scale, 16 * scale, 30 * scale}, d{10 * scale, 16 * scale, 30 * scale};
    in.stl.file = write_temp_file("patch.stl", binary_stl({Triangle{a, b, c}, Triangle{a, c, d}}));
    return refusal(with(in));
  };
  EXPECT_EQ(patch(1), "none");
  EXPECT_THAT(patch(1000), HasSubstr("with scale = 0.001 it would lie in it; was it drawn in mm?"));
  EXPECT_THAT(patch(1 / 0.0254),
              HasSubstr("with scale = 0.0254 it would lie in it; was it drawn in inches?"));
  in.stl.scale = 1e-3;
  EXPECT_THAT(patch(100), HasSubstr("with scale = 0.01 it would lie in it; was it drawn in cm?"));
}

// One after the other too, and back to back: the bodies are there all the time.
TEST(InletFaces, TwoAtOnePlaceAreRefused) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 4;
  Case c = with(in);
  c.inlets.push_back(in);
  c.inlets[1].name = "other";
  const auto refused =
      HasSubstr("key 'inlet.1': its body, the six spacings behind its face, meets that of inlet 'spout'");
  EXPECT_THAT(refusal(c), refused);
  c.inlets[0].stop = c.inlets[1].start = 3;
  EXPECT_THAT(refusal(c), refused);
  c.inlets[0].stop = WallMotion::never, c.inlets[1].center.z = 22;
  EXPECT_THAT(refusal(c), refused);
  c.inlets[1].center.z = 20, c.inlets[1].center.x = 30;
  EXPECT_EQ(refusal(c), "none");
}

TEST(InletFaces, ThoseThatMeetAcrossAPeriodicFaceAreRefused) {
  InletSpec in = inlet(InletFace::rectangle, {20, 0, 20}, {1, 0, 0});
  in.width = in.height = 6;
  Case c = with(in);
  c.domain.periodic = {false, true, false};
  c.inlets.push_back(in);
  c.inlets[1].name = "other", c.inlets[1].center.y = 40;  // the same face
  EXPECT_THAT(refusal(c), HasSubstr("key 'inlet.1': its body, the six spacings behind its face, meets that"));
  c.inlets[1].center.y = 20;
  EXPECT_EQ(refusal(c), "none");
  c.inlets.pop_back(), c.inlets[0].width = 40;  // once around
  EXPECT_EQ(refusal(c), "none");
  c.inlets[0].width = 50;
  EXPECT_THAT(refusal(c),
              HasSubstr("key 'inlet.0': its body, the six spacings behind its face, meets itself"));
}

// In the open the columns are a body with sides; in a wall they have none.
TEST(InletFaces, HaveSidesWhereFluidMayCome) {
  InletSpec in = inlet(InletFace::rectangle, {20, 20, 20}, {1, 0, 0});
  in.width = 6, in.height = 6;
  const InletColumns open = columns_of(with(in)),
                     held = columns_of(with(in, {wall("end", {box({0, 0, 0}, {20, 40, 40})})}));
  int sides = 0;
  for (std::size_t k = 0; k < open.origin.size(); ++k) {
    const Vec3d off = open.origin[k] - in.center;
    const double least = 3 - std::max(std::abs(off.y), std::abs(off.z));
    EXPECT_NEAR(open.side[k].depth, least, 1e-9);
    EXPECT_NEAR(dot(open.side[k].normal, in.normal), 0, 1e-12);
    EXPECT_EQ(held.side[k].depth, 0);
    ++sides;
  }
  EXPECT_EQ(sides, 36);
}

TEST(OutletBoxes, ThatTakeTooMuchOrTooLittleAreWarnedOf) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 4;
  Case c = with(in);
  RegionSpec region;
  region.shapes = {box({1, 1, 1}, {5, 5, 3})};
  c.regions = {region};
  OutletSpec out;
  out.name = "drain", out.min = {0, 0, 0}, out.max = {40, 40, 2};
  c.outlets = {out};
  EXPECT_THAT(fill(c).warnings, Contains(HasSubstr("outlet 'drain' takes 16 of 32 particles at the start")));
  EXPECT_THAT(fill(c).warnings, Contains(HasSubstr("outlet 'drain' is thinner than 4.0 spacings")));
  c.outlets[0].max.z = 21, c.outlets[0].min.z = 10;
  EXPECT_THAT(fill(c).warnings, Contains(HasSubstr("takes what inlet 'spout' feeds: it covers its face")));
  c.outlets[0].max.z = 9, c.outlets[0].min.z = 4;
  EXPECT_THAT(fill(c).warnings, Not(Contains(HasSubstr("outlet"))));
}

TEST(InletFaces, FewRowsAreWarnedOf) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 20}, {0, 0, -1});
  in.radius = 4, in.stop = 1.5;  // 2 m/s, 3 m
  Case c = with(in);
  c.output.end_time = 9;
  EXPECT_THAT(fill(c).warnings,
              Contains(HasSubstr("inlet 'spout': velocity = 2 m/s, which brings 2.9 rows")));
  c.inlets[0].stop = 6;
  EXPECT_THAT(fill(c).warnings, Not(Contains(HasSubstr("rows of particles"))));
}

TEST(InletFaces, CheckTellsWhatTheyBring) {
  InletSpec in = inlet(InletFace::disc, {20, 20, 30}, {0, 0, -1});
  in.radius = 4, in.feed = InletFeed::mass_flow, in.value = 5e4;
  Case c = with(in);
  c.output.end_time = 10;
  const CaseCheck check = check_case(build_setup(c));
  EXPECT_NEAR(static_cast<double>(check.fed), 500, 50);  // 500 m^3, but for a row
  EXPECT_THAT(to_text(check), HasSubstr("inlet spout"));
  EXPECT_THAT(to_text(check), HasSubstr("5e+04 kg/s"));
  EXPECT_THAT(to_text(check), HasSubstr("of a jet from an inlet that falls to the lowest wall"));
}

Rheology newtonian() { return {RheologyKind::newtonian, {Real(0.5)}}; }

TEST(DevelopedFlow, NewtonianIsTheClosedForm) {
  const SpeedShare slot = developed_slot(newtonian(), 2, 0.3), pipe = developed_pipe(newtonian(), 1, 0.3);
  const double k = 0.4, log_k = std::log(1 / k);  // inner over outer radius
  const SpeedShare ring = developed_annulus(newtonian(), k, 1, 0.3);
  const double scale = (1 + k * k) - (1 - k * k) / log_k;
  for (const double y : {0.0, 0.3, 0.7, 0.95, 1.0}) {
    EXPECT_NEAR(slot(y), 1.5 * (1 - y * y), 2e-3);
    EXPECT_NEAR(slot(-y), slot(y), 1e-12);
    EXPECT_NEAR(pipe(y), 2 * (1 - y * y), 2e-3);
    const double r = k + (1 - k) * y;
    EXPECT_NEAR(ring(r), 2 * (1 - r * r + (1 - k * k) / log_k * std::log(r)) / scale, 4e-3);
  }
}

// A Bingham plug that fills half of a slot: Buckingham's profile.
TEST(DevelopedFlow, BinghamHasItsPlug) {
  const double plug = 0.5, eta = 1, yield = 10, half = 1, wall = yield / plug;
  const double mean_speed = wall * half / (3 * eta) * (1 - 1.5 * plug + 0.5 * plug * plug * plug);
  const SpeedShare share =
      developed_slot({RheologyKind::bingham, {Real(eta), Real(yield), Real(1e4)}}, 2 * half, mean_speed);
  const double top = wall * half / (2 * eta) * (1 - plug) * (1 - plug) / mean_speed;
  for (const double y : {0.0, 0.2, 0.4, 0.45}) EXPECT_NEAR(share(y), top, 0.01);
  for (const double y : {0.6, 0.8, 0.9}) {
    const double s = (y - plug) / (1 - plug);
    EXPECT_NEAR(share(y), top * (1 - s * s), 0.01);
  }
}

TEST(OutletBoxes, PlaneTakesAllBeyondIt) {
  Case c = unit_case();
  OutletSpec out;
  out.name = "end", out.shape = OutletShape::plane, out.direction = {0, 1}, out.position = 8;
  c.outlets = {out};
  const OutletSetup built = build_setup(c).setup.outlets.at(0);
  const OutletBox box{built.lower, built.upper};
  EXPECT_TRUE(box.holds({9, -500, 500}));
  EXPECT_FALSE(box.holds({7.9, 0, 0}));
}

}  // namespace
}  // namespace slagflow
