// Neighbour lists against loops over all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "core/cleared_arrays.hpp"
#include "core/scene.hpp"
#include "neighbours/neighbours.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

using Points = std::vector<Vec3>;

// A box with cells `cell_ratio` reaches wide.
struct Space {
  Vec3d extent{1, 1, 1};
  std::array<bool, 3> periodic{false, false, false};
  double reach = 0.11;
  double cell_ratio = 1;

  PeriodicBox box() const {
    PeriodicBox b;
    for (int k = 0; k < 3; ++k)
      if (periodic[static_cast<std::size_t>(k)])
        b.period[k] = static_cast<Real>(extent[k]), b.inverse[k] = static_cast<Real>(1 / extent[k]);
    return b;
  }
};

// Squared distance of the nearest images, with the device's rounding of positions only.
double distance_squared(const Space& s, Vec3 a, Vec3 b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    double d = std::fabs(static_cast<double>(a[k]) - static_cast<double>(b[k]));
    if (s.periodic[static_cast<std::size_t>(k)])
      d = std::min(std::fmod(d, s.extent[k]), s.extent[k] - std::fmod(d, s.extent[k]));
    sum += d * d;
  }
  return sum;
}

class Neighbours : public testing::Test {
 protected:
  // Sorts the sources by cell; `sorted` becomes their places in the device's order.
  SourceView sort(const Space& s, const Points& points) {
    clear(wall_, points.size());
    std::vector<Quad> place;
    std::vector<Index> id;
    for (Vec3 p : points) place.push_back(quad(p, 0)), id.push_back(static_cast<Index>(id.size()));
    wall_.place.upload(place), wall_.id.upload(id);
    const CellGrid grid = CellGrid::cover(s.extent, s.periodic, s.cell_ratio * s.reach);
    ordering_ = std::make_unique<Ordering>(context_, s.extent, s.periodic, grid);
    ordering_->sort(wall_);
    sorted_.clear();
    for (Quad q : download(context_, wall_.place.span())) sorted_.push_back(xyz(q));
    return ordering_->wall_sources(wall_);
  }

  void expect_all_pairs(const Space& s, const Points& targets, const HostList& list, bool self) {
    const double reach = rounded(s.reach), slack = 20 * epsilon * norm(s.extent) / reach;
    ASSERT_EQ(list.length.size(), targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const auto row = list.row(static_cast<Index>(i));
      EXPECT_EQ(std::set<Index>(row.begin(), row.end()).size(), row.size()) << "twice in row " << i;
      EXPECT_TRUE(std::is_sorted(row.begin(), row.end())) << "row " << i;
      for (std::size_t j = 0; j < sorted_.size(); ++j) {
        const double ratio = std::sqrt(distance_squared(s, targets[i], sorted_[j])) / reach;
        if (std::fabs(ratio - 1) < slack) continue;  // rounding decides
        const bool wanted = ratio < 1 && !(self && i == j);
        const bool found = std::find(row.begin(), row.end(), static_cast<Index>(j)) != row.end();
        ASSERT_EQ(found, wanted) << "target " << i << ", source " << j << ", distance/reach " << ratio;
      }
    }
  }

  void check_self(const Space& s, const Points& points) {
    const SourceView sources = sort(s, points);
    NeighbourList list(context_, "pairs");
    list.build(sources, wall_.place.span(), s.box(), static_cast<Real>(s.reach), NeighbourList::Pairs::self);
    expect_all_pairs(s, sorted_, HostList(context_, list.view()), true);
  }

  void check_other(const Space& s, const Points& points, const Points& targets) {
    const SourceView sources = sort(s, points);
    Buffer<Quad> target(context_, "targets");
    std::vector<Quad> place;
    for (Vec3 p : targets) place.push_back(quad(p, 0));
    target.upload(place);
    NeighbourList list(context_, "pairs");
    list.build(sources, target.span(), s.box(), static_cast<Real>(s.reach), NeighbourList::Pairs::other);
    expect_all_pairs(s, targets, HostList(context_, list.view()), false);
  }

  Context context_;
  WallArrays wall_{context_};
  std::unique_ptr<Ordering> ordering_;
  Points sorted_;
};

Points random_points(std::size_t n, unsigned seed, Vec3d low, Vec3d high) {
  Random random(seed);
  Points points(n);
  for (Vec3& p : points)
    for (int k = 0; k < 3; ++k) p[k] = static_cast<Real>(random.uniform(low[k], high[k]));
  return points;
}

