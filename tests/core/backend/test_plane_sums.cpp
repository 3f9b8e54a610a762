// Sums over rows in planes: the same bits however whole planes are dealt out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "backend/buffer.hpp"
#include "backend/device.hpp"
#include "backend/plane_table.hpp"
#include "backend/primitives.hpp"

namespace slagflow {
namespace {

using Values = std::vector<double>;
using Sizes = std::vector<Index>;  // rows of each plane

Values numbers_of_all_sizes(std::size_t n) {
  std::mt19937 random(5);
  Values values(n);
  for (double& v : values)
    v = std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 90) - 60);
  return values;
}

// A few planes of many sizes, some of them empty.
Sizes many_planes() {
  Sizes sizes{0, 1, 127, 128, 129, 0, 0, 255, 256, 257, 2000, 3000, 64, 1023, 1024, 1025};
  for (Index k = 0; k < 40; ++k) sizes.push_back(k * 37 % 300);
  return sizes;
}

std::vector<Index> starts_of(const Sizes& sizes) {
  std::vector<Index> starts{0};
  for (const Index size : sizes) starts.push_back(starts.back() + size);
  return starts;
}

std::size_t all_rows(const Sizes& sizes) { return static_cast<std::size_t>(starts_of(sizes).back()); }

// Adds neighbours at half the distance until one is left, as a warp does.
double as_tree(Values v) {
  for (std::size_t half = v.size() / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) v[i] += v[i + half];
  return v[0];
}

// The order that reduce.hpp promises, told in another way.
double chunk_by_chunk(const Values& values, std::size_t first, std::size_t end) {
  Values lanes(8), chunk(static_cast<std::size_t>(chunk_rows));
  for (std::size_t c = 0; first < end; ++c, first += chunk.size()) {
    for (std::size_t k = 0; k < chunk.size(); ++k) chunk[k] = first + k < end ? values[first + k] : 0;
    double sum = 0;
    for (auto warp = chunk.begin(); warp < chunk.end(); warp += 32) sum += as_tree({warp, warp + 32});
    lanes[c % lanes.size()] += sum;
  }
  return as_tree(lanes);
}
double plane_by_plane(const Values& values, const Sizes& sizes) {
  double sum = 0;
  std::size_t first = 0;
  for (const Index size : sizes) {
    sum += chunk_by_chunk(values, first, first + static_cast<std::size_t>(size));
    first += static_cast<std::size_t>(size);
  }
  return sum + chunk_by_chunk(values, first, values.size());
}

class PlaneSums : public testing::Test {
 protected:
  Rows in_planes(const Sizes& sizes, std::size_t rows) {
    const auto n = static_cast<Index>(rows);
    start_.upload(starts_of(sizes));
    table_.find({start_.span(), 1, static_cast<Index>(sizes.size())}, n);
    return {n, n, nullptr, table_.view()};
  }

  // Values beyond the planes are behind them.
  double summed(const Values& values, const Sizes& sizes) {
    values_.upload(values);
    return sum(context_, values_.span(), in_planes(sizes, values.size()));
  }
  double summed(const Values& values) {
    values_.upload(values);
    return sum(context_, values_.span());
  }

  // Each rank has the planes [cuts[r], cuts[r + 1]) and a table of its own; of a plane's sum it makes use of
  // zeros elsewhere.
  double by_ranks(const Values& values, const Sizes& sizes, const std::vector<std::size_t>& cuts) {
    double all = 0;
    const std::vector<Index> start = starts_of(sizes);
    for (std::size_t r = 0; r + 1 < cuts.size(); ++r) {
      const Sizes own(sizes.begin() + static_cast<Offset>(cuts[r]),
                      sizes.begin() + static_cast<Offset>(cuts[r + 1]));
      for (std::size_t plane = cuts[r]; plane < cuts[r + 1]; ++plane) {
        Values of_plane(all_rows(own));
        std::copy(values.begin() + start[plane], values.begin() + start[plane + 1],
                  of_plane.begin() + (start[plane] - start[cuts[r]]));
        all += summed(of_plane, own);
      }
    }
    return all;
  }

  // What ranks without planes would do.
  double by_ranks_plainly(const Values& values, const Sizes& sizes, const std::vector<std::size_t>& cuts) {
    double all = 0;
    const std::vector<Index> start = starts_of(sizes);
    for (std::size_t r = 0; r + 1 < cuts.size(); ++r)
      all += summed(Values(values.begin() + start[cuts[r]], values.begin() + start[cuts[r + 1]]));
    return all;
  }

  ~PlaneSums() override { set_threads(threads_); }

  Context context_;
  Buffer<double> values_{context_, "values"};
  Buffer<Index> start_{context_, "starts"};
  PlaneTable table_{context_};
  int threads_ = device_info().threads;
};

std::vector<std::size_t> evenly(std::size_t planes, std::size_t ranks) {
  std::vector<std::size_t> cuts;
  for (std::size_t r = 0; r <= ranks; ++r) cuts.push_back(planes * r / ranks);
  return cuts;
}

