// Neighbour lists: which source particles lie within a reach of each target particle.
#pragma once

#include "backend/buffer.hpp"
#include "backend/lanes.hpp"
#include "fluid/math.hpp"
#include "fluid/params.hpp"
#include "neighbours/cells.hpp"

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

struct ListView {
  Span<const Offset> slice;  // where each slice begins
  Span<const Index> length;  // entries of each row
  Span<const Index> entry;

  HOST_DEVICE static Offset stride() { return slice_width; }
  HOST_DEVICE Offset row(Index i) const { return slice[i / slice_width] + i % slice_width; }
};

template <class Box>
struct Search;

class NeighbourList {
 public:
  NeighbourList(Context&, const char* name);

  // Lists, for each target, the sources closer than `reach` [m], in the order of the sources. With `self`,
  // targets and sources are the same particles and a particle is not its own neighbour.
  // Throws Error when memory ends.
  enum class Pairs { self, other };
  void build(const SourceView& sources, Span<const Quad> targets, const PeriodicBox& box, Real reach, Pairs);

  ListView view() const { return {slice_.span(), length_.span(), entry_.span()}; }
  Offset capacity() const { return capacity_; }  // entries, padding included

 private:
  template <class Box>
  void search_and_store(const Search<Box>&);
  template <class Box>
  void store_rows(const Search<Box>&);  // a row at a time, each in one piece
  template <class Box>
  void store_slices(const Search<Box>&);
  void mark_occupied(const CellGrid&, Span<const Index> cell_start, int range);

  Context& context_;
  Buffer<Index> length_;
  Buffer<Offset> slice_length_, slice_, used_;
  Buffer<Index> entry_;
  Buffer<std::uint8_t> occupied_, spare_;  // of each cell
  Offset capacity_ = 0;
};

}  // namespace slagflow
