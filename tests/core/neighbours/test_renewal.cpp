// Lists of which only worn cells are filled anew must hold every pair within the support, and come back from
// a saved state as they were.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>

#include "core/cleared_arrays.hpp"
#include "core/scene.hpp"
#include "neighbours/list_age.hpp"
#include "neighbours/neighbours.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double h = 0.13, skin = 0.12 * h;
const ListReach reach{h, skin, skin, h + skin};
const Vec3d extent{1, 0.7, 0.8};

using Points = std::vector<Vec3d>;
using Motion = std::function<Vec3d(Vec3d)>;  // displacement of a step at a place

// The particles of a simulation and its three lists, step by step.
class RenewedLists {
 public:
  RenewedLists(const Points& fluid, const Points& walls, std::array<bool, 3> periodic)
      : ordering_(context_, extent, periodic, CellGrid::cover(extent, periodic, reach.width)) {
    for (int k = 0; k < 3; ++k)
      if (periodic[static_cast<std::size_t>(k)])
        box_.period[k] = static_cast<Real>(extent[k]), box_.inverse[k] = static_cast<Real>(1 / extent[k]);
    clear(fluid_, fluid.size()), clear(wall_, walls.size());
    upload(fluid, fluid_), upload(walls, wall_);
    fluid_.fluid.upload(std::vector<std::uint8_t>(fluid.size()));
    build();
  }

  // Moves the particles and does what a simulation does at the end of a step and at the start of the next.
  void step(const Motion& motion, const Motion& wall_motion) {
    move(fluid_, motion), move(wall_, wall_motion);
    const double moved = farthest(fluid_, start_), walls_moved = farthest(wall_, wall_start_);
    record_.upload({StepRecord{}});
    if (age_.look({ordering_.fluid_sources(fluid_), moved, wall_list_.near_sources()},
                  {ordering_.wall_sources(wall_), walls_moved, wall_to_fluid_.near_sources()}, reach,
                  record_.span().data))
      renew();
    if (judge(moved, walls_moved, reach) == Verdict::broken || worn() > 0) build(), ++builds;
  }

  // Of each list the pairs that it lacks, and those listed that are out of place.
  int wrong_rows() {
    int wrong = 0;
    for (const auto& [list, p] : all()) {
      const HostList host(context_, list->view());
      const auto sources = download(context_, p.sources.place), targets = download(context_, p.targets);
      for (Index i = 0; i < p.targets.size; ++i) wrong += is_wrong(host.row(i), i, sources, targets, p.pairs);
    }
    return wrong;
  }

  // Lists that are built as they were at first and then told what became of them.
  int rows_not_restored() {
    std::vector<std::vector<std::uint8_t>> bits;
    std::vector<HostList> before;
    for (const auto& [list, p] : all())
      bits.push_back(list->remember(p, doubtful())), before.emplace_back(context_, list->view());
    fluid_.place.swap(start_), wall_.place.swap(wall_start_);
    build_lists();
    fluid_.place.swap(start_), wall_.place.swap(wall_start_);
    int wrong = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [list, p] = all()[k];
      if (!list->recall(p, doubtful(), bits[k])) return -1;
      const HostList now(context_, list->view());
      for (Index i = 0; i < p.targets.size; ++i) wrong += now.row(i) != before[k].row(i);
    }
    return wrong;
  }

  int builds = 0, worn_cells = 0, kept_cells = 0;

 private:
  using Listed = std::pair<NeighbourList*, ListedParticles>;
  std::array<Listed, 3> all() {
    const SourceView f = ordering_.fluid_sources(fluid_), w = ordering_.wall_sources(wall_);
    const Span<const Quad> places = fluid_.place.span(), wall_places = wall_.place.span();
    const auto all_reach = static_cast<Real>(h + skin);
    return {{{&fluid_list_, {f, places, fluid_.count, f.cell_start, box_, all_reach, Pairs::self}},
             {&wall_list_, {w, places, fluid_.count, f.cell_start, box_, all_reach, Pairs::other}},
             {&wall_to_fluid_, {f, wall_places, wall_.count, w.cell_start, box_, all_reach, Pairs::other}}}};
  }
  static NeighbourList::Doubtful doubtful() {
    return {static_cast<Real>(0.999 * h), static_cast<Real>(1.001 * h + 2 * skin)};
  }

  template <class Arrays>
  static void upload(const Points& points, Arrays& arrays) {
    std::vector<Quad> places;
    std::vector<Index> ids;
    for (Vec3d p : points)
      places.push_back(quad(to_real(p), 0)), ids.push_back(static_cast<Index>(ids.size()));
    arrays.place.upload(places), arrays.id.upload(ids);
    if constexpr (std::is_same_v<Arrays, FluidArrays>) arrays.position.upload(points);
  }

  void build() {
    DepartureCounts departed(1);
    ordering_.sort(fluid_, departed), ordering_.sort(wall_);
    build_lists();
    start_.copy_from(fluid_.place), wall_start_.copy_from(wall_.place);
    age_.begin(ordering_.fluid_sources(fluid_), ordering_.wall_sources(wall_));
  }
  void build_lists() {
    for (const auto& [list, p] : all()) list->build(p.sources, p.targets, p.box, p.reach, p.pairs);
  }
  void renew() {
    const ListGate gate = age_.gate(reach, nullptr);
    const Span<const std::uint8_t> worn[] = {age_.worn(), age_.worn(), age_.walls_worn()};
    const auto lists = all();
    for (std::size_t k = 0; k < 3; ++k)
      lists[k].first->renew(lists[k].second, {worn[k], gate, record_.span().data});
    for (const std::uint8_t mark : download(context_, age_.worn())) ++(mark ? worn_cells : kept_cells);
  }
  double worn() {
    std::vector<StepRecord> now;
    record_.download(now);
    return now[0].worn;
  }

  template <class Arrays>
  static void move(Arrays& arrays, const Motion& motion) {
    std::vector<Quad> places;
    arrays.place.download(places);
    Points positions;
    for (Quad& q : places) {
      const Vec3d x = to_double(xyz(q));
      q = quad(to_real(x + motion(x)), q.w);
      positions.push_back(to_double(xyz(q)));
    }
    arrays.place.upload(places);
    if constexpr (std::is_same_v<Arrays, FluidArrays>) arrays.position.upload(positions);
  }
  template <class Arrays>
  static double farthest(const Arrays& arrays, const Buffer<Quad>& start) {
    std::vector<Quad> now, then;
    arrays.place.download(now), start.download(then);
    double most = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
      most = std::max(most, static_cast<double>(norm(xyz(now[i]) - xyz(then[i]))));
    return most;
  }

  bool is_wrong(const std::vector<Index>& row, Index i, const std::vector<Quad>& sources,
                const std::vector<Quad>& targets, Pairs pairs) const {
    if (!std::is_sorted(row.begin(), row.end()) || std::adjacent_find(row.begin(), row.end()) != row.end())
      return true;
    for (Index j = 0; j < static_cast<Index>(sources.size()); ++j) {
      if (pairs == Pairs::self && i == j) continue;
      const double d = static_cast<double>(norm(box_.separation(xyz(targets[static_cast<std::size_t>(i)]),
                                                                xyz(sources[static_cast<std::size_t>(j)]))));
      const bool listed = std::binary_search(row.begin(), row.end(), j);
      const double rounding = 1e-5 * h;
      if (d < h - rounding ? !listed : listed && d > h + 2 * skin + rounding) return true;
    }
    return false;
  }

  Context context_;
  FluidArrays fluid_{context_};
  WallArrays wall_{context_};
  PeriodicBox box_;
  Ordering ordering_;
  NeighbourList fluid_list_{context_, "fluid"}, wall_list_{context_, "walls"},
      wall_to_fluid_{context_, "fluid of walls"};
  ListAge age_{context_, Renewal::by_cell};
  Buffer<Quad> start_{context_, "start"}, wall_start_{context_, "wall start"};
  Buffer<StepRecord> record_{context_, "record", 1};
};

