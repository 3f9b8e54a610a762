// Arithmetic on several pairs at once against the same on single numbers.
#include <gtest/gtest.h>

#include <vector>

#include "fluid/lane_math.hpp"
#include "fluid/params.hpp"

namespace slagflow {
namespace {

using Numbers = std::vector<Real>;

Numbers numbers(Lanes a) {
  Numbers result(lane_count);
  store_lanes(result.data(), a);
  return result;
}

// -1.5, 0.25, 2, ... of either sign.
Numbers samples() {
  Numbers result;
  for (int k = 0; k < lane_count; ++k) result.push_back(Real(1.75) * static_cast<Real>(k) - Real(1.5));
  return result;
}

TEST(Lanes, ArithmeticIsThatOfEachLane) {
  const Numbers from = samples();
  const Lanes a = load_lanes(from.data()), b = Real(3);
  for (int k = 0; k < lane_count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Real x = from[at];
    EXPECT_EQ(numbers(a + b)[at], x + 3);
    EXPECT_EQ(numbers(a - b)[at], x - 3);
    EXPECT_EQ(numbers(a * b)[at], x * 3);
    EXPECT_EQ(numbers(a / b)[at], x / 3);
    EXPECT_EQ(numbers(-a)[at], -x);
    EXPECT_EQ(numbers(select(a < b, a, b))[at], x < 3 ? x : Real(3));
    EXPECT_EQ(numbers(select(a > b, a, b))[at], x > 3 ? x : Real(3));
    EXPECT_EQ(numbers(smaller(a, b))[at], smaller(x, Real(3)));
    EXPECT_EQ(numbers(larger(a, b))[at], larger(x, Real(3)));
    EXPECT_EQ(numbers(magnitude(a))[at], std::fabs(x));
    EXPECT_EQ(numbers(root(magnitude(a)))[at], std::sqrt(std::fabs(x)));
    EXPECT_EQ(numbers(nearest_integer(a))[at], std::rint(x));
  }
}

TEST(Lanes, TotalIsTheSum) {
  Real wanted = 0;
  for (Real x : samples()) wanted += x;  // multiples of 1/4: exact in any order
  EXPECT_EQ(total(load_lanes(samples().data())), wanted);
}

TEST(Lanes, FirstLanesAreThoseBelowTheirNumber) {
  for (Index n = 0; n <= 2 * lane_count; ++n) {
    const unsigned wanted = n >= lane_count ? (1u << lane_count) - 1 : (1u << n) - 1;
    EXPECT_EQ(bits(first_lanes(n)), wanted) << n;
  }
}

TEST(Lanes, GatherTakesTheNamedElements) {
  std::vector<Quad> from;
  for (int k = 0; k < 40; ++k) {
    const auto x = static_cast<Real>(k);
    from.push_back({x, x + 100, x + 200, x + 300});
  }
  std::vector<Index> at;
  for (int k = 0; k < lane_count; ++k) at.push_back((17 * k + 5) % 40);
  const Span<const Quad> span{from.data(), 40};
#if defined(SLAGFLOW_CUDA)
  const Entries named{at[0]};
#else
  const Entries named{at.data()};
#endif
  const QuadLanes q = gather(span, named), run = load_lanes(span, 7);
  for (int k = 0; k < lane_count; ++k) {
    const auto lane = static_cast<std::size_t>(k), j = static_cast<std::size_t>(at[lane]);
    EXPECT_EQ(numbers(q.x)[lane], from[j].x);
    EXPECT_EQ(numbers(q.y)[lane], from[j].y);
    EXPECT_EQ(numbers(q.z)[lane], from[j].z);
    EXPECT_EQ(numbers(q.w)[lane], from[j].w);
    EXPECT_EQ(numbers(run.y)[lane], from[7 + lane].y);
  }
}

// Lanes append to rows that stand one behind the other, up to the last entry and not beyond.
TEST(Lanes, AppendWritesWhatIsSetAndStaysInTheRow) {
  for (unsigned lanes = 0; lanes < 1u << lane_count; ++lanes) {
    std::vector<Index> row(static_cast<std::size_t>(2 * lane_count), -1), wanted = row;
    const auto n = static_cast<std::size_t>(number_of(lanes));
    const Index* end = row.data() + n;
    EXPECT_EQ(append<1>(row.data(), end, 100, lanes), end);
    std::size_t next = 0;
    for (int k = 0; k < lane_count; ++k)
      if (lanes >> k & 1) wanted[next++] = 100 + k;
    EXPECT_EQ(row, wanted) << lanes;
  }
}

TEST(Lanes, SeparationTakesTheNearestImage) {
  const PeriodicBox box{{2, 0, 4}, {Real(0.5), 0, Real(0.25)}};
  const Numbers from = samples();
  const LaneVec3 a{load_lanes(from.data()), Real(0.5), load_lanes(from.data())};
  const LaneVec3 d = box.separation(a, in_lanes({Real(0.125), 1, Real(0.125)}));
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Vec3 wanted = box.separation(Vec3{from[k], Real(0.5), from[k]}, Vec3{Real(0.125), 1, Real(0.125)});
    EXPECT_EQ((Vec3{numbers(d.x)[k], numbers(d.y)[k], numbers(d.z)[k]}), wanted);
  }
}

}  // namespace
}  // namespace slagflow
