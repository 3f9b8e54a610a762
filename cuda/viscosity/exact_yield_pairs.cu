// Keeps the stresses of an exact yield stress with their pairs when the neighbour lists are built anew.
#include "backend/error.hpp"
#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "viscosity/exact_yield.hpp"

namespace slagflow {

namespace {

// Finds p of the new rows in the old ones. Most neighbours stay, in their order: the search goes on from the
// last one found.
struct OldRow {
  const IdLists& list;
  Index row;  // -1: there is none

  HOST_DEVICE Offset find(Index id, Index& cursor) const {
    if (row < 0) return -1;
    const Index n = list.length[row];
    for (Index t = 0; t < n; ++t) {
      const Index k = cursor + t < n ? cursor + t : cursor + t - n;
      const Offset at = list.row(row) + k * ListView::stride();
      if (list.id[at] != id) continue;
      cursor = k + 1 < n ? k + 1 : 0;
      return at;
    }
    return -1;
  }
};

struct Carry {
  ListView fluid_list, wall_list;
  IdLists old_fluid, old_wall;
  Span<const Index> id, wall_id, row_of_id;
  Span<const Real> held, relative, old_own, old_other, old_wall_stress;
  Span<Real> new_held, new_relative, own, other, wall;

  HOST_DEVICE void operator()(Index i) const {
    const Index row = id[i] < row_of_id.size ? row_of_id[id[i]] : -1;
    const OldRow fluid_row{old_fluid, row}, wall_row{old_wall, row};
    const Index n = fluid_list.length[i], walls = wall_list.length[i];
    const ListRow of_fluid = fluid_list.entries(i), of_walls = wall_list.entries(i);
    Index cursor = 0;
    for (Index k = 0; k < whole_lanes(n); ++k) {
      const Offset at = of_fluid.at(k);
      const Offset from = k < n ? fluid_row.find(id[of_fluid.one(k)], cursor) : -1;
      own[at] = from < 0 ? 0 : old_own[from];
      other[at] = from < 0 ? 0 : old_other[from];
    }
    cursor = 0;
    for (Index k = 0; k < whole_lanes(walls); ++k) {
      const Offset at = of_walls.at(k);
      const Offset from = k < walls ? wall_row.find(wall_id[of_walls.one(k)], cursor) : -1;
      wall[at] = from < 0 ? 0 : old_wall_stress[from];
    }
    new_held[i] = row < 0 ? Real(1) : held[row];
    new_relative[i] = row < 0 ? Real(0) : relative[row];
  }
};

struct Fill {
  Span<Index> to;
  HOST_DEVICE void operator()(Index i) const { to[i] = -1; }
};

struct RowOfId {
  Span<const Index> id;
  Span<Index> row;
  HOST_DEVICE void operator()(Index i) const { row[id[i]] = i; }
};

// Keeps a list with ids for its entries.
struct Record {
  ListView list;
  Span<const Index> id;
  Span<Index> length, entry;
  HOST_DEVICE void operator()(Index i) const {
    const ListRow row = list.entries(i);
    length[i] = list.length[i];
    for (Index k = 0; k < list.length[i]; ++k) entry[row.at(k)] = id[row.one(k)];
  }
};

struct CopySlice {
  Span<const Offset> from;
  Span<Offset> to;
  HOST_DEVICE void operator()(Index s) const { to[s] = from[s]; }
};

struct MeasureRow {
  Span<const Index> length;
  Span<Offset> room;
  HOST_DEVICE void operator()(Index i) const { room[i] = whole_lanes(length[i]); }
};

// Rows in one piece each, from where they begin in one array to where they do in another.
struct MoveRow {
  Span<const Index> length;
  Span<const Offset> from_row, to_row;
  Span<const Real> from;
  Span<Real> to;
  HOST_DEVICE void operator()(Index i) const {
    for (Offset k = 0; k < whole_lanes(length[i]); ++k) to[to_row[i] + k] = from[from_row[i] + k];
  }
};

}  // namespace

void ExactYield::follow(const Lists& lists, Index ids) {
  constexpr Offset margin_percent = 1;
  const Offset n = lists.fluid_id.size();
  spare_own_.resize(lists.fluid.filled(), margin_percent);
  spare_other_.resize(lists.fluid.filled(), margin_percent);
  spare_wall_.resize(lists.wall.filled(), margin_percent);
  spare_held_.resize(n), spare_relative_.resize(n);
  launch(context_, "carry yield stresses", static_cast<Index>(n),
         Carry{lists.fluid.view(), lists.wall.view(), fluid_layout_.view(), wall_layout_.view(),
               lists.fluid_id.span(), lists.wall_id.span(), row_of_id_.span(), held_.span(), relative_.span(),
               own_.span(), other_.span(), wall_.span(), spare_held_.span(), spare_relative_.span(),
               spare_own_.span(), spare_other_.span(), spare_wall_.span()});
  own_.swap(spare_own_), other_.swap(spare_other_), wall_.swap(spare_wall_);
  held_.swap(spare_held_), relative_.swap(spare_relative_);
  remember(lists, ids);
}

// Where the rows of a list begin when they follow each other. Slices do so anyway.
Span<const Offset> ExactYield::ordered_rows(const Layout& layout) {
  const auto n = static_cast<Index>(layout.length.size());
  room_.resize(n), ordered_.resize(n + 1);
  launch(context_, "room of rows", n, MeasureRow{layout.length.span(), room_.span()});
  exclusive_scan(context_, room_.span(), ordered_.span());
  return ordered_.span();
}

void ExactYield::put_in_order() {
  spare_own_.copy_from(own_), spare_other_.copy_from(other_), spare_wall_.copy_from(wall_);
  if constexpr (slice_width > 1) return;
  const auto put = [&](const Layout& layout, Span<const Offset> row, const Buffer<Real>& from,
                       Buffer<Real>& to) {
    launch(context_, "yield stresses in order", static_cast<Index>(layout.length.size()),
           MoveRow{layout.length.span(), layout.slice.span(), row, from.span(), to.span()});
  };
  const Span<const Offset> rows = ordered_rows(fluid_layout_);
  put(fluid_layout_, rows, own_, spare_own_), put(fluid_layout_, rows, other_, spare_other_);
  put(wall_layout_, ordered_rows(wall_layout_), wall_, spare_wall_);
}

void ExactYield::take_restored(const Lists& lists, Index ids) {
  const Offset n = lists.fluid_id.size();
  const bool fits = spare_own_.size() == lists.fluid.filled() && spare_other_.size() == spare_own_.size() &&
                    spare_wall_.size() == lists.wall.filled() && held_.size() == n && relative_.size() == n;
  if (!fits) throw Error("checkpoint: its yield stresses do not belong to this case");
  remember(lists, ids);
  own_.copy_from(spare_own_), other_.copy_from(spare_other_), wall_.copy_from(spare_wall_);
  if constexpr (slice_width > 1) return;
  const auto take = [&](const Layout& layout, Span<const Offset> row, const Buffer<Real>& from,
                        Buffer<Real>& to) {
    launch(context_, "restored yield stresses", static_cast<Index>(layout.length.size()),
           MoveRow{layout.length.span(), row, layout.slice.span(), from.span(), to.span()});
  };
  const Span<const Offset> rows = ordered_rows(fluid_layout_);
  take(fluid_layout_, rows, spare_own_, own_), take(fluid_layout_, rows, spare_other_, other_);
  take(wall_layout_, ordered_rows(wall_layout_), spare_wall_, wall_);
}

void ExactYield::remember(const Lists& lists, Index ids) {
  const Offset n = lists.fluid_id.size();
  row_of_id_.resize(ids);
  launch(context_, "rows of ids", ids, Fill{row_of_id_.span()});
  launch(context_, "rows of ids", static_cast<Index>(n), RowOfId{lists.fluid_id.span(), row_of_id_.span()});
  record(lists.fluid, lists.fluid_id.span(), fluid_layout_);
  record(lists.wall, lists.wall_id.span(), wall_layout_);
}

void ExactYield::record(const NeighbourList& list, Span<const Index> id, Layout& layout) {
  constexpr Offset margin_percent = 1;
  const ListView view = list.view();
  layout.slice.resize(view.slice.size), layout.length.resize(view.length.size);
  layout.id.resize(list.filled(), margin_percent);
  launch(context_, "record slices", static_cast<Index>(view.slice.size),
         CopySlice{view.slice, layout.slice.span()});
  launch(context_, "record pairs", static_cast<Index>(view.length.size),
         Record{view, id, layout.length.span(), layout.id.span()});
}

}  // namespace slagflow
