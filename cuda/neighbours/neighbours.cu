#include "backend/primitives.hpp"
#include "backend/reduce.hpp"
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

// Room for rows of a slice to grow when they are filled anew.
constexpr Offset spare_entries = 4;

struct MeasureSlice {
  Span<const Index> length;
  Span<Offset> slice_length;
  HOST_DEVICE void operator()(Index s) const {
    Index longest = 0;
    const Offset first = static_cast<Offset>(s) * slice_width;
    const Offset end = smaller(first + slice_width, length.size);
    for (Offset i = first; i < end; ++i) longest = larger(longest, length[i]);
    slice_length[s] = (whole_lanes(longest) + spare_entries) * slice_width;
  }
};

// How many entries the codes do not do for.
template <class Box>
struct FillRow {
  static constexpr int terms = 1;
  Search<Box> search;
  Span<const Offset> slice;
  CodeStore store;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    RowFiller row(store, slice[i / slice_width] + i % slice_width, i);
    Index misfits = 0;
    search(i, [&](Index j, unsigned lanes) {
      if (lanes) misfits += row.put(j) ? 0 : 1;
    });
    return {{static_cast<double>(misfits)}};
  }
};

struct CellOfTarget {
  CellGrid grid;
  Span<const Quad> targets;
  Span<Index> cell;
  HOST_DEVICE void operator()(Index i) const { cell[i] = grid.cell_of(xyz(targets[i])); }
};

// Fills rows of worn cells anew; by how many entries one is too long for its slice, or the codes do not do.
template <class Box>
struct RenewRow {
  static constexpr int terms = 1;
  Search<Box> search;
  Span<const std::uint8_t> worn;  // of each cell
  Span<const Offset> slice;
  Span<Index> length;
  CodeStore store;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    if (!worn[search.cell[i]]) return {{0}};
    const Index s = i / slice_width;
    const auto room = static_cast<Index>((slice[s + 1] - slice[s]) / slice_width);
    RowFiller row(store, slice[s] + i % slice_width, i);
    Index n = 0, misfits = 0;
    search(i, [&](Index j, unsigned lanes) {
      if (lanes && n < room && !row.put(j)) ++misfits;
      n += number_of(lanes);
    });
    length[i] = smaller(n, room);
    return {{static_cast<double>(n - length[i] + misfits)}};
  }
};

struct KeepOverflow {
  StepRecord* record;
  HOST_DEVICE void operator()(const Terms<1>& beyond) const {
    record->worn = larger(record->worn, beyond.value[0]);
  }
};

}  // namespace

NeighbourList::NeighbourList(Context& context, const char* name)
    : context_(context),
      length_(context, name),
      target_cell_(context, name),
      slice_length_(context, name),
      slice_(context, name),
      used_(context, name, 2),
      code_(context, name),
      base_(context, name),
      plain_(context, name),
      room_(context, name),
      occupied_(context, name),
      spare_(context, name) {}

void NeighbourList::build(const SourceView& sources, Span<const Quad> targets, const PeriodicBox& box,
                          Real reach, Pairs pairs) {
  const bool self = pairs == Pairs::self;
  occupied_.resize(0);
  if (!self) mark_occupied(sources.grid, sources.cell_start);
  if (box.any())
    search_and_store(Search<PeriodicBox>{sources, targets, box, reach, self, occupied_.span()});
  else
    search_and_store(Search<OpenBox>{sources, targets, {}, reach, self, occupied_.span()});
}

