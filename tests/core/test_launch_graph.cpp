// Launches recorded for a graph: what a CUDA build repeats, and what it refuses to record.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/buffer.hpp"
#include "backend/error.hpp"
#include "backend/launch_graph.hpp"

namespace slagflow {
namespace {

bool on_gpu() { return device_info().backend == "cuda"; }

// Two buffers, a copy of one to the other that is recorded, and how often it was.
struct Copies {
  Context context;
  Buffer<int> from{context, "from"}, to{context, "to"};
  LaunchGraph graph{context, "copies"};
  int recorded = 0;

  Copies() { to.upload({0, 0, 0}); }
  std::vector<int> run(const std::vector<int>& values, double number) {
    from.upload(values);
    graph.run({number}, [this] {
      ++recorded;
      to.copy_from(from);
    });
    std::vector<int> result;
    to.download(result);
    return result;
  }
};

TEST(LaunchGraph, TakesTheContentsOfBuffersAsTheyAre) {
  Copies copies;
  EXPECT_EQ(copies.run({1, 2, 3}, 0), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(copies.run({4, 5, 6}, 0), (std::vector<int>{4, 5, 6}));
  EXPECT_EQ(copies.recorded, on_gpu() ? 1 : 2);
  EXPECT_EQ(copies.context.counts().graph_launches, on_gpu() ? 2 : 0);
}

TEST(LaunchGraph, RecordsAnewWithOtherNumbersOrBuffers) {
  Copies copies;
  copies.run({1, 2, 3}, 0), copies.run({1, 2, 3}, 1);
  EXPECT_EQ(copies.recorded, 2);
  Buffer<int> other(copies.context, "other");
  other.upload({7, 8, 9});
  copies.to.swap(other);
  EXPECT_EQ(copies.run({1, 2, 4}, 1), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(copies.recorded, 3);
  EXPECT_EQ(copies.run({5, 6}, 1), (std::vector<int>{5, 6}));
  EXPECT_EQ(copies.recorded, 4);
}

TEST(LaunchGraph, RecordsAnewWithAnotherNumberOfLaunches) {
  Copies copies;
  copies.run({1, 2, 3}, 0);
  copies.graph.run({1}, [&] {
    copies.from.copy_from(copies.to);
    copies.to.copy_from(copies.from);
  });
  EXPECT_EQ(copies.run({4, 5, 6}, 2), (std::vector<int>{4, 5, 6}));
  EXPECT_EQ(copies.context.counts().graph_launches, on_gpu() ? 3 : 0);
}

TEST(LaunchGraph, WhatCannotBeRecordedIsAnErrorAndTheContextGoesOn) {
  Copies copies;
  const auto wrong = [&](double number) {
    copies.graph.run({number}, [&] {
      copies.to.copy_from(copies.from);
      if (number == 1) copies.context.synchronize();
      if (number == 2) copies.to.resize(1000);
      if (number == 3) copies.context.workspace(1000000);
      if (number == 4) copies.to.upload({1});
      if (number == 5) throw Error("of its own");
    });
  };
  for (const double number : {1., 2., 3., 4., 5.}) {
    copies.run({1, 2, 3}, 0);
    if (on_gpu() || number == 5) {
      EXPECT_THROW(wrong(number), Error) << number;
    }
    EXPECT_EQ(copies.run({4, 5, 6}, 0), (std::vector<int>{4, 5, 6})) << number;
  }
}

TEST(LaunchGraph, LaunchesSinglyWhenAsked) {
  Copies copies;
  copies.graph.launch_singly();
  EXPECT_EQ(copies.run({1, 2, 3}, 0), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(copies.run({4, 5, 6}, 0), (std::vector<int>{4, 5, 6}));
  EXPECT_EQ(copies.recorded, 2);
  EXPECT_EQ(copies.context.counts().graph_launches, 0);
}

TEST(LaunchGraph, PostedBytesArriveAsWithACopy) {
  Context context;
  Buffer<int> numbers(context, "numbers");
  numbers.upload({7, 8});
  context.post_to_host(numbers.span().data, 2 * sizeof(int));
  int host[2] = {0, 0};
  const std::int64_t waits = context.counts().waits;
  context.read_posted(host, sizeof host);
  EXPECT_EQ(host[0], 7);
  EXPECT_EQ(host[1], 8);
  EXPECT_EQ(context.counts().waits, waits + 1);
}

}  // namespace
}  // namespace slagflow
