// Lists that are taken for good must hold every pair within the support.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "core/cleared_arrays.hpp"
#include "core/scene.hpp"
#include "neighbours/list_age.hpp"
#include "neighbours/neighbours.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double h = 0.13;
const ListReach reach{h, 0.12 * h, 0.3 * h, 1.12 * h};
const Vec3d extent{1, 0.6, 0.8};

using Points = std::vector<Vec3d>;
using Motion = std::function<Vec3d(Vec3d)>;  // displacement at a start position

class ListAgeOf : public testing::Test {
 protected:
  // Sorts the particles, as at the moment when lists are built.
  void start(const Points& fluid, const Points& walls, std::array<bool, 3> periodic = {false, false, false}) {
    periodic_ = periodic;
    ordering_ = std::make_unique<Ordering>(context_, extent, periodic,
                                           CellGrid::cover(extent, periodic, reach.width));
    place(fluid, walls);
    DepartureCounts departed(1);
    ordering_->sort(fluid_, departed);
    ordering_->sort(wall_);
    ASSERT_EQ(static_cast<std::size_t>(fluid_.count), fluid.size());
    start_.copy_from(fluid_.place), wall_start_.copy_from(wall_.place);
    then_ = points(start_), now_ = then_, walls_then_ = points(wall_.place), walls_ = walls_then_;
    walls_largest_ = 0;
  }

  void place(const Points& fluid, const Points& walls) {
    std::vector<Quad> places, wall_places;
    std::vector<Index> ids, wall_ids;
    for (Vec3d p : fluid)
      places.push_back(quad(to_real(p), 0)), ids.push_back(static_cast<Index>(ids.size()));
    for (Vec3d p : walls)
      wall_places.push_back(quad(to_real(p), 0)), wall_ids.push_back(static_cast<Index>(wall_ids.size()));
    clear(fluid_, fluid.size()), clear(wall_, walls.size());
    fluid_.position.upload(fluid), fluid_.place.upload(places), fluid_.id.upload(ids);
    fluid_.fluid.upload(std::vector<std::uint8_t>(fluid.size()));
    wall_.place.upload(wall_places), wall_.id.upload(wall_ids);
  }

  // Moves each particle from its start by motion(start).
  void move(const Motion& motion) {
    std::vector<Quad> places;
    largest_ = 0;
    for (Vec3d p : then_) {
      places.push_back(quad(to_real(p + motion(p)), 0));
      largest_ = std::max(largest_, static_cast<double>(norm(xyz(places.back()) - to_real(p))));
    }
    fluid_.place.upload(places);
    now_ = points(fluid_.place);
  }

  // The same with the walls.
  void move_walls(const Motion& motion) {
    std::vector<Quad> places;
    walls_largest_ = 0;
    for (Vec3d p : walls_then_) {
      places.push_back(quad(to_real(p + motion(p)), 0));
      walls_largest_ = std::max(walls_largest_, static_cast<double>(norm(xyz(places.back()) - to_real(p))));
    }
    wall_.place.upload(places);
    walls_ = points(wall_.place);
  }

  SourceView at(const SourceView& sources, const Buffer<Quad>& places) const {
    return {sources.grid, sources.cell_start, places.span()};
  }

  // Whether lists that were all built at the start hold, when the particles have moved in one step.
  bool hold() {
    const SourceView fluid = ordering_->fluid_sources(fluid_), walls = ordering_->wall_sources(wall_);
    NeighbourList beside_fluid(context_, "walls"), beside_walls(context_, "fluid");
    beside_fluid.build(at(walls, wall_start_), start_.span(), {}, static_cast<Real>(reach.support),
                       Pairs::other);
    beside_walls.build(at(fluid, start_), wall_start_.span(), {}, static_cast<Real>(reach.support),
                       Pairs::other);
    ListAge age(context_, Renewal::of_all);
    age.begin(at(fluid, start_), at(walls, wall_start_));
    Buffer<StepRecord> record(context_, "record");
    record.upload({StepRecord{}});
    age.look({fluid, largest_, beside_fluid.near_sources()},
             {walls, walls_largest_, beside_walls.near_sources()}, reach, record.span().data);
    std::vector<StepRecord> now;
    record.download(now);
    return now[0].worn <= 0 && judge(largest_, walls_largest_, reach) != Verdict::broken;
  }

