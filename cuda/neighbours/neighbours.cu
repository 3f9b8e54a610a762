#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "neighbours/group_search.hpp"

namespace slagflow {

namespace {

struct MarkSources {
  Span<const Index> cell_start;
  Span<std::uint8_t> marked;
  HOST_DEVICE void operator()(Index cell) const {
    marked[cell] = cell_start[cell + 1] > cell_start[cell] ? 1 : 0;
  }
};

// Marks the cells up to `range` away along one axis from those that are marked.
struct SpreadMarks {
  CellGrid grid;
  int axis, range;
  Span<const std::uint8_t> from;
  Span<std::uint8_t> to;
  HOST_DEVICE void operator()(Index cell) const {
    std::uint8_t any = 0;
    grid.for_line_around(cell, axis, range, [&](Index other) { any |= from[other]; });
    to[cell] = any;
  }
};

template <class Box>
struct CountRow {
  Search<Box> search;
  Span<Index> length;
  HOST_DEVICE void operator()(Index i) const {
    Index n = 0;
    search(i, [&](Index, unsigned lanes) { n += number_of(lanes); });
    length[i] = n;
  }
};

struct MeasureSlice {
  Span<const Index> length;
  Span<Offset> slice_length;
  HOST_DEVICE void operator()(Index s) const {
    Index longest = 0;
    const Offset first = static_cast<Offset>(s) * slice_width;
    const Offset end = smaller(first + slice_width, length.size);
    for (Offset i = first; i < end; ++i) longest = larger(longest, length[i]);
    slice_length[s] = whole_lanes(longest) * slice_width;
  }
};

template <class Box>
struct FillRow {
  Search<Box> search;
  Span<const Offset> slice;
  Span<const Index> length;
  Span<Index> entry;
  HOST_DEVICE void operator()(Index i) const {
    const Offset row = slice[i / slice_width] + i % slice_width;
    Index* at = &entry[row];
    const Index* end = at + whole_lanes(length[i]) * slice_width;
    search(i, [&](Index j, unsigned lanes) { at = append<slice_width>(at, end, j, lanes); });
    // What fills up the last lanes may be read, but counts for nothing.
    for (Offset k = length[i]; k < whole_lanes(length[i]); ++k) entry[row + k] = search.self ? i : 0;
  }
};

}  // namespace

NeighbourList::NeighbourList(Context& context, const char* name)
    : context_(context),
      length_(context, name),
      slice_length_(context, name),
      slice_(context, name),
      used_(context, name, 1),
      entry_(context, name),
      occupied_(context, name),
      spare_(context, name) {}

void NeighbourList::build(const SourceView& sources, Span<const Quad> targets, const PeriodicBox& box,
                          Real reach, Pairs pairs) {
  const bool self = pairs == Pairs::self;
  const int range = static_cast<int>(std::ceil(static_cast<double>(reach) / sources.grid.narrowest));
  occupied_.resize(0);
  if (!self) mark_occupied(sources.grid, sources.cell_start, range);
  if (box.any())
    search_and_store(Search<PeriodicBox>{sources, targets, box, reach, range, self, occupied_.span()});
  else
    search_and_store(Search<OpenBox>{sources, targets, {}, reach, range, self, occupied_.span()});
}

// Most targets are far from any source of the other kind.
void NeighbourList::mark_occupied(const CellGrid& grid, Span<const Index> cell_start, int range) {
  const Index cells = grid.cells();
  occupied_.resize(cells), spare_.resize(cells);
  launch(context_, "cells with sources", cells, MarkSources{cell_start, occupied_.span()});
  for (int axis = 0; axis < 3; ++axis) {
    launch(context_, "cells near sources", cells,
           SpreadMarks{grid, axis, range, occupied_.span(), spare_.span()});
    occupied_.swap(spare_);
  }
}

template <class Box>
void NeighbourList::search_and_store(const Search<Box>& search) {
  length_.resize(search.targets.size);
  if constexpr (slice_width == 1)
    store_rows(search);
  else
    store_slices(search);
}

template <class Box>
void NeighbourList::store_rows(const Search<Box>& search) {
  using Fill = FillPiece<Box>;
  const auto n = static_cast<Index>(search.targets.size);
  const Index pieces = (n + Fill::targets_per_piece - 1) / Fill::targets_per_piece;
  slice_.resize(n);
  constexpr Offset margin_percent = 1;
  for (;;) {
    used_.upload({0});
    launch(context_, "fill neighbours", pieces,
           Fill{search, slice_.span(), length_.span(), entry_.span(), used_.span()});
    context_.copy_to_host(&capacity_, used_.span().data, sizeof capacity_);
    if (capacity_ <= entry_.size()) return;
    entry_.resize(capacity_, margin_percent);
  }
}

template <class Box>
void NeighbourList::store_slices(const Search<Box>& search) {
  const auto n = static_cast<Index>(search.targets.size);
  const Index slices = (n + slice_width - 1) / slice_width;
  slice_length_.resize(slices);
  slice_.resize(slices + 1);
  launch(context_, "count neighbours", n, CountRow<Box>{search, length_.span()});
  launch(context_, "measure slices", slices, MeasureSlice{length_.span(), slice_length_.span()});
  exclusive_scan(context_, slice_length_.span(), slice_.span());
  context_.copy_to_host(&capacity_, slice_.span().data + slices, sizeof capacity_);
  constexpr Offset margin_percent = 1;
  entry_.resize(capacity_, margin_percent);
  launch(context_, "fill neighbours", n, FillRow<Box>{search, slice_.span(), length_.span(), entry_.span()});
}

}  // namespace slagflow
