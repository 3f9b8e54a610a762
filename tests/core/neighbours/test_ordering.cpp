// Sorting by cell, wrapping of periodic positions and departures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "core/scene.hpp"
#include "neighbours/ordering.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

const Vec3d extent{1, 2, 0.5};
constexpr double width = 0.2;

// One particle as the tests place it; all other values follow from its id.
struct Placed {
  Vec3d position;
  std::uint8_t fluid = 0;
};

class OrderingOf : public testing::Test {
 protected:
  void sort(const std::vector<Placed>& particles, std::array<bool, 3> periodic) {
    upload(particles);
    grid_ = CellGrid::cover(extent, periodic, width);
    Ordering ordering(context_, extent, periodic, grid_);
    departed_.assign(2, {});
    ordering.sort(fluid_, departed_);
    cell_start_ = download(context_, ordering.fluid_sources(fluid_).cell_start);
    position_ = download(context_, fluid_.position.span()), place_ = download(context_, fluid_.place.span());
    id_ = download(context_, fluid_.id.span());
  }

  // Where a particle is, and of what fluid; in all else the mark that its id makes in each array.
  void upload(const std::vector<Placed>& particles) {
    std::vector<Vec3d> position;
    std::vector<Quad> place;
    std::vector<Index> id;
    std::vector<std::uint8_t> fluid;
    for (const Placed& p : particles) {
      position.push_back(p.position), fluid.push_back(p.fluid);
      id.push_back(static_cast<Index>(id.size()));
      place.push_back(quad(to_real(p.position), mark_of<Quad>("place", id.back()).w));
    }
    fluid_.resize(static_cast<Index>(particles.size()));
    fluid_.each([&](auto& array) { array.upload(marks<element<decltype(array)>>(array.field.name, id)); });
    fluid_.position.upload(position), fluid_.place.upload(place);
    fluid_.id.upload(id), fluid_.fluid.upload(fluid);
  }

  template <class Array>
  using element = std::decay_t<decltype(std::declval<Array&>().span()[0])>;

  template <class T>
  static T mark_of(const std::string& name, Index id) {
    const auto whole = id + 1000 * static_cast<Index>(name.size());
    const auto mark = static_cast<Real>(whole);
    if constexpr (std::is_same_v<T, Quad>)
      return Quad{mark, mark + 1, mark + 2, mark + 3};
    else if constexpr (std::is_same_v<T, Vec3d>)
      return Vec3d{mark, mark + 1, mark + 2};
    else
      return static_cast<T>(whole);
  }

  template <class T>
  static std::vector<T> marks(const std::string& name, const std::vector<Index>& id) {
    std::vector<T> all;
    for (const Index i : id) all.push_back(mark_of<T>(name, i));
    return all;
  }

  Context context_;
  FluidArrays fluid_{context_};
  CellGrid grid_;
  DepartureCounts departed_;
  std::vector<Index> cell_start_, id_;
  std::vector<Vec3d> position_;
  std::vector<Quad> place_;
};

std::vector<Placed> random_particles(std::size_t n, double margin) {
  Random random(5);
  std::vector<Placed> particles(n);
  for (Placed& p : particles) {
    for (int k = 0; k < 3; ++k) p.position[k] = random.uniform(-margin, extent[k] + margin);
    p.fluid = static_cast<std::uint8_t>(random.uniform(0, 2));
  }
  return particles;
}

TEST_F(OrderingOf, GoesByCellThenById) {
  sort(random_particles(1000, 0), {false, false, false});
  ASSERT_EQ(id_.size(), 1000U);
  std::vector<std::pair<Index, Index>> keys;
  for (std::size_t i = 0; i < id_.size(); ++i) keys.emplace_back(grid_.cell_of(xyz(place_[i])), id_[i]);
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  EXPECT_GT(keys.back().first, 50) << "all particles are in few cells: nothing is tested";
}

