#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "lane_math.hpp"
#include "neighbours.hpp"

namespace slagflow {

// Calls found(j, lanes) for sources j, j + 1, ... of which those whose bit is set in `lanes` are within reach
// of target i, in ascending order within each run of cells.
template <class Box>
struct Search {
  SourceView sources;
  Span<const Quad> targets;
  Box box;
  Real reach;
  bool self;
  Span<const std::uint8_t> occupied;  // 0: no source within reach of any place in the cell; empty: not known

  template <class Found>
  HOST_DEVICE void operator()(Index i, Found found) const {
    const Vec3 here = xyz(targets[i]);
    if (occupied.size > 0 && !occupied[sources.grid.cell_of(here)]) return;
    const LaneVec3 centre = in_lanes(here);
    sources.grid.for_cells_within(here, reach, [&](Index first, Index last) {
      const Index end = sources.cell_start[last + 1];
      for (Index j = sources.cell_start[first]; j < end; j += lane_count) {
        const LaneVec3 d = box.separation(centre, xyz(load_lanes(sources.place, j)));
        unsigned lanes = bits(dot(d, d) < Lanes(square(reach)));
        if (end - j < lane_count) lanes &= (1u << (end - j)) - 1;
        if (self && i >= j && i < j + lane_count) lanes &= ~(1u << (i - j));
        found(j, lanes);
      }
    });
  }
};

namespace {

// Whether there are sources in a cell or in those up to `range` away.
struct MarkOccupied {
  CellGrid grid;
  Span<const Index> cell_start;
  int range;
  Span<std::uint8_t> occupied;
  HOST_DEVICE void operator()(Index cell) const {
    bool any = false;
    grid.for_runs_around(
        cell, range, [&](Index first, Index last) { any = any || cell_start[last + 1] > cell_start[first]; });
    occupied[cell] = any ? 1 : 0;
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
      entry_(context, name),
      occupied_(context, name) {}

void NeighbourList::build(const SourceView& sources, Span<const Quad> targets, const PeriodicBox& box,
                          Real reach, Pairs pairs) {
  const bool self = pairs == Pairs::self;
  // Most targets are far from any source of the other kind.
  occupied_.resize(self ? 0 : sources.grid.cells());
  if (!self) {
    const int range = static_cast<int>(std::ceil(static_cast<double>(reach) / sources.grid.narrowest));
    launch(context_, "occupied cells", sources.grid.cells(),
           MarkOccupied{sources.grid, sources.cell_start, range, occupied_.span()});
  }
  if (box.any())
    search_and_store(Search<PeriodicBox>{sources, targets, box, reach, self, occupied_.span()});
  else
    search_and_store(Search<OpenBox>{sources, targets, {}, reach, self, occupied_.span()});
}

template <class Box>
void NeighbourList::search_and_store(const Search<Box>& search) {
  const auto n = static_cast<Index>(search.targets.size);
  const Index slices = (n + slice_width - 1) / slice_width;
  length_.resize(n);
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