TEST_F(PlaneSums, AreTheSameForAnyNumberOfRanks) {
  const Sizes sizes = many_planes();
  const Values values = numbers_of_all_sizes(all_rows(sizes));
  const double wanted = summed(values, sizes);
  std::set<double> plain;
  for (const std::size_t ranks : {1, 2, 3, 4}) {
    const auto cuts = evenly(sizes.size(), ranks);
    EXPECT_EQ(by_ranks(values, sizes, cuts), wanted) << ranks << " ranks";
    plain.insert(by_ranks_plainly(values, sizes, cuts));
  }
  EXPECT_GT(plain.size(), 1U) << "plain sums agree, too: nothing is tested";
}

TEST_F(PlaneSums, AreTheSameForAnyCuts) {
  const Sizes sizes = many_planes();
  const Values values = numbers_of_all_sizes(all_rows(sizes));
  const double wanted = summed(values, sizes);
  std::mt19937 random(9);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<std::size_t> cuts{0, sizes.size()};
    for (int k = 0; k < 3; ++k) cuts.push_back(random() % sizes.size());  // a rank may have no plane
    std::sort(cuts.begin(), cuts.end());
    EXPECT_EQ(by_ranks(values, sizes, cuts), wanted) << trial;
  }
}

TEST_F(PlaneSums, GoInTheOrderThatIsPromisedOnBothBackEnds) {
  const Sizes sizes = many_planes();
  for (const std::size_t behind : {0, 1, 127, 128, 129, 3000}) {
    const Values values = numbers_of_all_sizes(all_rows(sizes) + behind);
    EXPECT_EQ(summed(values, sizes), plane_by_plane(values, sizes)) << behind << " behind the planes";
  }
}

TEST_F(PlaneSums, EmptyPlanesChangeNothing) {
  const Sizes sizes{128, 1, 300, 127, 129};
  const Sizes among{0, 128, 0, 0, 1, 300, 0, 127, 129, 0};
  const Values values = numbers_of_all_sizes(all_rows(sizes));
  EXPECT_EQ(summed(values, among), summed(values, sizes));
}

TEST_F(PlaneSums, EachRowCountsOnce) {
  const std::vector<Sizes> all{{0}, {1}, {127}, {128}, {129}, {0, 0, 0}, {5, 0, 129, 0}, many_planes()};
  for (const Sizes& sizes : all)
    for (const std::size_t behind : {0, 1, 128, 300}) {
      Values values(all_rows(sizes) + behind);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i + 1);
      const auto n = static_cast<double>(values.size());
      EXPECT_EQ(summed(values, sizes), n * (n + 1) / 2) << sizes.size() << " planes, " << behind;
    }
}

TEST_F(PlaneSums, AreTheSameForAnyNumberOfThreads) {
  const Sizes sizes = many_planes();
  const Values values = numbers_of_all_sizes(all_rows(sizes) + 500);
  set_threads(1);
  const double wanted = summed(values, sizes);
  for (const int threads : {2, 3}) {
    set_threads(threads);
    EXPECT_EQ(summed(values, sizes), wanted) << threads << " threads";
  }
}

TEST_F(PlaneSums, AreExactToRounding) {
  const Sizes sizes = many_planes();
  const Values values = numbers_of_all_sizes(all_rows(sizes) + 100000);
  long double wanted = 0, size = 0;
  for (const double v : values) wanted += v, size += std::fabs(v);
  EXPECT_NEAR(summed(values, sizes), static_cast<double>(wanted), 1e-15 * static_cast<double>(size));
  EXPECT_NEAR(summed(values), static_cast<double>(wanted), 1e-15 * static_cast<double>(size));
}

TEST_F(PlaneSums, NotANumberShowsWhereverItStands) {
  const Sizes sizes{0, 128, 5, 200};
  for (const std::size_t at : {0, 127, 128, 132, 133, 332, 333, 399}) {
    Values values(400, 1.0);
    values[at] = std::nan("");
    EXPECT_TRUE(std::isnan(summed(values, sizes))) << at;
  }
}

TEST_F(PlaneSums, ChunksBeginWithPlanes) {
  const Rows rows = in_planes({0, 1, 128, 0, 129, 300, 0}, 600);
  std::vector<Offset> first_chunk(9);
  context_.copy_to_host(first_chunk.data(), rows.planes.first_chunk, first_chunk.size() * sizeof(Offset));
  EXPECT_EQ(first_chunk, (std::vector<Offset>{0, 0, 1, 2, 2, 4, 7, 7, 558}));
  std::vector<Index> first_row(8);
  context_.copy_to_host(first_row.data(), rows.planes.first_row, first_row.size() * sizeof(Index));
  EXPECT_EQ(first_row, (std::vector<Index>{0, 1, 129, 257, 258, 386, 514, 558}));
}

// What is recorded for a graph knows the tables by their place.
TEST_F(PlaneSums, TablesKeepTheirPlaceAsPlanesFillAndEmpty) {
  const Rows one = in_planes({600, 0, 0}, 600);
  const std::uint64_t generation = context_.generation();
  for (const Sizes& sizes : {Sizes{1, 1, 1}, Sizes{0, 0, 600}, Sizes{200, 200, 200}}) {
    const Rows other = in_planes(sizes, 600);
    EXPECT_EQ(other.planes.first_chunk, one.planes.first_chunk);
    EXPECT_EQ(other.planes.first_row, one.planes.first_row);
  }
  EXPECT_EQ(context_.generation(), generation);
  in_planes({300, 300}, 600);
  EXPECT_NE(context_.generation(), generation) << "another number of planes is part of what is launched";
}

}  // namespace
}  // namespace slagflow