TEST_F(Neighbours, OfRandomPointsMatchBruteForce) {
  check_self({}, random_points(700, 1, {0, 0, 0}, {1, 1, 1}));
}

TEST_F(Neighbours, OfClustersMatchBruteForce) {
  Points points = random_points(60, 2, {0, 0, 0}, {1, 1, 1});
  for (const Vec3& p : Points(points.begin(), points.begin() + 6))
    for (const Vec3& q : random_points(80, 3, {-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}))
      points.push_back(p + q);
  check_self({}, points);
}

TEST_F(Neighbours, OfCoincidentPointsAreAllListed) {
  const Points points(40, Vec3{Real(0.3), Real(0.4), Real(0.5)});
  check_self({}, points);
}

TEST_F(Neighbours, OutsideOfTheGridAreFound) {
  check_self({}, random_points(400, 4, {-0.4, -0.4, -0.4}, {0.3, 0.3, 0.3}));
  check_self({}, random_points(400, 5, {0.8, 0.8, 0.8}, {1.4, 1.4, 1.4}));
}

TEST_F(Neighbours, OnCellBordersAndCornersMatchBruteForce) {
  Space s;
  Points points;
  const auto step = Real(0.125);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        points.push_back(
            {step * static_cast<Real>(i), step * static_cast<Real>(j), step * static_cast<Real>(k)});
  s.reach = 0.126;
  check_self(s, points);
}

TEST_F(Neighbours, OfNothingAndOfOneAreEmpty) {
  check_self({}, {});
  check_self({}, {Vec3{Real(0.5), Real(0.5), Real(0.5)}});
  check_other({}, {}, random_points(10, 1, {0, 0, 0}, {1, 1, 1}));
  check_other({}, random_points(10, 1, {0, 0, 0}, {1, 1, 1}), {});
}

TEST_F(Neighbours, OfOtherTargetsMatchBruteForce) {
  check_other({}, random_points(500, 6, {-0.1, -0.1, -0.1}, {1, 1, 1}),
              random_points(77, 7, {-0.2, 0, 0}, {1.2, 1, 1}));
}

TEST_F(Neighbours, AcrossPeriodicFacesMatchBruteForce) {
  for (unsigned axes = 1; axes < 8; ++axes) {
    Space s;
    for (unsigned k = 0; k < 3; ++k) s.periodic[k] = axes >> k & 1;
    check_self(s, random_points(400, axes, {0, 0, 0}, {1, 1, 1}));
    check_other(s, random_points(300, axes, {0, 0, 0}, {1, 1, 1}),
                random_points(50, axes + 9, {0, 0, 0}, {1, 1, 1}));
  }
}

// Extents from just two reaches, where one cell is its own neighbour from both sides, to five.
TEST_F(Neighbours, OfThinPeriodicBoxesAreListedOnce) {
  for (double reaches : {2.0, 2.5, 3.0, 3.1, 4.0, 5.0}) {
    Space s;
    s.periodic = {true, true, true};
    s.extent = {reaches * s.reach, reaches * s.reach, 2.01 * s.reach};
    check_self(s, random_points(150, 8, {0, 0, 0}, s.extent));
  }
}

// Fluid that drifted out through a periodic face since it was sorted is still a target of the walls' list.
TEST_F(Neighbours, OfTargetsBeyondAPeriodicFaceMatchBruteForce) {
  Space s;
  s.periodic = {true, false, true};
  check_other(s, random_points(400, 10, {0, 0, 0}, {1, 1, 1}),
              random_points(60, 11, {-0.3, 0, 0.9}, {0.1, 1, 1.3}));
}

TEST_F(Neighbours, ReachOfSeveralCellsMatchesBruteForce) {
  for (double ratio : {0.5, 0.34}) {
    Space s;
    s.cell_ratio = ratio;
    check_self(s, random_points(500, 12, {0, 0, 0}, {1, 1, 1}));
    s.periodic = {true, true, true};
    check_self(s, random_points(500, 13, {0, 0, 0}, {1, 1, 1}));
    s.extent = {2.2 * s.reach, 1, 2.2 * s.reach};
    check_self(s, random_points(200, 14, {0, 0, 0}, s.extent));
  }
}

