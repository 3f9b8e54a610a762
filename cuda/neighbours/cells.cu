#include "backend/launch.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

CellGrid CellGrid::cover(Vec3d extent, const std::array<bool, 3>& periodic, double least_width) {
  constexpr double most = 1 << 24;  // cells; a larger domain gets wider cells
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