Points random_points(Random& random, int n, Vec3d low, Vec3d high) {
  Points result(static_cast<std::size_t>(n));
  for (Vec3d& p : result)
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(low[k], high[k]);
  return result;
}

// A drift, a wave in a part of the domain and noise.
Motion motion_of(Random& random, double drift, double noise) {
  const Vec3d along = random.vector(drift), wave = random.vector(0.15 * skin), number = random.vector(9);
  return [=, &random](Vec3d x) {
    const double part = x.x < 0.4 ? 1 : 0;
    return along + part * std::sin(dot(number, x)) * wave + random.vector(noise);
  };
}

class Renewed : public testing::TestWithParam<unsigned> {};

TEST_P(Renewed, ListsMissNoPairAndComeBack) {
  Random random(GetParam());
  const unsigned seed = GetParam();
  const std::array<bool, 3> periodic{seed % 3 == 1, seed % 2 == 1, false};
  const Vec3d low{0.02, 0.02, 0.02}, high{0.98, 0.68, 0.5};
  RenewedLists lists(random_points(random, 260, low, high),
                     random_points(random, 120, {0, 0, 0}, {seed % 4 ? 1.0 : 0.3, 0.7, 0.1}), periodic);
  const bool walls_move = seed % 5 == 0;
  for (int steps = 0; steps < 40; ++steps) {
    const Motion still = [](Vec3d) { return Vec3d{}; };
    const Motion motion = motion_of(random, 0.02 * h, 0.02 * skin);
    lists.step(motion, walls_move ? motion_of(random, 0.01 * h, 0) : still);
    ASSERT_EQ(lists.wrong_rows(), 0) << "step " << steps;
    if (steps % 7 == 6) {
      ASSERT_EQ(lists.rows_not_restored(), 0) << "step " << steps;
    }
  }
  EXPECT_GT(lists.worn_cells, 100);
  EXPECT_GT(lists.kept_cells, lists.worn_cells);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Renewed, testing::Range(1u, 13u));

// A jet: all falls together and a few are slow.
TEST(RenewedLists, OfAFallAreKept) {
  Random random(3);
  RenewedLists lists(random_points(random, 300, {0.3, 0.2, 0.3}, {0.7, 0.5, 0.75}), {},
                     {false, false, false});
  for (int steps = 0; steps < 8; ++steps) {
    lists.step([](Vec3d) { return Vec3d{0, 0, -0.06 * h}; }, {});
    ASSERT_EQ(lists.wrong_rows(), 0);
  }
  EXPECT_EQ(lists.worn_cells, 0);
  EXPECT_EQ(lists.builds, 0);
}

// Rows grow and outgrow their room.
TEST(RenewedLists, OfACollapseHaveRoom) {
  Random random(4);
  RenewedLists lists(random_points(random, 700, {0.2, 0.1, 0.1}, {0.8, 0.6, 0.7}), {}, {false, false, false});
  for (int steps = 0; steps < 60; ++steps) {
    lists.step([](Vec3d x) { return -0.01 * (x - Vec3d{0.5, 0.35, 0.4}); }, {});
    ASSERT_EQ(lists.wrong_rows(), 0) << "step " << steps;
  }
  EXPECT_GT(lists.worn_cells, 100);
}

}  // namespace
}  // namespace slagflow