TEST_F(OrderingOf, CellStartsFrameEachCell) {
  sort(random_particles(1000, 0), {false, false, false});
  ASSERT_EQ(cell_start_.size(), static_cast<std::size_t>(grid_.cells() + 1));
  EXPECT_EQ(cell_start_.front(), 0);
  EXPECT_EQ(cell_start_.back(), 1000);
  for (Index cell = 0; cell < grid_.cells(); ++cell)
    for (Index i = cell_start_[static_cast<std::size_t>(cell)];
         i < cell_start_[static_cast<std::size_t>(cell) + 1]; ++i)
      EXPECT_EQ(grid_.cell_of(xyz(place_[static_cast<std::size_t>(i)])), cell);
}

// The rows of each plane of cells, the slowest axis of their number, and those that come later behind them.
TEST_F(OrderingOf, PutsTheFluidInPlanesOfCells) {
  sort(random_particles(1000, 0), {false, false, false});
  const Planes planes = fluid_.count.planes;
  const int slowest = grid_.order.axis[2];
  ASSERT_EQ(planes.count, grid_.count[slowest]);
  std::vector<Offset> first_chunk(static_cast<std::size_t>(planes.count) + 2), counted(1);
  context_.copy_to_host(first_chunk.data(), planes.first_chunk, first_chunk.size() * sizeof(Offset));
  EXPECT_EQ(first_chunk.back(), 1000);
  std::vector<Index> rows(static_cast<std::size_t>(planes.count));
  for (const Quad& place : place_)
    ++rows[static_cast<std::size_t>(grid_.step_along(grid_.cell_of(xyz(place)), slowest))];
  for (const Index n : rows) counted.push_back(counted.back() + (n + chunk_rows - 1) / chunk_rows);
  first_chunk.pop_back();
  EXPECT_EQ(first_chunk, counted);
  EXPECT_GT(counted.back(), planes.count / 2) << "most planes are empty: nothing is tested";
  Buffer<double> one(context_, "ones");
  for (const Index more : {0, 1, 400}) {
    fluid_.resize(1000 + more);
    one.upload(std::vector<double>(static_cast<std::size_t>(1000 + more), 1.0));
    EXPECT_EQ(sum(context_, one.span(), fluid_.count), 1000 + more);
    EXPECT_EQ(fluid_.count.planes.count, planes.count);
  }
  fluid_.resize(300);
  EXPECT_EQ(fluid_.count.planes.count, 0);
  EXPECT_EQ(sum(context_, one.span(), fluid_.count), 300);
}

TEST_F(OrderingOf, MovesAllArraysTogether) {
  const auto particles = random_particles(500, 0);
  sort(particles, {false, false, false});
  int followed = 0;
  fluid_.each(Fate::sorted, [&](auto& array) {
    using T = element<decltype(array)>;
    const std::string name = array.field.name;
    if (name == "position" || name == "place" || name == "id" || name == "fluid") return;
    const auto found = download(context_, array.span());
    const auto expected = marks<T>(name, id_);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(T)), 0) << name;
    ++followed;
  });
  EXPECT_GE(followed, 9);
  const auto kind = download(context_, fluid_.fluid.span());
  for (std::size_t i = 0; i < id_.size(); ++i) {
    const Placed& p = particles[static_cast<std::size_t>(id_[i])];
    EXPECT_EQ(position_[i], p.position);
    EXPECT_EQ(xyz(place_[i]), to_real(p.position));
    EXPECT_EQ(place_[i].w, mark_of<Quad>("place", id_[i]).w);
    EXPECT_EQ(kind[i], p.fluid);
  }
}

