#include "backend/halo.hpp"
#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "viscosity/solvers/aggregates.hpp"

namespace slagflow {

namespace {

struct HoldsRows {
  RowCells rows;
  Index first;  // cell of the whole grid that the rank has
  Span<Offset> held;
  HOST_DEVICE void operator()(Index n) const {
    const RowRange own = rows.of(first + n);
    held[first + n] = own.end > own.first ? 1 : 0;
  }
};

struct HoldsAggregates {
  AggregateView finer;
  AggregateGrid grid;
  Span<Offset> held;
  HOST_DEVICE void operator()(Index cell) const {
    Offset any = 0;
    for (int child = 0; child < 8; ++child) {
      const int part[3] = {2 * grid.along(cell, 0) + (child & 1), 2 * grid.along(cell, 1) + (child >> 1 & 1),
                           2 * grid.along(cell, 2) + (child >> 2)};
      if (finer.grid.holds(part) && finer.number[finer.grid.cell_at(part)] >= 0) any = 1;
    }
    held[cell] = any;
  }
};

struct Number {
  Span<const Offset> held, before;
  AggregateGrid grid;
  Span<Index> number, cell;
  Span<CellSteps> steps;
  HOST_DEVICE void operator()(Index c) const {
    const auto own = static_cast<Index>(before[c]);
    number[c] = held[c] ? own : -1;
    if (held[c]) cell[own] = c, steps[own] = grid.steps(c);
  }
};

struct FindNeighbours {
  AggregateGrid grid;
  Span<const Index> number, cell;
  Span<Index> neighbour;
  HOST_DEVICE void operator()(Index i) const {
    for (int slot = 0; slot < neighbour_slots; ++slot) {
      const Index other = grid.cell_in(cell[i], slot);
      neighbour[static_cast<Offset>(i) * neighbour_slots + slot] = other < 0 ? -1 : number[other];
    }
  }
};

}  // namespace

AggregateGrid AggregateGrid::from(const CellGrid& cells) {
  AggregateGrid grid;
  for (int k = 0; k < 3; ++k) {
    grid.count[k] = cells.count[k];
    grid.periodic[k] = cells.periodic[k];
    grid.width[k] = 1 / static_cast<double>(cells.inverse_width[k]);
  }
  grid.order = cells.order, grid.stride = cells.stride;
  grid.scale = cells.narrowest;
  return grid;
}

AggregateGrid AggregateGrid::coarser() const {
  AggregateGrid grid = *this;
  for (int k = 0; k < 3; ++k) {
    grid.count[k] = (count[k] + 1) / 2;
    grid.width[k] = 2 * width[k];
  }
  grid.stride = Strides(grid.count, order);
  grid.scale = 2 * scale;
  return grid;
}

void gather_own(Context& context, const AggregateView& a, Buffer<double>& values, Offset each) {
  gather_parts(context, values, a.first_own * each, a.own * each);
}

Aggregates::Aggregates(Context& c)
    : context_(c),
      held_(c, "occupied cells"),
      before_(c, "occupied cells"),
      cell_(c, "cells of aggregates"),
      number_(c, "aggregates of cells"),
      neighbour_(c, "neighbours of aggregates"),
      steps_(c, "cells of aggregates") {}

void Aggregates::find(const RowCells& rows) {
  grid_ = AggregateGrid::from(rows.grid);
  held_.resize(grid_.cells());
  const Index first = rows.grid.slab.first * rows.grid.cells_of_plane(), own = rows.grid.own_cells();
  launch(context_, "occupied cells", own, HoldsRows{rows, first, held_.span()});
  if (rows.halo) gather_parts(context_, held_, first, own);
  number_cells();
  const auto before = [&](Index cell) {
    Offset aggregates = 0;
    context_.copy_to_host(&aggregates, before_.span().data + cell, sizeof aggregates);
    return static_cast<Index>(aggregates);
  };
  if (!rows.halo) return;
  first_own_ = before(first);
  own_ = before(first + own) - first_own_;
}

void Aggregates::find(const AggregateView& finer) {
  grid_ = finer.grid.coarser();
  held_.resize(grid_.cells());
  launch(context_, "occupied cells", grid_.cells(), HoldsAggregates{finer, grid_, held_.span()});
  number_cells();
}

void Aggregates::number_cells() {
  const Index cells = grid_.cells();
  before_.resize(cells + 1), number_.resize(cells);
  exclusive_scan(context_, held_.span(), before_.span());
  Offset total = 0;
  context_.copy_to_host(&total, before_.span().data + cells, sizeof total);
  count_ = own_ = static_cast<Index>(total);
  first_own_ = 0;
  constexpr Offset margin_percent = 10;
  cell_.resize(count_, margin_percent), steps_.resize(count_, margin_percent);
  neighbour_.resize(total * neighbour_slots, margin_percent);
  launch(context_, "number aggregates", cells,
         Number{held_.span(), before_.span(), grid_, number_.span(), cell_.span(), steps_.span()});
  launch(context_, "neighbours of aggregates", count_,
         FindNeighbours{grid_, number_.span(), cell_.span(), neighbour_.span()});
}

}  // namespace slagflow
