// Sort, scan and reduce against the standard library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "backend/buffer.hpp"
#include "backend/device.hpp"
#include "backend/primitives.hpp"

namespace slagflow {
namespace {

using Keys = std::vector<std::uint64_t>;

class Primitives : public testing::Test {
 protected:
  // Sorts copies; returns the values.
  std::vector<Index> sorted(Keys& keys) {
    std::vector<Index> values(keys.size());
    std::iota(values.begin(), values.end(), 0);
    const auto n = static_cast<Offset>(keys.size());
    Buffer<std::uint64_t> key(context_, "keys"), spare_key(context_, "keys", n);
    Buffer<Index> value(context_, "values"), spare_value(context_, "values", n);
    key.upload(keys), value.upload(values);
    sort_by_key(context_, key.span(), value.span(), {spare_key.span(), spare_value.span()}, 64);
    key.download(keys), value.download(values);
    return values;
  }

  std::vector<Offset> scanned(const std::vector<Offset>& counts) {
    Buffer<Offset> in(context_, "counts"), out(context_, "starts", static_cast<Offset>(counts.size()) + 1);
    in.upload(counts);
    exclusive_scan(context_, in.span(), out.span());
    std::vector<Offset> result;
    out.download(result);
    return result;
  }

  double summed(const std::vector<double>& values) {
    Buffer<double> buffer(context_, "values");
    buffer.upload(values);
    return sum(context_, buffer.span());
  }

  double largest(const std::vector<double>& values, double floor) {
    Buffer<double> buffer(context_, "values");
    buffer.upload(values);
    return maximum(context_, buffer.span(), floor);
  }

  ~Primitives() override { set_threads(threads_); }

  Context context_;
  int threads_ = device_info().threads;
};

TEST_F(Primitives, SortIsStableAndUsesAll64Bits) {
  std::mt19937_64 random(7);
  Keys keys(20000);
  for (auto& k : keys) k = (random() % 50) << 58 | random() % 3;  // many equal ones, high and low bits
  std::vector<Index> wanted(keys.size());
  std::iota(wanted.begin(), wanted.end(), 0);
  const Keys original = keys;
  std::stable_sort(wanted.begin(), wanted.end(), [&](Index a, Index b) { return original[a] < original[b]; });
  EXPECT_EQ(sorted(keys), wanted);
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
}

TEST_F(Primitives, SortTakesKeysAsUnsigned) {
  Keys keys{std::uint64_t(1) << 63, 1, ~std::uint64_t(0), 0};
  EXPECT_EQ(sorted(keys), (std::vector<Index>{3, 1, 0, 2}));
}

TEST_F(Primitives, SortOfNothingAndOfOneWorks) {
  Keys none, one{5};
  EXPECT_TRUE(sorted(none).empty());
  EXPECT_EQ(sorted(one), std::vector<Index>{0});
}

TEST_F(Primitives, ScanCountsBeyond32Bits) {
  const std::vector<Offset> counts{3, 0, Offset(1) << 33, 5};
  EXPECT_EQ(scanned(counts), (std::vector<Offset>{0, 3, 3, (Offset(1) << 33) + 3, (Offset(1) << 33) + 8}));
}

TEST_F(Primitives, ScanMatchesPartialSums) {
  std::vector<Offset> counts(10007), wanted{0};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = static_cast<Offset>(i * i % 97);
    wanted.push_back(wanted.back() + counts[i]);
  }
  EXPECT_EQ(scanned(counts), wanted);
}

// A list of 10^8 particles with 100 neighbours each has 10^10 entries.
TEST_F(Primitives, ScanGoesBeyond32Bits) {
  const std::vector<Offset> places = scanned(std::vector<Offset>(5000, 2000000));
  EXPECT_EQ(places.back(), Offset(10000000000));
}

TEST_F(Primitives, ScanOfNothingIsZero) { EXPECT_EQ(scanned({}), std::vector<Offset>{0}); }

std::vector<double> numbers_of_all_sizes(std::size_t n) {
  std::mt19937 random(3);
  std::vector<double> values(n);
  for (double& v : values)
    v = std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 40));
  return values;
}

TEST_F(Primitives, SumIsTheSameToTheBitForAnyNumberOfThreads) {
  const auto values = numbers_of_all_sizes(100003);
  set_threads(1);
  const double one = summed(values);
  for (int threads : {2, 3, 8}) {
    set_threads(threads);
    const double more = summed(values);
    EXPECT_EQ(one, more) << threads << " threads";
  }
}

TEST_F(Primitives, SumMatchesLongDouble) {
  const auto values = numbers_of_all_sizes(100003);
  long double wanted = 0, sizes = 0;
  for (double v : values) wanted += v, sizes += std::fabs(v);
  // Rounding of a sum in chunks of a few thousand: far below n epsilon.
  EXPECT_NEAR(summed(values), static_cast<double>(wanted), 1e-13 * static_cast<double>(sizes));
}

TEST_F(Primitives, SumOfNothingIsZeroAndOfNotANumberIsNotANumber) {
  EXPECT_EQ(summed({}), 0);
  EXPECT_EQ(summed({1.5}), 1.5);
  EXPECT_TRUE(std::isnan(summed({1, std::nan(""), 2})));
}

TEST_F(Primitives, MaximumFindsTheLargestAnywhere) {
  for (std::size_t at : {std::size_t(0), std::size_t(4095), std::size_t(4096), std::size_t(9999)}) {
    std::vector<double> values(10000, -3);
    values[at] = 2;
    EXPECT_EQ(largest(values, -10), 2) << at;
  }
}

TEST_F(Primitives, MaximumHasAFloor) {
  EXPECT_EQ(largest({}, -7), -7);
  EXPECT_EQ(largest({-3}, -1), -1);
  EXPECT_EQ(largest({-3}, -5), -3);
}

TEST_F(Primitives, MaximumKeepsNotANumberWhereverItStands) {
  for (std::size_t at :
       {std::size_t(0), std::size_t(1), std::size_t(4095), std::size_t(4096), std::size_t(9999)}) {
    std::vector<double> values(10000, 1);
    values[at] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(largest(values, 0))) << at;
  }
  EXPECT_EQ(largest({1, std::numeric_limits<double>::infinity()}, 0),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace slagflow