TEST_F(OrderingOf, CountsDeparturesByFaceAndFluid) {
  std::vector<Placed> particles;
  const Vec3d middle = 0.5 * extent;
  for (int face = 0; face < faces; ++face)
    for (int n = 0; n <= face; ++n) {  // face k: k + 1 particles, of which one is of fluid 1
      Placed p{middle, static_cast<std::uint8_t>(n == 0 ? 1 : 0)};
      p.position[face / 2] = face % 2 ? extent[face / 2] + 0.01 * (n + 1) : -0.01 * (n + 1);
      particles.push_back(p);
    }
  particles.push_back({middle, 0});
  sort(particles, {false, false, false});
  for (std::size_t face = 0; face < faces; ++face) {
    EXPECT_EQ(departed_[0][face], static_cast<std::int64_t>(face)) << face;
    EXPECT_EQ(departed_[1][face], 1) << face;
  }
  EXPECT_EQ(fluid_.count, 1);
  EXPECT_EQ(id_, std::vector<Index>{static_cast<Index>(particles.size()) - 1});
  EXPECT_EQ(position_[0], middle);
}

TEST_F(OrderingOf, NoParticleIsLostOrInvented) {
  const auto particles = random_particles(1000, 0.1);
  sort(particles, {false, false, false});
  std::int64_t gone = 0;
  for (const auto& by_face : departed_)
    for (std::int64_t count : by_face) gone += count;
  std::size_t inside = 0;
  for (const Placed& p : particles) {
    bool in = true;
    for (int k = 0; k < 3; ++k) in = in && p.position[k] >= 0 && p.position[k] <= extent[k];
    inside += in;
  }
  EXPECT_EQ(id_.size(), inside);
  EXPECT_EQ(gone, 1000 - static_cast<std::int64_t>(inside));
  std::sort(id_.begin(), id_.end());
  EXPECT_EQ(std::unique(id_.begin(), id_.end()), id_.end());
}

TEST_F(OrderingOf, ParticlesOnAFaceAreInside) {
  sort({{{0, 0, 0}}, {extent}}, {false, false, false});
  EXPECT_EQ(fluid_.count, 2);
}

TEST_F(OrderingOf, AllMayLeave) {
  sort({{{-1, 0, 0}}, {{5, 0, 0}, 1}}, {false, false, false});
  EXPECT_EQ(fluid_.count, 0);
  EXPECT_EQ(departed_[0][0], 1);
  EXPECT_EQ(departed_[1][1], 1);
  EXPECT_EQ(cell_start_.back(), 0);
}

TEST_F(OrderingOf, NothingSortsToNothing) {
  sort({}, {false, false, false});
  EXPECT_EQ(fluid_.count, 0);
  EXPECT_EQ(cell_start_.back(), 0);
}

TEST_F(OrderingOf, WrapsPeriodicPositions) {
  sort({{{-0.25, 2.5, 0.25}}, {{3.25, -4.5, 0.25}}, {{-1e-20, 2, 0.25}}}, {true, true, false});
  ASSERT_EQ(fluid_.count, 3);
  for (const auto& by_face : departed_) EXPECT_EQ(by_face, (std::array<std::int64_t, faces>{}));
  std::vector<Vec3d> by_id(3);
  for (std::size_t i = 0; i < 3; ++i) by_id[static_cast<std::size_t>(id_[i])] = position_[i];
  EXPECT_EQ(by_id[0], (Vec3d{0.75, 0.5, 0.25}));
  EXPECT_EQ(by_id[1], (Vec3d{0.25, 1.5, 0.25}));
  EXPECT_NEAR(std::remainder(by_id[2].x, extent.x), 0, 1e-15);
  EXPECT_EQ(by_id[2].y, 0);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(xyz(place_[i]), to_real(position_[i]));
}

TEST_F(OrderingOf, APeriodicAxisAndAnOpenOneDoNotMix) {
  sort({{{1.25, 1, -0.1}}, {{1.25, 1, 0.1}}}, {true, false, false});
  EXPECT_EQ(departed_[0][4], 1);
  ASSERT_EQ(fluid_.count, 1);
  EXPECT_EQ(position_[0], (Vec3d{0.25, 1, 0.1}));
}