TEST_F(Neighbours, OfACrowdedCellAreNotTruncated) {
  const Space s;
  const SourceView sources = sort(s, random_points(2000, 15, {0.5, 0.5, 0.5}, {0.55, 0.55, 0.55}));
  NeighbourList list(context_, "pairs");
  list.build(sources, wall_.place.span(), s.box(), static_cast<Real>(s.reach), NeighbourList::Pairs::self);
  for (Index n : HostList(context_, list.view()).length) ASSERT_EQ(n, 1999);
  EXPECT_GE(list.capacity(), 2000 * 1999);
}

// The pair loops read whole registers of entries, those beyond the end of a row too.
TEST_F(Neighbours, EntriesBeyondTheEndOfARowAreSources) {
  const Space s;
  const SourceView sources = sort(s, random_points(300, 17, {0, 0, 0}, {1, 1, 1}));
  NeighbourList list(context_, "pairs");
  list.build(sources, wall_.place.span(), s.box(), static_cast<Real>(s.reach), NeighbourList::Pairs::self);
  const HostList rows(context_, list.view());
  const auto n = static_cast<Index>(rows.length.size());
  for (Index i = 0; i < n; ++i) {
    const Index length = rows.length[static_cast<std::size_t>(i)];
    for (Index k = length; k < whole_lanes(length); ++k) {
      EXPECT_GE(rows.view().entries(i).one(k), 0) << "row " << i;
      EXPECT_LT(rows.view().entries(i).one(k), n) << "row " << i;
    }
  }
}

// Nine lines of cells with more than 8192 particles each, and ten particles near their beginnings: one row
// more than eight bases hold, on a GPU.
TEST_F(Neighbours, OfLinesThatAreTooLongForTheCodesAreAllListed) {
  Space s;
  s.extent = {600 * s.reach, 3.1 * s.reach, 512 * s.reach};  // planes along x, lines along z
  Points points;
  Random random(18);
  for (int plane = 0; plane < 3; ++plane)
    for (int line = 0; line < 3; ++line) {
      const double x = (1.5 + 0.6 * (plane - 1)) * s.reach, y = (1.55 + 0.6 * (line - 1)) * s.reach;
      const auto at = [&](double z) {
        points.push_back({static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z * s.reach)});
      };
      at(0.4);
      if (plane == 1 && line == 1) at(0.6);
      for (int k = 0; k < 8300; ++k) at(3 + 508 * (k + random.uniform(0, 1)) / 8300);
    }
  const SourceView sources = sort(s, points);
  NeighbourList list(context_, "pairs");
  list.build(sources, wall_.place.span(), s.box(), static_cast<Real>(s.reach), NeighbourList::Pairs::self);
  EXPECT_EQ(list.view().plain.size > 0, slice_width > 1);
  const HostList rows(context_, list.view());
  Index checked = 0, crowded = 0;
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    const bool beginning = static_cast<double>(sorted_[i].z) < s.reach;
    if (!beginning && i % 2000 != 0) continue;
    std::vector<Index> near;
    for (std::size_t j = 0; j < sorted_.size(); ++j)
      if (i != j && distance_squared(s, sorted_[i], sorted_[j]) < square(s.reach))
        near.push_back(static_cast<Index>(j));
    EXPECT_EQ(rows.row(static_cast<Index>(i)), near) << i;
    ++checked, crowded += near.size() == 9;
  }
  EXPECT_GT(checked, 40);
  EXPECT_GE(crowded, 2);
}

TEST_F(Neighbours, ListsCanBeBuiltAgainSmallerAndLarger) {
  const Space s;
  NeighbourList list(context_, "pairs");
  for (std::size_t n : {std::size_t(200), std::size_t(20), std::size_t(600)}) {
    const SourceView sources = sort(s, random_points(n, 16, {0, 0, 0}, {1, 1, 1}));
    list.build(sources, wall_.place.span(), s.box(), static_cast<Real>(s.reach), NeighbourList::Pairs::self);
    expect_all_pairs(s, sorted_, HostList(context_, list.view()), true);
  }
}

TEST(ListView, RowsBeginBeyond32Bits) {
  constexpr Offset far = 10000000000;
  const std::vector<Offset> slice{0, far};
  constexpr Index width = slice_width;
  const std::vector<Index> length(static_cast<std::size_t>(width) * 2, 100);
  const RowLayout list{host_span(slice), host_span(length)};
  EXPECT_EQ(list.row(slice_width), far);
  EXPECT_EQ(list.row(2 * slice_width - 1) + 99 * RowLayout::stride(),
            far + slice_width - 1 + static_cast<Offset>(99) * slice_width);
}

}  // namespace
}  // namespace slagflow
