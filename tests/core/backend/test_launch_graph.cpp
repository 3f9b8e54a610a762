// Launches recorded for a graph: what a CUDA build repeats, and what it refuses to record.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/buffer.hpp"
#include "backend/error.hpp"
#include "backend/launch_graph.hpp"
#include "core/graph_loops.hpp"

namespace slagflow {
namespace {

using testing_tools::on_gpu;
using testing_tools::records_loops;

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
  copies.to.resize(2), copies.context.arrange_anew();
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

// A queue whose first number says whether it moves up another time.
struct Queue {
  Context context;
  Buffer<std::int32_t> numbers{context, "numbers", 5}, rest{context, "rest", 4};
  LaunchGraph graph{context, "queue"};
  int turns = 0;

  void turn() {
    ++turns;
    context.copy_on_device(rest.span().data, numbers.span().data + 1, 4 * sizeof(std::int32_t));
    context.copy_on_device(numbers.span().data, rest.span().data, 4 * sizeof(std::int32_t));
  }
  void repeat() {
    context.repeat_while(numbers.span().data, [this] { turn(); });
  }
  std::vector<std::int32_t> first_two() {
    std::vector<std::int32_t> result;
    numbers.download(result);
    result.resize(2);
    return result;
  }
};

TEST(Loop, TakesATurnWhileTheNumberIsNotZero) {
  Queue queue;
  queue.numbers.upload({1, -1, 5, 0, 7});
  queue.repeat();
  EXPECT_EQ(queue.turns, 3);
  EXPECT_EQ(queue.first_two(), (std::vector<std::int32_t>{0, 7}));
  queue.repeat();
  EXPECT_EQ(queue.turns, 3);
}

TEST(Loop, InAGraphDependsOnTheNumbersOfTheTime) {
  if (!records_loops()) GTEST_SKIP() << "on a GPU, with SLAGFLOW_GRAPH_LOOPS=1";
  Queue queue;
  Buffer<std::int32_t> behind(queue.context, "behind", 5);
  const auto run = [&](const std::vector<std::int32_t>& numbers) {
    queue.numbers.upload(numbers);
    queue.graph.run({}, [&] {
      queue.repeat();
      behind.copy_from(queue.numbers);
    });
    std::vector<std::int32_t> result;
    behind.download(result);
    EXPECT_EQ(result[0], 0);
    return result[1];
  };
  EXPECT_EQ(run({1, 1, 0, 7, 0}), 7);
  EXPECT_EQ(run({1, 1, 1, 0, 8}), 8);
  EXPECT_EQ(run({0, 9, 1, 1, 1}), 9);
  queue.context.arrange_anew();
  EXPECT_EQ(run({1, 0, 6, 1, 1}), 6);
  EXPECT_EQ(queue.turns, on_gpu() ? 2 : 6);
  EXPECT_EQ(queue.context.counts().graph_launches, on_gpu() ? 4 : 0);
}

TEST(Loop, WhatCannotBeRecordedInItIsAnErrorAndTheContextGoesOn) {
  if (!records_loops()) GTEST_SKIP() << "on a GPU, with SLAGFLOW_GRAPH_LOOPS=1";
  Queue queue;
  queue.numbers.upload({1, 0, 4, 0, 0});
  EXPECT_THROW(
      queue.graph.run(
          {},
          [&] { queue.context.repeat_while(queue.numbers.span().data, [] { throw Error("of its own"); }); }),
      Error);
  queue.graph.run({}, [&] { queue.repeat(); });
  EXPECT_EQ(queue.first_two(), (std::vector<std::int32_t>{0, 4}));
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
