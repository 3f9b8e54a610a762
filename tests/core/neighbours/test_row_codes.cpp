// Entries of neighbour lists as they are stored.
#include <gtest/gtest.h>

#include <vector>

#include "core/scene.hpp"
#include "neighbours/neighbours.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

// Two slices of rows, written and read back.
struct SomeRows {
  static constexpr Index rows = 64, most = 128;
  std::vector<Index> from = std::vector<Index>(static_cast<std::size_t>(rows) * most), back = from;
  std::vector<Index> length = std::vector<Index>(rows), misfits = length;

  Index& entry(Index i, Index k) {
    return from[static_cast<std::size_t>(i) * most + static_cast<std::size_t>(k)];
  }
  void run() {
    std::vector<Code> code(from.size());
    std::vector<Index> base(static_cast<std::size_t>(rows) * 8);
    CodeStore store;
    store.code = {code.data(), static_cast<Offset>(code.size())};
    const std::vector<Offset> slice = slices();
    ListView list{{host_span(slice), host_span(length)}, store.code, {}, {}};
#if defined(SLAGFLOW_CUDA)
    store.base = {base.data(), static_cast<Offset>(base.size())};
    list.base = store.base;
#endif
    for (Index i = 0; i < rows; ++i) {
      const auto row = static_cast<std::size_t>(i);
      RowFiller filler(store, list.row(i), i);
      for (Index k = 0; k < length[row]; ++k) misfits[row] += filler.put(entry(i, k)) ? 0 : 1;
      filler.finish();
      for (Index k = 0; k < length[row]; ++k)
        back[row * most + static_cast<std::size_t>(k)] = list.entries(i).one(k);
    }
  }
  static std::vector<Offset> slices() {
    std::vector<Offset> slice;
    for (Index i = 0; i < rows; i += slice_width) slice.push_back(static_cast<Offset>(i) * most);
    return slice;
  }
  void expect_as_written() const {
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k < static_cast<std::size_t>(length[i]); ++k)
        ASSERT_EQ(back[i * most + k], from[i * most + k]) << "row " << i << ", entry " << k;
  }
};

// What lies near a particle among 2 10^9: nine lines of cells, up to a hundred million apart, in any order as
// across a periodic face, three of them in one run of 8192.
TEST(RowCodes, HoldLinesOfCellsHoweverFarApart) {
  Random random(7);
  SomeRows all;
  for (Index i = 0; i < SomeRows::rows; ++i) {
    Index n = 0;
    const Index planes[] = {1000000000, 7, 2147480000 - 9000};
    for (const Index plane : planes)
      for (int line = 0; line < 3; ++line) {
        const Index first = plane + line * 2500 + static_cast<Index>(random.uniform(0, 1000));
        for (int k = 0; k < 9; ++k) all.entry(i, n++) = first + 2 * k;
      }
    all.length[static_cast<std::size_t>(i)] = i % 9 == 0 ? 0 : n - i % 5;
  }
  all.run();
  all.expect_as_written();
  for (const Index misfits : all.misfits) EXPECT_EQ(misfits, 0);
}

// Nine runs that are far apart are one more than there are bases for: that is told.
TEST(RowCodes, TellWhatTheyDoNotHold) {
  SomeRows all;
  for (Index i = 0; i < SomeRows::rows; ++i) {
    const Index runs = i % 2 == 0 ? 8 : 9;
    for (Index k = 0; k < runs; ++k) all.entry(i, k) = 20000 * (k + 1);
    all.length[static_cast<std::size_t>(i)] = runs;
  }
  all.run();
  for (Index i = 0; i < SomeRows::rows; ++i)
    EXPECT_EQ(all.misfits[static_cast<std::size_t>(i)], slice_width > 1 && i % 2 == 1 ? 1 : 0) << i;
}

}  // namespace
}  // namespace slagflow