// Most targets are far from any source of the other kind.
void NeighbourList::mark_occupied(const CellGrid& grid, Span<const Index> cell_start) {
  const Index cells = grid.cells();
  occupied_.resize(cells), spare_.resize(cells);
  Span<std::uint8_t> from = spare_.span(), to = occupied_.span();  // three turns end in the right one
  launch(context_, "cells with sources", cells, MarkSources{cell_start, from});
  for (int axis = 0; axis < 3; ++axis) {
    launch(context_, "cells near sources", cells, SpreadMarks{grid, axis, cells_moved, from, to});
    std::swap(from, to);
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

void NeighbourList::keep_plain() {
  all_plain_ = true;
  Buffer<Code> none(context_, "codes of lists");
  code_.swap(none);  // and what was recorded is recorded anew
}

void NeighbourList::resize_entries(Offset entries, Offset margin_percent) {
  all_plain_ ? plain_.resize(entries, margin_percent) : code_.resize(entries, margin_percent);
}

// A sixteenth or some more.
bool NeighbourList::make_room() {
  if constexpr (slice_width > 1) return false;
  const Offset used = used_.span()[0];
  if (used <= code_.size()) return false;
  constexpr Offset least = 1 << 16;
  const Offset wanted = used + larger(used / 16, least);
  code_.reserve(wanted);
  code_.resize(wanted);
  return true;
}

CodeStore NeighbourList::code_store() {
#if defined(SLAGFLOW_CUDA)
  return {all_plain_ ? Span<Code>() : code_.span(), base_.span(), plain_.span()};
#else
  return {code_.span()};
#endif
}

RowStore NeighbourList::row_store() {
  return {slice_.span(), length_.span(), room_.span(), code_.span(), used_.span()};
}

template <class Box>
void NeighbourList::store_rows(const Search<Box>& search) {
  using Fill = FillPiece<Box>;
  const auto n = static_cast<Index>(search.targets.size);
  const Index pieces = (n + Fill::targets_per_piece - 1) / Fill::targets_per_piece;
  const int range =
      static_cast<int>(std::ceil(static_cast<double>(search.reach) / search.sources.grid.narrowest));
  slice_.resize(n), room_.resize(n);
  do {
    used_.upload({0, 0});
    launch(context_, "fill neighbours", pieces, Fill{{search, range}, row_store()});
  } while (make_room());
  filled_ = used_.span()[0];
}

template <class Box>
void NeighbourList::store_slices(const Search<Box>& search) {
  const auto n = static_cast<Index>(search.targets.size);
  const Index slices = (n + slice_width - 1) / slice_width;
  target_cell_.resize(n);
  slice_length_.resize(slices);
  slice_.resize(slices + 1);
#if defined(SLAGFLOW_CUDA)
  base_.resize(bases_for(n));
#endif
  launch(context_, "cells of targets", n,
         CellOfTarget{search.sources.grid, search.targets, target_cell_.span()});
  launch(context_, "count neighbours", n, CountRow<Box>{search, length_.span()});
  launch(context_, "measure slices", slices, MeasureSlice{length_.span(), slice_length_.span()});
  exclusive_scan(context_, slice_length_.span(), slice_.span());
  context_.copy_to_host(&filled_, slice_.span().data + slices, sizeof filled_);
  constexpr Offset margin_percent = 1;
  for (Offset misfits = 1; misfits > 0;) {
    resize_entries(filled_, margin_percent);
    launch_reduction<AddUp>(context_, "fill neighbours", n, FillRow<Box>{search, slice_.span(), code_store()},
                            KeepMisfits{used_.span().data + 1});
    context_.copy_to_host(&misfits, used_.span().data + 1, sizeof misfits);
    if (misfits > 0) keep_plain();
  }
}

void NeighbourList::renew(const ListedParticles& particles, const Worn& worn) {
  particles.box.any() ? renew_in(particles.box, particles, worn) : renew_in(OpenBox{}, particles, worn);
}

template <class Box>
void NeighbourList::renew_in(const Box& box, const ListedParticles& particles, const Worn& worn) {
  if constexpr (slice_width == 1) {
    const IfOpen<RefillCell<Box>> body{
        {{search(box, particles), cells_moved}, row_store(), particles.target_start, worn.cells}, worn.gate};
    auto again = body;
    do {
      again.store = row_store();
      launch(context_, "renew neighbours", static_cast<Index>(worn.cells.size), again);
    } while (make_room());
  } else {
    const RenewRow<Box> body{search(box, particles), worn.cells, slice_.span(), length_.span(), code_store()};
    launch_reduction<TakeLargest>(context_, "renew neighbours", particles.count,
                                  IfOpen<RenewRow<Box>>{body, worn.gate}, KeepOverflow{worn.record});
  }
}

}  // namespace slagflow