  // Pairs within the support now that were too far apart at the start to be listed; to within rounding.
  int missed_pairs() const {
    int missed = 0;
    const double slack = 1e-5 * h;
    auto check = [&](Vec3d a_now, Vec3d b_now, Vec3d a_then, Vec3d b_then, double skin) {
      if (distance(a_now, b_now) < h - slack && distance(a_then, b_then) > h + skin + slack) ++missed;
    };
    for (std::size_t i = 0; i < now_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) check(now_[i], now_[j], then_[i], then_[j], reach.fluid_skin);
      for (std::size_t w = 0; w < walls_.size(); ++w)
        check(now_[i], walls_[w], then_[i], walls_then_[w], reach.wall_skin);
    }
    return missed;
  }

  Context context_;
  FluidArrays fluid_{context_};
  WallArrays wall_{context_};
  Buffer<Quad> start_{context_, "start"}, wall_start_{context_, "wall start"};
  std::unique_ptr<Ordering> ordering_;
  std::array<bool, 3> periodic_{};
  Points then_, now_, walls_then_, walls_;
  double largest_ = 0, walls_largest_ = 0;

 private:
  double distance(Vec3d a, Vec3d b) const {
    Vec3d d = a - b;
    for (int k = 0; k < 3; ++k)
      if (periodic_[static_cast<std::size_t>(k)]) d[k] = std::remainder(d[k], extent[k]);
    return norm(d);
  }

  static Points points(const Buffer<Quad>& buffer) {
    std::vector<Quad> places;
    buffer.download(places);
    Points result;
    for (Quad q : places)
      result.push_back({static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)});
    return result;
  }
};

Points random_points(Random& random, int n, Vec3d low, Vec3d high) {
  Points result(static_cast<std::size_t>(n));
  for (Vec3d& p : result)
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(low[k], high[k]);
  return result;
}

// A drift, a linear flow and a wave, plus noise.
Motion random_motion(Random& random, double noise) {
  const Vec3d drift = random.vector(1), wave = random.vector(0.3), number = random.vector(12);
  const Vec3d rows[3] = {random.vector(0.7), random.vector(0.7), random.vector(0.7)};
  return [=, &random](Vec3d x) {
    const Vec3d linear{dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
    return drift + linear + std::sin(dot(number, x)) * wave + random.vector(noise);
  };
}

TEST_F(ListAgeOf, ListsThatHoldMissNoPair) {
  int kept_beyond_half_a_skin = 0, refused = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const std::array<bool, 3> periodic{seed % 3 == 0, seed % 4 == 0, seed % 5 == 0};
    start(random_points(random, 40 + 40 * static_cast<int>(seed % 7), {0, 0, 0}, extent),
          random_points(random, 80, {0, 0, -0.1}, {seed % 2 ? 1.0 : 0.2, 0.6, 0}), periodic);
    const Motion motion = random_motion(random, seed % 2 ? 0.02 : 0.1);
    for (double size = 0.02 * h; size < 0.8 * h; size *= 1.5) {
      move([&](Vec3d x) { return size * motion(x); });
      if (!hold()) {
        ++refused;
        continue;
      }
      EXPECT_EQ(missed_pairs(), 0) << "seed " << seed << ", motion " << size / h << " h";
      kept_beyond_half_a_skin += largest_ > 0.5 * reach.fluid_skin;
    }
  }
  EXPECT_GT(kept_beyond_half_a_skin, 20) << "only trivial cases were kept";
  EXPECT_GT(refused, 100);
}

