#include "backend/launch.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

AxisOrder AxisOrder::of(const int (&count)[3]) {
  int slow = 0;
  for (int k = 1; k < 3; ++k)
    if (count[k] >= count[slow]) slow = k;
  const int first = slow == 0 ? 1 : 0, second = 3 - slow - first;
  const bool swapped = count[second] > count[first];
  AxisOrder order;
  order.axis[0] = swapped ? second : first, order.axis[1] = swapped ? first : second, order.axis[2] = slow;
  return order;
}

CellGrid CellGrid::cover(Vec3d extent, const std::array<bool, 3>& periodic, double least_width, double most) {
  CellGrid grid;
  double width = least_width * 1.000001;  // rounding must not push a pair further apart
  auto number = [&](int k) { return std::floor(larger(1.0, extent[k] / width)); };
  while (number(0) * number(1) * number(2) > most) width *= 1.1;
  Real inverse[3];
  for (int k = 0; k < 3; ++k) {
    grid.periodic[k] = periodic[static_cast<std::size_t>(k)];
    grid.count[k] = static_cast<int>(number(k));
    inverse[k] = static_cast<Real>(grid.count[k] / extent[k]);
  }
  grid.order = AxisOrder::of(grid.count);
  grid.stride = Strides(grid.count, grid.order);
  for (int k = 0; k < 3; ++k) {
    const int axis = grid.order.axis[k];
    grid.lines[k] = {grid.count[axis], grid.stride[axis], inverse[axis], grid.periodic[axis]};
  }
  grid.slab.own = grid.lines[2].count;
  grid.narrowest = width;
  grid.inverse_width = {inverse[0], inverse[1], inverse[2]};
  return grid;
}

namespace {

struct FindCellStart {
  Span<const std::uint64_t> keys;
  Index count;
  Span<Index> start;

  HOST_DEVICE void operator()(Index cell) const {
    Index low = 0, high = count;  // first particle whose cell is not below this one
    while (low < high) {
      const Index middle = low + (high - low) / 2;
      if (static_cast<Index>(keys[middle] >> 32) < cell)
        low = middle + 1;
      else
        high = middle;
    }
    start[cell] = low;
  }
};

}  // namespace

void CellRanges::find(Context& context, const CellGrid& grid, Span<const std::uint64_t> keys, Index count) {
  start.resize(grid.cells() + 1);
  launch(context, "cell starts", grid.cells() + 1, FindCellStart{keys, count, start.span()});
}

}  // namespace slagflow
