// Weights of viscous pairs in 16 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/viscous_scene.hpp"
#include "viscosity/pair_weights.hpp"
#include "viscosity/predictor.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

double kept(double weight, double unit) {
  return unit * static_cast<double>(lengthen(shorten(static_cast<float>(weight / unit))));
}

TEST(PairWeights, AreKeptToElevenBits) {
  Random random(5);
  for (const double middle : {1e-20, 3e-7, 1.0, 4e6}) {
    const double unit = short_weight_unit(middle);
    double worst = 0, sum = 0;
    constexpr int tried = 20000;
    for (int k = 0; k < tried; ++k) {
      const double weight = middle * std::exp2(random.uniform(-28, 32));
      const double error = kept(weight, unit) / weight - 1;
      worst = std::max(worst, std::fabs(error)), sum += error;
    }
    EXPECT_LE(worst, std::ldexp(1.0001, -11)) << middle;
    EXPECT_GT(worst, std::ldexp(0.9, -11)) << middle;
    EXPECT_LT(std::fabs(sum / tried), 1e-5) << middle;  // to nearest: they do not add up
  }
}

TEST(PairWeights, BeyondTheirRangeFadeOutOrAreTheLargest) {
  const double unit = short_weight_unit(1), top = std::ldexp(1.0, 34);
  EXPECT_EQ(kept(0, unit), 0);
  EXPECT_EQ(kept(std::ldexp(1.0, -60), unit), 0);
  double last = 0;
  for (int exponent = -45; exponent < 60; ++exponent) {
    const double now = kept(std::ldexp(1.0, exponent), unit);
    EXPECT_GE(now, last);
    EXPECT_LE(now, top);
    last = now;
  }
  EXPECT_GT(last, 0.9 * top);
}

// The units of runs of micrometres and of kilometres are numbers of single precision, and so is one over
// them.
TEST(PairWeights, HaveAUnitThatSinglePrecisionHolds) {
  for (int exponent = -300; exponent <= 300; exponent += 10) {
    const double unit = short_weight_unit(std::pow(10.0, exponent));
    EXPECT_TRUE(std::isnormal(static_cast<float>(unit)));
    EXPECT_TRUE(std::isnormal(static_cast<float>(1 / unit)));
    int power = 0;
    EXPECT_EQ(std::frexp(unit, &power), 0.5);
  }
}

// The system with weights of either kind.
struct BothKinds {
  explicit BothKinds(Scene& s) : scene(s), device(s), brief(s.context, "weights", s.fluid_list.capacity()) {
    PredictorOutput out = device.output();
    predict_and_assemble(s.context, s.pairs(), out, Real(2e-3), Real(1));
    out.weight = {brief.span(), unit};
    predict_and_assemble(s.context, s.pairs(), out, Real(2e-3), Real(1));
  }
  std::vector<double> weights(bool in_full) const {
    std::vector<double> result;
    if (in_full)
      for (const Real w : download(scene.context, device.weight.span()))
        result.push_back(static_cast<double>(w));
    else
      for (const ShortWeight w : download(scene.context, brief.span()))
        result.push_back(unit * static_cast<double>(lengthen(w)));
    return result;
  }
  Scene& scene;
  DeviceSystem device;
  double unit = short_weight_unit(1e-7);
  Buffer<ShortWeight> brief;
};

// Viscosities over three decades and two fluids: both rows of a pair keep the same weight.
TEST(PairWeights, AreTheSameInBothRowsOfAPair) {
  SceneOptions options;
  options.particles_across = 8;
  Scene scene(options);
  scene.upload();
  const BothKinds both(scene);
  const HostList list(scene.context, scene.fluid_list.view());
  for (const bool in_full : {true, false}) {
    const std::vector<double> weight = both.weights(in_full);
    const auto of = [&](Index i, Index k) {
      return weight[static_cast<std::size_t>(list.view().entries(i).at(k))];
    };
    int pairs = 0;
    for (Index i = 0; i < scene.fluid.count; ++i)
      for (Index k = 0; k < list.length[static_cast<std::size_t>(i)]; ++k) {
        const Index j = list.view().entries(i).one(k);
        const std::vector<Index> other = list.row(j);
        const auto back = std::find(other.begin(), other.end(), i) - other.begin();
        ASSERT_LT(back, static_cast<std::ptrdiff_t>(other.size()));
        EXPECT_EQ(of(i, k), of(j, static_cast<Index>(back)));
        pairs += of(i, k) > 0;
      }
    EXPECT_GT(pairs, 10000);
  }
}

// A row is off by some 1e-4 of its terms, and by no more than 2^-11 of them.
TEST(PairWeights, OfARowAreOffByTenThousandths) {
  SceneOptions options;
  options.particles_across = 8;
  Scene scene(options);
  scene.upload();
  const BothKinds both(scene);
  const HostList list(scene.context, scene.fluid_list.view());
  const std::vector<double> full = both.weights(true), brief = both.weights(false);
  double squares = 0;
  for (Index i = 0; i < scene.fluid.count; ++i) {
    double sum = 0, error = 0;
    for (Index k = 0; k < list.length[static_cast<std::size_t>(i)]; ++k) {
      const auto at = static_cast<std::size_t>(list.view().entries(i).at(k));
      sum += full[at], error += brief[at] - full[at];
    }
    if (!(sum > 0)) continue;
    EXPECT_LE(std::fabs(error), std::ldexp(1.0, -11) * sum);
    squares += square(error / sum);
  }
  const double rms = std::sqrt(squares / scene.fluid.count);
  EXPECT_LT(rms, 1.5e-4);
  EXPECT_GT(rms, 1e-6);  // or they were not short
}

}  // namespace
}  // namespace slagflow