// The same with single particles that shoot ahead.
TEST_F(ListAgeOf, ListsThatHoldMissNoPairOfStragglers) {
  int kept = 0, would_miss = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    start(random_points(random, 200, {0, 0, 0}, extent), {});
    for (double size = 0.05 * h; size < 0.7 * h; size *= 1.4) {
      move([&](Vec3d) { return random.uniform(0, 1) < 0.02 ? size / 1.8 * random.vector(1) : Vec3d{}; });
      const int missed = missed_pairs();
      would_miss += missed > 0;
      if (hold()) {
        EXPECT_EQ(missed, 0) << "seed " << seed << ", motion " << size / h << " h";
        ++kept;
      }
    }
  }
  EXPECT_GT(kept, 20);
  EXPECT_GT(would_miss, 20);
}

TEST_F(ListAgeOf, ATranslationFarFromWallsKeepsTheLists) {
  Random random(2);
  start(random_points(random, 300, {0, 0, 0.5}, extent),
        random_points(random, 40, {0, 0, -0.1}, {1, 0.6, 0}));
  move([](Vec3d) { return Vec3d{0.3 * h, -0.3 * h, 0.4 * h}; });
  ASSERT_GT(largest_, 4 * reach.fluid_skin);
  EXPECT_TRUE(hold());
}

TEST_F(ListAgeOf, ATranslationByMoreThanACellAllowsIsRefused) {
  Random random(2);
  start(random_points(random, 300, {0, 0, 0.5}, extent), {});
  move([](Vec3d) { return Vec3d{0, 0, 0.63 * h}; });
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, ATranslationAlongAWallIsRefusedAfterTheWallsSkin) {
  Random random(3);
  start(random_points(random, 300, {0, 0, 0}, {1, 0.6, 0.2}),
        random_points(random, 40, {0, 0, -0.1}, {1, 0.6, 0}));
  move([](Vec3d) { return Vec3d{0.9 * reach.wall_skin, 0, 0}; });
  EXPECT_TRUE(hold());
  move([](Vec3d) { return Vec3d{1.1 * reach.wall_skin, 0, 0}; });
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, AShearIsRefusedBeforeItMissesAPair) {
  Random random(4);
  start(random_points(random, 500, {0, 0, 0}, extent), {});
  bool held = true;
  for (double strain = 0; strain < 0.6; strain += 0.01) {
    move([&](Vec3d x) { return Vec3d{strain * (x.z - 0.4), 0, 0}; });
    held = hold();
    if (!held) break;
    ASSERT_EQ(missed_pairs(), 0);
  }
  EXPECT_FALSE(held);
}

TEST_F(ListAgeOf, APairThatApproachedByMoreThanTheSkinIsRefused) {
  const double apart = h + 1.01 * reach.fluid_skin;
  for (double middle : {0.1, 0.2, 0.3, 0.37, 0.5}) {  // the pair in one cell, and on both sides of a border
    start({{middle - apart / 2, 0.3, 0.3}, {middle + apart / 2, 0.3, 0.3}}, {});
    move([&](Vec3d x) { return Vec3d{(x.x < middle ? 1 : -1) * 0.52 * reach.fluid_skin, 0, 0}; });
    ASSERT_EQ(missed_pairs(), 1);
    EXPECT_FALSE(hold()) << middle;
  }
}

TEST_F(ListAgeOf, AnApproachThroughAPeriodicFaceIsRefused) {
  const double apart = h + 1.01 * reach.fluid_skin;
  start({{apart / 2, 0.3, 0.3}, {extent.x - apart / 2, 0.3, 0.3}}, {}, {true, false, false});
  move([&](Vec3d x) { return Vec3d{(x.x > 0.5 ? 1 : -1) * 0.52 * reach.fluid_skin, 0, 0}; });
  ASSERT_EQ(missed_pairs(), 1);
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, AnApproachToAWallIsRefused) {
  const double apart = h + 1.01 * reach.wall_skin;
  start({{0.5, 0.3, apart}}, {{0.5, 0.3, 0}});
  move([](Vec3d) { return Vec3d{0, 0, -1.02 * reach.wall_skin}; });
  ASSERT_EQ(missed_pairs(), 1);
  EXPECT_FALSE(hold());
}

