// The last part of a step.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "simulation/advance.hpp"

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
    fluid_.fluid.upload({0, 1, 0});
    FluidConstants light, heavy;
    light.rest_density = 1000, heavy.rest_density = 4000;
    fluids_.upload({light, heavy});
  }

  // The largest displacement.
  double advance(double step) {
    std::vector<StepRecord> record(1);
    record[0].solve.converged = 1;
    record_.upload(record);
    advance_particles(context_, fluid_, {velocity_.span(), step, reference_.span(), fluids_.span()},
                      record_.span().data);
    record_.download(record);
    compression_ = record[0].compression;
    return std::sqrt(record[0].displacement_squared);
  }

  Context context_;
  Buffer<StepRecord> record_{context_, "record"};
  FluidArrays fluid_{context_};
  Buffer<FluidConstants> fluids_{context_, "fluids"};
  double compression_ = 0;
  Buffer<Quad> velocity_{context_, "velocity"}, reference_{context_, "reference"};
  DiagnosticScratch scratch_{context_};
};

TEST_F(Advance, MovesByVelocityTimesStepInDoublePrecision) {
  const double step = 1e-9;  // single precision would not see it
  advance(step);
  const auto position = download(context_, fluid_.position.span());
  EXPECT_EQ(position[0], (Vec3d{1 + step, 2, 3}));
  EXPECT_EQ(position[1], (Vec3d{0.1, 0.2 + 3 * step, 0.3 + 4 * step}));
  EXPECT_EQ(position[2], (Vec3d{-1, 0, 5 - 2 * step}));
}

TEST_F(Advance, KeepsVolumeAndDensityAndRoundsThePlace) {
  advance(0.25);
  const auto place = download(context_, fluid_.place.span());
  const auto motion = download(context_, fluid_.motion.span());
  EXPECT_EQ(xyz(place[0]), (Vec3{Real(1.25), 2, 3}));
  EXPECT_EQ(place[0].w, 7);
  EXPECT_EQ(xyz(motion[1]), (Vec3{0, 3, 4}));
  EXPECT_EQ(motion[1].w, 11);
}

TEST_F(Advance, ReportsTheLargestDisplacementAndSpeed) {
  EXPECT_NEAR(advance(0.25), 1.25, 1e-6);
  EXPECT_NEAR(advance(0.25), 2.5, 1e-6);
  EXPECT_EQ(largest_speed(context_, fluid_, scratch_), 5);
}

TEST_F(Advance, ReportsTheLargestCompressionByEachFluidsOwnDensity) {
  fluid_.motion.upload({{0, 0, 0, 20}, {0, 0, 0, 40}, {0, 0, 0, -50}});
  advance(0.25);
  EXPECT_FLOAT_EQ(static_cast<float>(compression_), 0.02f);
  fluid_.motion.upload({{0, 0, 0, -20}, {0, 0, 0, -40}, {0, 0, 0, -50}});
  advance(0.25);
  EXPECT_EQ(compression_, 0);  // of thin fluid
}

TEST_F(Advance, NotANumberIsReported) {
  velocity_.upload({{1, 0, 0, 0}, {0, static_cast<Real>(std::nan("")), 0, 0}, {0, 0, 0, 0}});
  EXPECT_TRUE(std::isnan(advance(0.1)));
}

TEST_F(Advance, OfNothingIsZero) {
  fluid_.resize(0);
  EXPECT_EQ(advance(0.1), 0);
  EXPECT_EQ(largest_speed(context_, fluid_, scratch_), 0);
}

}  // namespace
}  // namespace slagflow
