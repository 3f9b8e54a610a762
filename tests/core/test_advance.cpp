// The last part of a step.
#include <gtest/gtest.h>

#include "advance.hpp"
#include "scene.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

class Advance : public testing::Test {
 protected:
  Advance() {
    fluid_.resize(3);
    fluid_.position.upload({{1, 2, 3}, {0.1, 0.2, 0.3}, {-1, 0, 5}});
    fluid_.place.upload({{1, 2, 3, 7}, {Real(0.1), Real(0.2), Real(0.3), 8}, {-1, 0, 5, 9}});
    fluid_.motion.upload(std::vector<Quad>(3, Quad{0, 0, 0, 11}));
    velocity_.upload({{1, 0, 0, 0}, {0, 3, 4, 0}, {0, 0, -2, 0}});
    reference_.upload({{1, 2, 3, 0}, {Real(0.1), Real(0.2), Real(0.3), 0}, {-1, 0, 5, 0}});
  }

  Context context_;
  FluidArrays fluid_{context_};
  Buffer<Quad> velocity_{context_, "velocity"}, reference_{context_, "reference"};
  Buffer<Real> scratch_{context_, "scratch"};
};

TEST_F(Advance, MovesByVelocityTimesStepInDoublePrecision) {
  const double step = 1e-9;  // single precision would not see it
  advance_particles(context_, fluid_, {velocity_.span(), step}, reference_, scratch_);
  const auto position = download(context_, fluid_.position.span());
  EXPECT_EQ(position[0], (Vec3d{1 + step, 2, 3}));
  EXPECT_EQ(position[1], (Vec3d{0.1, 0.2 + 3 * step, 0.3 + 4 * step}));
  EXPECT_EQ(position[2], (Vec3d{-1, 0, 5 - 2 * step}));
}

TEST_F(Advance, KeepsVolumeAndDensityAndRoundsThePlace) {
  advance_particles(context_, fluid_, {velocity_.span(), 0.25}, reference_, scratch_);
  const auto place = download(context_, fluid_.place.span());
  const auto motion = download(context_, fluid_.motion.span());
  EXPECT_EQ(xyz(place[0]), (Vec3{Real(1.25), 2, 3}));
  EXPECT_EQ(place[0].w, 7);
  EXPECT_EQ(xyz(motion[1]), (Vec3{0, 3, 4}));
  EXPECT_EQ(motion[1].w, 11);
}

TEST_F(Advance, ReportsTheLargestDisplacementAndSpeed) {
  EXPECT_NEAR(advance_particles(context_, fluid_, {velocity_.span(), 0.25}, reference_, scratch_), 1.25,
              1e-6);
  EXPECT_NEAR(advance_particles(context_, fluid_, {velocity_.span(), 0.25}, reference_, scratch_), 2.5, 1e-6);
  EXPECT_EQ(largest_speed(context_, fluid_, scratch_), 5);
}

TEST_F(Advance, NotANumberIsReported) {
  velocity_.upload({{1, 0, 0, 0}, {0, static_cast<Real>(std::nan("")), 0, 0}, {0, 0, 0, 0}});
  EXPECT_TRUE(std::isnan(advance_particles(context_, fluid_, {velocity_.span(), 0.1}, reference_, scratch_)));
}

TEST_F(Advance, OfNothingIsZero) {
  fluid_.resize(0);
  EXPECT_EQ(advance_particles(context_, fluid_, {velocity_.span(), 0.1}, reference_, scratch_), 0);
  EXPECT_EQ(largest_speed(context_, fluid_, scratch_), 0);
}

}  // namespace
}  // namespace slagflow
