// Device memory: growth, moves, accounting, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "backend/buffer.hpp"
#include "backend/error.hpp"

namespace slagflow {
namespace {

std::vector<int> on_host(const Buffer<int>& b) {
  std::vector<int> result;
  b.download(result);
  return result;
}

TEST(Buffer, UploadAndDownloadRoundTrip) {
  Context context;
  Buffer<int> b(context, "numbers");
  std::vector<int> values(1000);
  std::iota(values.begin(), values.end(), -500);
  b.upload(values);
  EXPECT_EQ(b.size(), 1000);
  EXPECT_EQ(on_host(b), values);
  b.upload({});
  EXPECT_TRUE(on_host(b).empty());
}

TEST(Buffer, ShrinkingKeepsMemoryAndContents) {
  Context context;
  Buffer<int> b(context, "numbers");
  b.upload({1, 2, 3, 4});
  const std::size_t held = context.allocated();
  const int* place = b.span().data;
  b.resize(2);
  EXPECT_EQ(on_host(b), (std::vector<int>{1, 2}));
  b.resize(4);
  EXPECT_EQ(b.span().data, place);
  EXPECT_EQ(on_host(b), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(context.allocated(), held);
}

TEST(Buffer, GrowsWithAMarginSoThatGrowthIsRare) {
  Context context;
  Buffer<double> b(context, "numbers");
  b.resize(1000, 10);
  EXPECT_EQ(b.size(), 1000);
  EXPECT_EQ(context.allocated(), 1100 * sizeof(double));
  const double* place = b.span().data;
  b.resize(1100);
  EXPECT_EQ(b.span().data, place);
  b.resize(1101);
  EXPECT_EQ(context.allocated(), 1375 * sizeof(double)) << "a quarter more than there was";
  b.resize(2000);
  EXPECT_EQ(context.allocated(), 2000 * sizeof(double)) << "as much as is asked for where that is more";
}

TEST(Buffer, ReservingKeepsContents) {
  Context context;
  Buffer<int> b(context, "numbers");
  b.upload({1, 2, 3});
  b.reserve(8);
  EXPECT_EQ(on_host(b), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(context.allocated(), 8 * sizeof(int));
  const int* place = b.span().data;
  b.resize(8);
  b.reserve(4);
  EXPECT_EQ(b.span().data, place);
  EXPECT_EQ(b.capacity(), 8);
}

TEST(Context, WorkspaceGrowsByAQuarterSoThatGrowthIsRare) {
  Context context;
  const std::size_t before = context.allocated();
  context.workspace(1000);
  EXPECT_EQ(context.allocated() - before, 1000U);
  void* place = context.workspace(1001);
  EXPECT_EQ(context.allocated() - before, 1250U);
  EXPECT_EQ(context.workspace(1250), place);
  EXPECT_EQ(context.workspace(10), place);
}

TEST(Buffer, MoveTakesTheMemoryAlong) {
  Context context;
  Buffer<int> a(context, "a");
  a.upload({1, 2, 3});
  const int* place = a.span().data;
  Buffer<int> b(std::move(a));
  EXPECT_EQ(b.span().data, place);
  EXPECT_EQ(on_host(b), (std::vector<int>{1, 2, 3}));
  Buffer<int> c(context, "c", 5);
  c = std::move(b);
  EXPECT_EQ(on_host(c), (std::vector<int>{1, 2, 3}));
  static_assert(!std::is_copy_constructible_v<Buffer<int>>, "device memory is not copied by accident");
}

TEST(Buffer, SwapAndCopyFromAreByContents) {
  Context context;
  Buffer<int> a(context, "a"), b(context, "b");
  a.upload({1, 2}), b.upload({3, 4, 5});
  a.swap(b);
  EXPECT_EQ(on_host(a), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(on_host(b), (std::vector<int>{1, 2}));
  b.copy_from(a);
  EXPECT_EQ(on_host(b), on_host(a));
  EXPECT_NE(a.span().data, b.span().data);
}

TEST(Buffer, AccountingReturnsToZero) {
  Context context;
  {
    Buffer<int> a(context, "a", 100);
    EXPECT_EQ(context.allocated(), 400U);
    Buffer<double> b(context, "b", 10);
    EXPECT_EQ(context.allocated(), 480U);
    b.resize(20);
    EXPECT_EQ(context.allocated(), 560U);
    Buffer<int> c(std::move(a));
    EXPECT_EQ(context.allocated(), 560U);
  }
  EXPECT_EQ(context.allocated(), 0U);
}

TEST(Buffer, LackOfMemoryNamesWhatAndHowMuch) {
  Context context;
  Buffer<double> held(context, "small thing", 8);
  Buffer<double> b(context, "huge thing");
  const Offset elements = Offset(1) << 50;
  try {
    b.resize(elements);
    FAIL() << "2^53 bytes were given";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("huge thing"));
    EXPECT_THAT(e.what(), testing::HasSubstr(std::to_string(elements * 8)));
    EXPECT_THAT(e.what(), testing::HasSubstr("64"));
  }
  EXPECT_EQ(context.allocated(), 64U);
}

TEST(Buffer, IsUsableAfterLackOfMemory) {
  Context context;
  Buffer<double> b(context, "numbers");
  b.upload({1, 2});
  EXPECT_THROW(b.resize(Offset(1) << 50), Error);
  EXPECT_EQ(b.size(), 0);
  b.upload({3, 4, 5});
  EXPECT_EQ(b.size(), 3);
  EXPECT_EQ(context.allocated(), 3 * sizeof(double));
}

TEST(Context, WorkspaceGrowsAndIsKept) {
  Context context;
  void* first = context.workspace(100);
  EXPECT_EQ(context.workspace(50), first);
  EXPECT_GE(context.allocated(), 100U);
  EXPECT_LT(context.allocated(), 1000U);
  EXPECT_NE(context.workspace(100000), nullptr);
  EXPECT_GE(context.allocated(), 100000U);
}

TEST(Context, TimersAddUpByLabel) {
  Context context;
  for (int i = 0; i < 3; ++i) Section section(context, "work");
  const auto timings = context.timings();
  ASSERT_EQ(timings.count("work"), 1U);
  EXPECT_GE(timings.at("work"), 0);
  EXPECT_LT(timings.at("work"), 1);
}

}  // namespace
}  // namespace slagflow
