// How a grid is dealt out to ranks: what a slab knows is what the whole grid knows there, in the same order.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {
namespace {

std::int64_t weight_of(const Slabs& slabs, const std::vector<std::int64_t>& weight, int rank) {
  const auto begin = weight.begin() + slabs.first(rank);
  return std::accumulate(begin, begin + slabs.own(rank), std::int64_t(0));
}

TEST(Slabs, AreOfTheSameWeight) {
  std::vector<std::int64_t> weight(100, 10);
  for (std::size_t p = 60; p < 80; ++p) weight[p] = 1000;
  Slabs slabs(100, false, 4);
  EXPECT_TRUE(slabs.balance(weight));
  const std::int64_t share = std::accumulate(weight.begin(), weight.end(), std::int64_t(0)) / 4;
  for (int r = 0; r < 4; ++r)
    EXPECT_NEAR(static_cast<double>(weight_of(slabs, weight, r)), static_cast<double>(share), 1000) << r;
  EXPECT_FALSE(slabs.balance(weight));  // nothing is left to gain
}

TEST(Slabs, StayWhileTheyAreNearlyEven) {
  std::vector<std::int64_t> weight(40, 100);
  weight[0] = 150;
  Slabs slabs(40, false, 4);
  EXPECT_FALSE(slabs.balance(weight));
  EXPECT_EQ(slabs.cuts(), (std::vector<int>{0, 10, 20, 30, 40}));
}

TEST(Slabs, HaveRoomForTheHalosOfTheirNeighbours) {
  std::vector<std::int64_t> weight(12, 0);
  weight[11] = 1000000;  // all in the last plane
  Slabs slabs(12, false, 4);
  slabs.balance(weight);
  for (int r = 0; r < 4; ++r) EXPECT_GE(slabs.own(r), halo_planes) << r;
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    slabs.shuffle(seed);
    EXPECT_EQ(slabs.cuts().back(), 12);
    for (int r = 0; r < 4; ++r) EXPECT_GE(slabs.own(r), halo_planes) << seed;
  }
}

TEST(Slabs, WithoutFluidStayWhereTheyAre) {
  Slabs slabs(20, false, 3);
  EXPECT_FALSE(slabs.balance(std::vector<std::int64_t>(20)));
}

TEST(Slabs, TooManyRanksAreAnErrorThatSaysHowManyMay) {
  EXPECT_NO_THROW(Slabs(8, false, 4));
  try {
    const Slabs slabs(8, false, 5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 4 ranks"), std::string::npos) << error.what();
  }
  // On a ring of two each is above and below the other at once.
  EXPECT_THROW(Slabs(7, true, 2), InputError);
  EXPECT_NO_THROW(Slabs(8, true, 2));
}

TEST(Slabs, MeetRoundAPeriod) {
  const Slabs open(12, false, 3), ring(12, true, 3);
  EXPECT_EQ(open.below(0), -1);
  EXPECT_EQ(open.above(2), -1);
  EXPECT_EQ(ring.below(0), 2);
  EXPECT_EQ(ring.above(2), 0);
  EXPECT_EQ(open.of(0).below, 0);
  EXPECT_EQ(ring.of(0).below, halo_planes);
}

TEST(DeviceOfRank, GoesRoundTheGpusOfAMachine) {
  EXPECT_EQ(device_of_rank(0, 4), 0);
  EXPECT_EQ(device_of_rank(3, 4), 3);
  EXPECT_EQ(device_of_rank(5, 4), 1);
  EXPECT_EQ(device_of_rank(2, 1), 0);
  EXPECT_EQ(device_of_rank(2, 0), 0);
}

class SlabOfGrid : public testing::TestWithParam<bool> {
 protected:
  SlabOfGrid() {
    whole = CellGrid::cover({0.5, 0.7, 2.0}, {false, GetParam(), GetParam()}, 0.1);
    planes = whole.planes();
  }
  CellGrid slab_of(const Slabs& slabs, int rank) const {
    CellGrid grid = whole;
    grid.slab = slabs.of(rank);
    return grid;
  }
  // In the whole grid, of a cell of a slab.
  Index whole_cell(const CellGrid& grid, Index cell) const {
    const Index in_plane = cell % grid.cells_of_plane();
    return grid.plane_of(cell) * grid.cells_of_plane() + in_plane;
  }
  std::vector<Index> around(const CellGrid& grid, Index cell, int range) const {
    std::vector<Index> cells;
    grid.for_runs_around(cell, range, [&](Index first, Index last) {
      for (Index c = first; c <= last; ++c) cells.push_back(whole_cell(grid, c));
    });
    return cells;
  }
  std::vector<Index> within(const CellGrid& grid, Vec3 place, Real reach) const {
    std::vector<Index> cells;
    grid.for_cells_within(place, reach, [&](Index first, Index last) {
      for (Index c = first; c <= last; ++c) cells.push_back(whole_cell(grid, c));
    });
    return cells;
  }
  CellGrid whole;
  int planes = 0;
};

TEST_P(SlabOfGrid, NumbersItsOwnPlanesFirst) {
  const Slabs slabs(planes, GetParam(), 3);
  std::vector<int> owner(static_cast<std::size_t>(whole.cells()), -1);
  for (int r = 0; r < 3; ++r) {
    const CellGrid grid = slab_of(slabs, r);
    EXPECT_EQ(grid.cells(), grid.slab.planes() * grid.cells_of_plane());
    for (Index cell = 0; cell < grid.cells(); ++cell) {
      EXPECT_EQ(grid.local_plane(grid.plane_of(cell)), cell / grid.cells_of_plane());
      if (cell < grid.own_cells()) owner[static_cast<std::size_t>(whole_cell(grid, cell))] = r;
    }
  }
  EXPECT_EQ(std::count(owner.begin(), owner.end(), -1), 0);  // each cell has a rank
  EXPECT_TRUE(std::is_sorted(owner.begin(), owner.end()));
}

TEST_P(SlabOfGrid, SeesWhatTheWholeGridSeesInTheSameOrder) {
  for (int ranks = 2; ranks <= 4; ++ranks) {
    const Slabs slabs(planes, GetParam(), ranks);
    for (int r = 0; r < ranks; ++r) {
      const CellGrid grid = slab_of(slabs, r);
      for (Index cell = 0; cell < grid.own_cells(); ++cell)
        for (const int range : {1, halo_planes})
          ASSERT_EQ(around(grid, cell, range), around(whole, whole_cell(grid, cell), range))
              << ranks << " ranks, rank " << r << ", cell " << cell;
    }
  }
}

TEST_P(SlabOfGrid, FindsThePlacesWithinReachInTheSameOrder) {
  const Slabs slabs(planes, GetParam(), 3);
  for (int r = 0; r < 3; ++r) {
    const CellGrid grid = slab_of(slabs, r);
    for (int k = 0; k < 200; ++k) {
      const double share = (k + 0.5) / 200, plane = grid.slab.first + share * grid.slab.own;
      const Vec3 place = to_real(Vec3d{0.5 * share, 0.7 * (1 - share), plane * 2.0 / planes});
      ASSERT_EQ(whole_cell(grid, grid.cell_of(place)), whole.cell_of(place)) << k;
      ASSERT_EQ(within(grid, place, Real(0.099)), within(whole, place, Real(0.099))) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, SlabOfGrid, testing::Values(false, true),
                         [](const auto& param) { return param.param ? "Periodic" : "Open"; });

}  // namespace
}  // namespace slagflow
