#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "list_age.hpp"

namespace slagflow {

namespace {

struct CellDisplacement {
  SourceView sources;
  Span<const Quad> start;
  Span<Quad> result;

  HOST_DEVICE void operator()(Index cell) const {
    const Index first = sources.cell_start[cell], end = sources.cell_start[cell + 1];
    if (first == end) {
      result[cell] = {0, 0, 0, -1};
      return;
    }
    Vec3 mean;
    for (Index i = first; i < end; ++i) mean += xyz(sources.place[i]) - xyz(start[i]);
    mean *= Real(1) / static_cast<Real>(end - first);
    Real deviation = 0;
    for (Index i = first; i < end; ++i) {
      const Vec3 d = xyz(sources.place[i]) - xyz(start[i]) - mean;
      deviation = larger(deviation, dot(d, d));
    }
    result[cell] = quad(mean, std::sqrt(deviation));
  }
};

struct Approach {
  CellGrid grid;
  Span<const Quad> displacement;
  Span<const Index> wall_start;
  Real fluid_skin, wall_skin;
  Span<Real> excess;

  HOST_DEVICE void operator()(Index cell) const {
    const Quad own = displacement[cell];
    Real worst = -1;
    if (own.w >= 0) {
      const int x = cell % grid.count[0], y = cell / grid.count[0] % grid.count[1],
                z = cell / grid.count[0] / grid.count[1];
      const Real moved = norm(xyz(own)) + own.w;
      grid.for_cells_around(x, y, z, 2, [&](Index other) {
        const Quad there = displacement[other];
        if (there.w >= 0) worst = larger(worst, norm(xyz(own) - xyz(there)) + own.w + there.w - fluid_skin);
        if (wall_start[other + 1] > wall_start[other]) worst = larger(worst, moved - wall_skin);
      });
    }
    excess[cell] = worst;
  }
};

}  // namespace

ListAge::ListAge(Context& context)
    : context_(context), displacement_(context, "cell displacements"), excess_(context, "cell approaches") {}

bool ListAge::lists_hold(const SourceView& sources, const SourceView& walls, Span<const Quad> start,
                         const ListReach& reach, double largest_displacement) {
  if (largest_displacement <= smaller(0.5 * reach.fluid_skin, reach.wall_skin)) return true;
  if (!(largest_displacement <= reach.width - 0.5 * reach.support)) return false;
  const Index cells = sources.grid.cells();
  displacement_.resize(cells), excess_.resize(cells);
  launch(context_, "cell displacement", cells, CellDisplacement{sources, start, displacement_.span()});
  launch(context_, "approach", cells,
         Approach{sources.grid, displacement_.span(), walls.cell_start, static_cast<Real>(reach.fluid_skin),
                  static_cast<Real>(reach.wall_skin), excess_.span()});
  return maximum(context_, excess_.span(), -1) <= 0;
}

}  // namespace slagflow
