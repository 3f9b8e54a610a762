// How the entries of neighbour lists are stored. On a GPU in 16 bits, however many particles there are: what
// lies near a particle stands in some runs of the sorted particles, one or a few for each line of cells. A
// CPU waits longer for the decoding than for the memory that it saves, and keeps them as they are.
#pragma once

#include "backend/lanes.hpp"
#include "backend/span.hpp"

namespace slagflow {

// Rows of a list are stored in slices of `slice_width` targets whose k-th entries stand side by side, so that
// the threads of a warp load neighbouring words; a width of one keeps each row in one piece, as a CPU wants
// it. A row takes room for whole lanes; the entries beyond its length are valid particle numbers.
#if defined(SLAGFLOW_CUDA)
inline constexpr int slice_width = 32;
#else
inline constexpr int slice_width = 1;
#endif

HOST_DEVICE inline Offset whole_lanes(Index entries) {
  return (static_cast<Offset>(entries) + lane_count - 1) / lane_count * lane_count;
}

#if defined(SLAGFLOW_CUDA)

// A row has eight bases. A code tells which of them, in three bits, and how far beyond it; the list is plain
// where that does not do for all of it.
using Code = std::uint16_t;
inline constexpr int bases_per_row = 8, offset_bits = 13;
inline constexpr Index offset_mask = (1 << offset_bits) - 1;

// Where the bases of row i begin; each is a slice_width from the next.
HOST_DEVICE inline Offset bases_of(Index i) {
  return static_cast<Offset>(i / slice_width) * (slice_width * bases_per_row) + i % slice_width;
}
// How many there are of so many rows.
inline Offset bases_for(Offset rows) {
  return (rows + slice_width - 1) / slice_width * (slice_width * bases_per_row);
}

// Where entries are written: codes and bases, or none of them and plain entries.
struct CodeStore {
  Span<Code> code;
  Span<Index> base, plain;
};

// One row, to read.
struct ListRow {
  Offset first;       // of what is stored for each entry
  const Code* code;   // null: `plain` holds the entries
  const Index* base;  // of this row
  const Index* plain;
  mutable int chosen = -1;  // the last base
  mutable Index from = 0;   // and what it was

  // Of the k-th entry.
  HOST_DEVICE Offset at(Index k) const { return first + static_cast<Offset>(k) * slice_width; }
  HOST_DEVICE Index one(Index k) const {
    if (!code) return plain[at(k)];
    const int c = code[at(k)], which = c >> offset_bits;
    if (which != chosen) chosen = which, from = base[which * slice_width];
    return from + (c & offset_mask);
  }
  HOST_DEVICE Entries operator[](Index k) const { return {one(k)}; }
  HOST_DEVICE void foresee(Index) const {}
};

// One row, to write, an entry after the other.
class RowFiller {
 public:
  HOST_DEVICE RowFiller(const CodeStore& store, Offset first, Index i)
      : first_(first),
        code_(store.code.data),
        base_(store.base.data + bases_of(i)),
        plain_(store.plain.data) {}

  // Whether it fits: what does not is another entry of the row in its place.
  HOST_DEVICE bool put(Index j) {
    const Offset at = first_ + static_cast<Offset>(n_++) * slice_width;
    if (!code_) return plain_[at] = j, true;
    const int chosen = choose(j);
    const int base = chosen < 0 ? 0 : chosen;
    const auto beyond = chosen < 0 ? 0u : static_cast<unsigned>(j - base_[base * slice_width]);
    code_[at] = static_cast<Code>(static_cast<unsigned>(base) << offset_bits | beyond);
    return chosen >= 0;
  }
  HOST_DEVICE void finish() const {}

 private:
  HOST_DEVICE bool within(int base, Index j) const {
    return static_cast<unsigned>(j) - static_cast<unsigned>(base_[base * slice_width]) <=
           static_cast<unsigned>(offset_mask);
  }
  // Mostly the last one; -1 where another one is wanted than there are.
  HOST_DEVICE int choose(Index j) {
    for (int base = used_ - 1; base >= 0; --base)
      if (within(base, j)) return base;
    if (used_ == bases_per_row) return -1;
    base_[used_ * slice_width] = j;
    return used_++;
  }

  Offset first_;
  Code* code_;
  Index *base_, *plain_;
  Index n_ = 0;
  int used_ = 0;
};

#else

using Code = Index;

struct CodeStore {
  Span<Code> code;
};

// One row, to read.
struct ListRow {
  Offset first;  // of what is stored for each entry
  const Code* code;

  // Of the k-th entry.
  HOST_DEVICE_INLINED Offset at(Index k) const { return first + k; }
  Index one(Index k) const { return code[at(k)]; }
  // From the k-th on.
  HOST_DEVICE_INLINED Entries operator[](Index k) const { return {code + at(k)}; }
  HOST_DEVICE_INLINED void foresee(Index k) const { slagflow::foresee(code + at(k)); }
};

// One row, to write, an entry after the other.
class RowFiller {
 public:
  RowFiller(const CodeStore& store, Offset first, Index) : first_(first), code_(store.code.data) {}
  bool put(Index j) { return code_[first_ + n_++] = j, true; }
  // What fills up the last lanes may be read, but counts for nothing.
  void finish() {
    for (const Offset whole = whole_lanes(n_); n_ > 0 && n_ < whole; ++n_)
      code_[first_ + n_] = code_[first_ + n_ - 1];
  }

 private:
  Offset first_;
  Code* code_;
  Index n_ = 0;
};

#endif

}  // namespace slagflow