// In both cells a companion moves the other way, so that the cells' means stay and only the deviations tell.
TEST_F(ListAgeOf, AnApproachAgainstTheMeansOfBothCellsIsRefused) {
  const double apart = h + 1.01 * reach.fluid_skin, middle = 1.0 / 6;  // a border of cells
  const double left = middle - apart / 2, right = middle + apart / 2;
  start({{left, 0.3, 0.3}, {left, 0.3, 0.31}, {right, 0.3, 0.3}, {right, 0.3, 0.31}}, {});
  move([&](Vec3d x) {
    return Vec3d{(x.x < middle ? 1 : -1) * (x.z > 0.305 ? -1 : 1) * 0.52 * reach.fluid_skin, 0, 0};
  });
  ASSERT_EQ(missed_pairs(), 1);
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, AnApproachToAWallFasterThanTheMeanIsRefused) {
  const double apart = h + 1.01 * reach.wall_skin;
  start({{0.5, 0.3, apart}, {0.51, 0.3, apart}}, {{0.5, 0.3, 0}});
  move([](Vec3d x) { return Vec3d{0, 0, -0.26 * h + (x.x < 0.505 ? -0.05 : 0.05) * h}; });
  ASSERT_EQ(missed_pairs(), 1);
  EXPECT_FALSE(hold());
}

// Cells are a sixth wide: the pair starts on both sides of an empty one.
TEST_F(ListAgeOf, AnApproachAcrossAnEmptyCellIsRefused) {
  start({{0.166, 0.3, 0.3}, {0.334, 0.3, 0.3}}, {});
  move([](Vec3d x) { return Vec3d{(x.x < 0.25 ? 1 : -1) * 0.16 * h, 0, 0}; });
  ASSERT_EQ(missed_pairs(), 1);
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, AWallThatApproachesFluidAtRestIsRefused) {
  const double apart = h + 1.01 * reach.wall_skin;
  start({{0.5, 0.3, apart}}, {{0.5, 0.3, 0}});
  move_walls([](Vec3d) { return Vec3d{0, 0, 1.02 * reach.wall_skin}; });
  ASSERT_EQ(missed_pairs(), 1);
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, AWallAndItsFluidOnTheirWayTogetherAreKept) {
  start({{0.5, 0.3, 0.5 * h}, {0.5, 0.3, 1.3 * h}}, {{0.5, 0.3, 0}, {0.45, 0.3, 0}});
  const auto along = [](Vec3d) { return Vec3d{0.4 * h, 0, 0.3 * h}; };
  move(along), move_walls(along);
  EXPECT_TRUE(hold());
  move([](Vec3d) { return Vec3d{}; });
  EXPECT_FALSE(hold());
}

TEST_F(ListAgeOf, ListsThatHoldMissNoPairOfMovingWalls) {
  int kept = 0, refused = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    start(random_points(random, 100, {0, 0, 0}, extent),
          random_points(random, 80, {0, 0, -0.1}, {1, 0.6, 0.3}), {seed % 3 == 0, seed % 4 == 0, false});
    const Motion motion = random_motion(random, 0.02), wall_motion = random_motion(random, 0);
    const Vec3d drift = random.vector(1);
    for (double size = 0.02 * h; size < 0.8 * h; size *= 1.5) {
      move([&](Vec3d x) { return size * (drift + 0.3 * motion(x)); });
      move_walls([&](Vec3d x) { return size * (drift + 0.3 * wall_motion(x)); });
      if (!hold()) {
        ++refused;
        continue;
      }
      EXPECT_EQ(missed_pairs(), 0) << "seed " << seed << ", motion " << size / h << " h";
      kept += largest_ + walls_largest_ > reach.wall_skin;
    }
  }
  EXPECT_GT(kept, 20) << "only trivial cases were kept";
  EXPECT_GT(refused, 50);
}

TEST_F(ListAgeOf, NothingHolds) {
  start({}, {});
  EXPECT_TRUE(hold());
}

TEST_F(ListAgeOf, NotANumberIsRefused) {
  start({{0.5, 0.3, 0.3}}, {});
  largest_ = std::nan("");
  EXPECT_FALSE(hold());
}

}  // namespace
}  // namespace slagflow
