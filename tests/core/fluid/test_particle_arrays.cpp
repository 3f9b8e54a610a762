// Particles come and go: counts, capacity, and the list of arrays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numeric>
#include <set>
#include <sstream>
#include <string>

#include "core/cleared_arrays.hpp"
#include "fluid/particles.hpp"
#include "neighbours/ordering.hpp"

namespace slagflow {
namespace {

template <class T>
std::vector<T> on_host(const Buffer<T>& buffer) {
  std::vector<T> result;
  buffer.download(result);
  return result;
}

// Bytes of a particle in all arrays that are there in every run.
std::size_t bytes_each(const ParticleArrays& arrays) {
  std::size_t bytes = 0;
  arrays.each([&](const auto& array) {
    using T = typename std::decay_t<decltype(array)>::Element;
    if (!has(array.field.fate, Fate::optional)) bytes += sizeof(T);
  });
  return bytes;
}

std::size_t bytes_of(const Context& context, std::size_t before) { return context.allocated() - before; }

TEST(ParticleArrays, TakeNoMoreThanTheFirstParticlesNeed) {
  Context context;
  FluidArrays fluid(context);
  WallArrays wall(context);
  const std::size_t before = context.allocated();
  fluid.resize(1000);
  EXPECT_EQ(bytes_of(context, before), 1000 * bytes_each(fluid));
  wall.resize(10);
  EXPECT_EQ(bytes_of(context, before), 1000 * bytes_each(fluid) + 10 * bytes_each(wall));
}

TEST(ParticleArrays, KeepWhatIsThereAsParticlesCome) {
  Context context;
  FluidArrays fluid(context);
  fluid.resize(3);
  fluid.id.upload({7, 8, 9});
  fluid.position.upload({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  fluid.resize(100);
  EXPECT_EQ(fluid.count, 100);
  EXPECT_EQ(fluid.capacity(), 100);
  std::vector<Index> id = on_host(fluid.id);
  ASSERT_EQ(id.size(), 100U);
  id.resize(3);
  EXPECT_EQ(id, (std::vector<Index>{7, 8, 9}));
  EXPECT_EQ(on_host(fluid.position)[2], (Vec3d{7, 8, 9}));
  fluid.each([](const auto& array) {
    EXPECT_EQ(array.size(), has(array.field.fate, Fate::optional) ? 0 : 100) << array.field.name;
  });
}

// 1000, 1250, 1562, 1952, 2440: four times for a thousand particles that come one by one.
TEST(ParticleArrays, GrowByAQuarterSoThatFewArrivalsTakeMemory) {
  Context context;
  FluidArrays fluid(context);
  fluid.resize(1000);
  std::int64_t arrays = 0;
  fluid.each([&](const auto& array) { arrays += has(array.field.fate, Fate::optional) ? 0 : 1; });
  const std::int64_t before = context.counts().allocations;
  for (Index n = 1001; n <= 2000; ++n) fluid.resize(n);
  EXPECT_EQ(context.counts().allocations - before, 4 * arrays);
  EXPECT_EQ(fluid.capacity(), 2440);
}

class CapacityOf : public ::testing::Test {
 protected:
  CapacityOf() {
    clear(fluid_, 101);  // from 100 on, so that there is room
    fluid_.resize(100);
    std::vector<Index> id(100);
    std::iota(id.rbegin(), id.rend(), 0);
    fluid_.id.upload(id);
    positions_ = std::vector<Vec3d>(100, {0.5, 0.5, 0.5});
  }
  void sort() {
    fluid_.position.upload(positions_);
    ordering_.sort(fluid_, departed_);
  }

  Context context_;
  FluidArrays fluid_{context_};
  Ordering ordering_{context_, {1, 1, 1}, {false, false, false}, CellGrid::cover({1, 1, 1}, {}, 0.25)};
  DepartureCounts departed_ = DepartureCounts(1);
  std::vector<Vec3d> positions_;
};

TEST_F(CapacityOf, OutlivesSorting) {
  sort();
  const std::size_t held = context_.allocated();
  fluid_.each(Fate::sorted, [](const auto& array) { EXPECT_GE(array.capacity(), 101) << array.field.name; });
  fluid_.resize(101);
  EXPECT_EQ(context_.allocated(), held);
  EXPECT_EQ(on_host(fluid_.id)[99], 99) << "the sorted values went with the memory";
}

TEST_F(CapacityOf, ServesAParticleThatLeavesAndOneThatComes) {
  sort();
  const std::int64_t before = context_.counts().allocations;
  positions_[3] = {2, 0.5, 0.5};  // beyond the face +x
  sort();
  EXPECT_EQ(fluid_.count, 99);
  EXPECT_EQ(departed_[0][1], 1);
  fluid_.resize(100);
  positions_[3] = {0.5, 0.5, 0.5};
  sort();
  EXPECT_EQ(fluid_.count, 100);
  EXPECT_EQ(context_.counts().allocations, before) << "memory was taken for a particle that came";
}

TEST(ParticleArrays, HaveNamesOfTheirOwn) {
  Context context;
  const FluidArrays fluid(context);
  const WallArrays wall(context);
  std::set<std::string> names;
  const auto take = [&](const auto& array) {
    EXPECT_TRUE(names.insert(array.field.name).second) << array.field.name << " is declared twice";
  };
  fluid.each(take), wall.each(take);
  EXPECT_GT(names.size(), 20U);
}

std::string row(const ParticleField& field) {
  std::string fates;
  const auto tell = [&](Fate fate, const char* name) {
    if (has(field.fate, fate)) fates += (fates.empty() ? "" : ", ") + std::string(name);
  };
  tell(Fate::sorted, "sorted"), tell(Fate::saved, "saved"), tell(Fate::shown, "shown");
  tell(Fate::optional, "optional");
  return "| `" + std::string(field.name) + "` | " + field.unit + " | " + field.meaning + " | " +
         (fates.empty() ? "set anew" : fates) + " |\n";
}

TEST(ParticleArrays, AreTheRowsOfTheTableInTheReadme) {
  std::ifstream file(SLAGFLOW_SOURCE_DIR "/cuda/README.md");
  std::stringstream readme;
  readme << file.rdbuf();
  Context context;
  const FluidArrays fluid(context);
  const WallArrays wall(context);
  std::string table;
  const auto add = [&](const auto& array) { table += row(array.field); };
  fluid.each(add), wall.each(add);
  EXPECT_THAT(readme.str(), ::testing::HasSubstr("|---|---|---|---|\n" + table + "\n"));
}

}  // namespace
}  // namespace slagflow