TEST_F(OrderingOf, ResultDoesNotDependOnTheOrderBefore) {
  const auto particles = random_particles(300, 0);
  sort(particles, {false, false, false});
  const auto first = id_;
  Ordering ordering(context_, extent, {false, false, false}, grid_);
  ordering.sort(fluid_, departed_);
  EXPECT_EQ(download(context_, fluid_.id.span()), first);
}

TEST_F(OrderingOf, OneCellGoesByIdWhateverTheOrderBefore) {
  sort(random_particles(300, 0), {false, false, false});
  ASSERT_FALSE(std::is_sorted(id_.begin(), id_.end()));
  fluid_.position.upload(std::vector<Vec3d>(300, 0.5 * extent));
  Ordering ordering(context_, extent, {false, false, false}, grid_);
  ordering.sort(fluid_, departed_);
  const auto ids = download(context_, fluid_.id.span());
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
}

TEST(CellGrid, CellsAreAtLeastAsWideAsAsked) {
  for (double w : {0.1, 0.2, 0.24, 0.5, 3.0}) {
    const CellGrid grid = CellGrid::cover(extent, {false, true, false}, w);
    EXPECT_GE(grid.narrowest, w);
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(grid.count[k] == 1 || extent[k] / grid.count[k] >= w);
      EXPECT_GE(grid.count[k], 1);
    }
  }
}

TEST(CellGrid, AHugeDomainGetsWiderCellsInsteadOfTooMany) {
  const CellGrid grid = CellGrid::cover({1000, 1000, 1000}, {false, false, false}, 0.01);
  EXPECT_LE(static_cast<double>(grid.count[0]) * grid.count[1] * grid.count[2], 1 << 24);
  EXPECT_GT(grid.cells(), 1 << 20);
  EXPECT_GE(grid.narrowest, 1);
}

TEST(CellGrid, AsManyCellsAsAreAllowed) {
  const CellGrid grid = CellGrid::cover({1000, 1000, 1000}, {false, false, false}, 0.8, 2e9);
  EXPECT_EQ(grid.count[0], 1249);
  EXPECT_EQ(grid.cells(), 1249 * 1249 * 1249);
  EXPECT_EQ(grid.cell_of({Real(999.9), Real(999.9), Real(999.9)}), grid.cells() - 1);
}

// The longest axis is the slowest, the one after it the fastest; each cell has a number of its own, and the
// neighbours along an axis are where its stride says.
TEST(CellGrid, NumbersPlanesAcrossTheLongestAxisOneAfterTheOther) {
  const Vec3d domains[] = {{4, 3, 2}, {2, 4, 3}, {3, 2, 4}, {4, 2, 3}, {3, 3, 3}, {5, 4, 1}, {1, 1, 1}};
  const int orders[][3] = {{1, 2, 0}, {2, 0, 1}, {0, 1, 2}, {2, 1, 0}, {0, 1, 2}, {1, 2, 0}, {0, 1, 2}};
  for (std::size_t d = 0; d < std::size(domains); ++d) {
    const CellGrid grid = CellGrid::cover(domains[d], {false, false, false}, 0.99);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(grid.order.axis[k], orders[d][k]) << d;
    std::set<Index> numbers;
    for (int x = 0; x < grid.count[0]; ++x)
      for (int y = 0; y < grid.count[1]; ++y)
        for (int z = 0; z < grid.count[2]; ++z) {
          const auto at = [](int c) { return static_cast<Real>(c + 0.5); };
          const Index cell = grid.cell_of({at(x), at(y), at(z)});
          const int steps[3] = {x, y, z};
          for (int k = 0; k < 3; ++k) EXPECT_EQ(grid.step_along(cell, k), steps[k]);
          const int slow = grid.order.axis[2];
          EXPECT_EQ(cell / grid.stride[slow], steps[slow]);
          numbers.insert(cell);
        }
    EXPECT_EQ(static_cast<Index>(numbers.size()), grid.cells());
    EXPECT_EQ(*numbers.rbegin(), grid.cells() - 1);
  }
}

}  // namespace
}  // namespace slagflow
