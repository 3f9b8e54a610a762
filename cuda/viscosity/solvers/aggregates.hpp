// Groups of rows that multigrid takes for rigid bodies: the cells that hold particles, then groups of 2x2x2
// of them, and so on.
#pragma once

#include "backend/buffer.hpp"
#include "viscosity/linear_system.hpp"

namespace slagflow {

// A cell's number along each axis.
struct CellSteps {
  int along[3];
};

// A grid of cells, of which an aggregate is one that holds rows.
struct AggregateGrid {
  int count[3] = {1, 1, 1};
  bool periodic[3] = {false, false, false};
  AxisOrder order;
  Strides stride;
  Vec3d width;       // of a cell [m]
  double scale = 1;  // [m]: rotations are told by the speed at this distance

  static AggregateGrid from(const CellGrid&);
  AggregateGrid coarser() const;
  bool single() const { return cells() == 1; }

  HOST_DEVICE Index cells() const { return count[0] * count[1] * count[2]; }
  HOST_DEVICE int along(Index cell, int axis) const { return cell / stride[axis] % count[axis]; }
  HOST_DEVICE bool holds(const int (&step)[3]) const {
    return step[0] < count[0] && step[1] < count[1] && step[2] < count[2];
  }
  HOST_DEVICE Index cell_at(const int (&step)[3]) const {
    return step[0] * stride[0] + step[1] * stride[1] + step[2] * stride[2];
  }
  HOST_DEVICE Vec3d centre(CellSteps cell) const {
    return {(cell.along[0] + 0.5) * width.x, (cell.along[1] + 0.5) * width.y,
            (cell.along[2] + 0.5) * width.z};
  }
  // The length of periodic axes on which a cell may touch another, or itself, from both sides [m]; else 0.
  HOST_DEVICE Vec3d short_period() const {
    Vec3d result;
    for (int axis = 0; axis < 3; ++axis)
      if (periodic[axis] && count[axis] < 3) result[axis] = count[axis] * width[axis];
    return result;
  }
  // From the centre of a cell to that of the one in a slot around it [m].
  HOST_DEVICE Vec3d offset(int slot) const {
    const int x = slot % 3 - 1, y = slot / 3 % 3 - 1, z = slot / 9 - 1;
    return {x * width.x, y * width.y, z * width.z};
  }
  // The cell of the next coarser grid that holds this one.
  HOST_DEVICE Index parent(Index cell, const AggregateGrid& coarse) const {
    return coarse.cell_at({along(cell, 0) / 2, along(cell, 1) / 2, along(cell, 2) / 2});
  }

  HOST_DEVICE CellSteps steps(Index cell) const { return {along(cell, 0), along(cell, 1), along(cell, 2)}; }

  // Where cell `to` stands around cell `from`: 0 to 26, 13 the cell itself, 26 - slot the way back; -1: they
  // do not touch. Across a periodic face only when there is no direct way, so that each pair has one slot.
  HOST_DEVICE int slot(CellSteps from, CellSteps to) const {
    int result = 0;
    for (int axis = 2; axis >= 0; --axis) {
      int step = to.along[axis] - from.along[axis];
      if (periodic[axis] && step > 1) step -= count[axis];
      if (periodic[axis] && step < -1) step += count[axis];
      if (step < -1 || step > 1) return -1;
      result = 3 * result + step + 1;
    }
    return result;
  }
  // The cell in a slot, -1: none.
  HOST_DEVICE Index cell_in(Index from, int slot) const {
    Index cell = 0;
    const int way[3] = {slot % 3 - 1, slot / 3 % 3 - 1, slot / 9 - 1};
    for (int axis = 2; axis >= 0; --axis) {
      int c = along(from, axis) + way[axis];
      if (periodic[axis]) c = (c + count[axis]) % count[axis];
      if (c < 0 || c >= count[axis]) return -1;
      cell += c * stride[axis];
    }
    return this->slot(steps(from), steps(cell)) == slot ? cell : -1;
  }
};

constexpr int neighbour_slots = 27, own_slot = 13;

// A body for the aggregates from one on.
template <class Body>
struct FromAggregate : Body {
  Index first;
  HOST_DEVICE void operator()(Index n) const { Body::operator()(first + n); }
};

// The aggregates of one level, numbered in the order of their cells. Every rank has those of all.
struct AggregateView {
  AggregateGrid grid;
  Index count = 0;
  Index first_own = 0, own = 0;  // of which rows the rank has
  Span<const Index> cell;        // of each aggregate
  Span<const CellSteps> steps;   // of the cell of each aggregate
  Span<const Index> number;      // of each cell, -1: empty
  Span<const Index> neighbour;   // neighbour_slots of each aggregate, -1: none
};

// Of so many numbers of each aggregate every rank has made its own: gives all of them to all.
void gather_own(Context&, const AggregateView&, Buffer<double>& values, Offset each);

class Aggregates {
 public:
  explicit Aggregates(Context&);

  // The finest level: cells with rows; and the next coarser one.
  void find(const RowCells&);
  void find(const AggregateView& finer);

  AggregateView view() const {
    return {grid_, count_, first_own_, own_, cell_.span(), steps_.span(), number_.span(), neighbour_.span()};
  }

 private:
  // From the numbers of rows or aggregates that each cell holds, in held_.
  void number_cells();

  Context& context_;
  AggregateGrid grid_;
  Index count_ = 0, first_own_ = 0, own_ = 0;
  Buffer<Offset> held_, before_;
  Buffer<Index> cell_, number_, neighbour_;
  Buffer<CellSteps> steps_;
};

}  // namespace slagflow
