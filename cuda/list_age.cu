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
  Span<const Quad> wall_displacement;  // empty while all walls are at rest
  Real fluid_skin, wall_skin;
  Span<Real> excess;

  HOST_DEVICE void operator()(Index cell) const {
    const Quad own = displacement[cell];
    Real worst = -1;
    if (own.w >= 0) {
      const int x = cell % grid.count[0], y = cell / grid.count[0] % grid.count[1],
                z = cell / grid.count[0] / grid.count[1];
      grid.for_cells_around(x, y, z, 2, [&](Index other) {
        const Quad there = displacement[other];
        if (there.w >= 0) worst = larger(worst, norm(xyz(own) - xyz(there)) + own.w + there.w - fluid_skin);
        if (wall_start[other + 1] == wall_start[other]) return;
        const Quad wall = wall_displacement.size > 0 ? wall_displacement[other] : Quad{};
        worst = larger(worst, norm(xyz(own) - xyz(wall)) + own.w + wall.w - wall_skin);
      });
    }
    excess[cell] = worst;
  }
};

}  // namespace

ListAge::ListAge(Context& context)
    : context_(context),
      displacement_(context, "cell displacements"),
      wall_displacement_(context, "cell displacements of walls"),
      excess_(context, "cell approaches") {}

void ListAge::find_displacements(const MovedParticles& particles, Buffer<Quad>& displacement) {
  const Index cells = particles.now.grid.cells();
  displacement.resize(cells);
  launch(context_, "cell displacement", cells,
         CellDisplacement{particles.now, particles.start, displacement.span()});
}

bool ListAge::lists_hold(const MovedParticles& fluid, const MovedParticles& walls, const ListReach& reach) {
  const double fluid_moved = fluid.largest_displacement, walls_moved = walls.largest_displacement;
  if (fluid_moved <= 0.5 * reach.fluid_skin && fluid_moved + walls_moved <= reach.wall_skin) return true;
  const double farthest = reach.width - 0.5 * reach.support;
  if (!(fluid_moved <= farthest && walls_moved <= farthest)) return false;
  find_displacements(fluid, displacement_);
  if (walls_moved > 0) find_displacements(walls, wall_displacement_);
  const Index cells = fluid.now.grid.cells();
  excess_.resize(cells);
  launch(context_, "approach", cells,
         Approach{fluid.now.grid, displacement_.span(), walls.now.cell_start,
                  walls_moved > 0 ? wall_displacement_.span() : Span<const Quad>{},
                  static_cast<Real>(reach.fluid_skin), static_cast<Real>(reach.wall_skin), excess_.span()});
  return maximum(context_, excess_.span(), -1) <= 0;
}

}  // namespace slagflow
