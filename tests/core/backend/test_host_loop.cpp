#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "backend/host_loop.hpp"

namespace slagflow {
namespace {

TEST(HostLoop, CallsEachPartOnce) {
  std::vector<int> calls(1000, 0);
  for_each_part(calls.size(), [&](std::size_t k) { ++calls[k]; });
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
  for_each_part(0, [](std::size_t) { FAIL(); });
}

TEST(HostLoop, RangesAreAllThereIs) {
  std::vector<int> calls(1003, 0);
  for_each_range(calls.size(), 10, [&](std::size_t first, std::size_t last) {
    EXPECT_LE(last - first, 10u);
    for (std::size_t k = first; k < last; ++k) ++calls[k];
  });
  EXPECT_EQ(calls, std::vector<int>(1003, 1));
}

TEST(HostLoop, ThrowsWhatTheFirstPartHasThrown) {
  try {
    for_each_part(100, [](std::size_t k) {
      if (k % 10 == 7) throw std::runtime_error(std::to_string(k));
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "7");
  }
}

}  // namespace
}  // namespace slagflow
