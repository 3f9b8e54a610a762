#include "backend/reduce.hpp"
#include "neighbours/list_age.hpp"

namespace slagflow {

namespace {

enum class Verdict { hold, broken, open };

// What the largest displacements tell already.
HOST_DEVICE Verdict judge(double fluid_moved, double walls_moved, const ListReach& reach) {
  if (fluid_moved <= 0.5 * reach.fluid_skin && fluid_moved + walls_moved <= reach.wall_skin)
    return Verdict::hold;
  const double farthest = reach.width - 0.5 * reach.support;
  return fluid_moved <= farthest && walls_moved <= farthest ? Verdict::open : Verdict::broken;
}

// Idle where the record, if there is one, decides alone.
template <class Body>
struct IfOpen : Body {
  const StepRecord* record;
  ListReach reach;
  HOST_DEVICE bool idle() const {
    return record && (!record->solve.converged ||
                      judge(std::sqrt(record->displacement_squared), 0, reach) != Verdict::open);
  }
};

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
  static constexpr int terms = 1;
  CellGrid grid;
  Span<const Quad> displacement;
  Span<const Index> wall_start;
  Span<const Quad> wall_displacement;  // empty while all walls are at rest
  Real fluid_skin, wall_skin;

  // Beyond the skin [m].
  HOST_DEVICE Terms<1> operator()(Index cell) const {
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
    return {{static_cast<double>(worst)}};
  }
};

struct KeepApproach {
  double* approach;
  HOST_DEVICE void operator()(const Terms<1>& largest) const { *approach = largest.value[0]; }
};

}  // namespace

// Whose moves count, and where the approach goes.
struct ListAge::Moves {
  const StepRecord* record;  // null: the host has decided already that it is needed
  double* approach;
};

ListAge::ListAge(Context& context)
    : context_(context),
      displacement_(context, "cell displacements"),
      wall_displacement_(context, "cell displacements of walls"),
      approach_(context, "approach of cells", 1) {}

void ListAge::reserve(const CellGrid& grid) { displacement_.resize(grid.cells()); }

void ListAge::launch_approach(const Moves& moves, const MovedParticles& fluid, const MovedParticles& walls,
                              const ListReach& reach) {
  const Index cells = fluid.now.grid.cells();
  const auto displacements = [&](const MovedParticles& particles, Buffer<Quad>& displacement) {
    displacement.resize(cells);
    const CellDisplacement body{particles.now, particles.start, displacement.span()};
    launch(context_, "cell displacement", cells, IfOpen<CellDisplacement>{body, moves.record, reach});
    return Span<const Quad>(displacement.span());
  };
  const auto moved = displacements(fluid, displacement_);
  const bool walls_move = walls.largest_displacement > 0;
  const auto walls_moved = walls_move ? displacements(walls, wall_displacement_) : Span<const Quad>{};
  const Approach body{fluid.now.grid,
                      moved,
                      walls.now.cell_start,
                      walls_moved,
                      static_cast<Real>(reach.fluid_skin),
                      static_cast<Real>(reach.wall_skin)};
  launch_reduction<TakeLargest>(context_, "approach", cells, IfOpen<Approach>{body, moves.record, reach},
                                KeepApproach{moves.approach});
}

bool ListAge::lists_hold(const MovedParticles& fluid, const MovedParticles& walls, const ListReach& reach) {
  const Verdict verdict = judge(fluid.largest_displacement, walls.largest_displacement, reach);
  if (verdict != Verdict::open) return verdict == Verdict::hold;
  launch_approach({nullptr, approach_.span().data}, fluid, walls, reach);
  double approach = 0;
  context_.copy_to_host(&approach, approach_.span().data, sizeof approach);
  return approach <= 0;
}

void ListAge::launch_approach(SourceView fluid, Span<const Quad> start, Span<const Index> wall_start,
                              const ListReach& reach, StepRecord* record) {
  SourceView walls = fluid;
  walls.cell_start = wall_start;
  launch_approach({record, &record->approach}, {fluid, start, 0}, {walls, {}, 0}, reach);
}

bool ListAge::lists_hold(const StepRecord& record, const ListReach& reach) {
  const Verdict verdict = judge(std::sqrt(record.displacement_squared), 0, reach);
  return verdict == Verdict::open ? record.approach <= 0 : verdict == Verdict::hold;
}

}  // namespace slagflow
