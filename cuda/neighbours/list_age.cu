#include "backend/reduce.hpp"
#include "fluid/lane_math.hpp"
#include "neighbours/list_age.hpp"
#include "neighbours/search.hpp"

namespace slagflow {

namespace {

struct Open {
  Index* opened;
  HOST_DEVICE void operator()(Index) const { *opened = 1; }
};

// Since the last look, which ends with it.
struct CellDisplacement {
  SourceView sources;
  Span<Quad> before;
  Span<Quad> result;

  HOST_DEVICE void operator()(Index cell) const {
    const Index first = sources.cell_start[cell], end = sources.cell_start[cell + 1];
    if (first == end) {
      result[cell] = {0, 0, 0, -1};
      return;
    }
    Vec3 mean;
    for (Index i = first; i < end; ++i) mean += xyz(sources.place[i]) - xyz(before[i]);
    mean *= Real(1) / static_cast<Real>(end - first);
    Real deviation = 0;
    for (Index i = first; i < end; ++i) {
      const Vec3 d = xyz(sources.place[i]) - xyz(before[i]) - mean;
      deviation = larger(deviation, dot(d, d));
      before[i] = sources.place[i];
    }
    result[cell] = quad(mean, std::sqrt(deviation));
  }
};

// How far what moves as `own` may come towards particles of the cells around one, if any are there [m].
HOST_DEVICE Real approach(const CellGrid& grid, Index cell, Quad own, Span<const Quad> displacement) {
  const LaneVec3 mean = in_lanes(xyz(own));
  Lanes most = Real(-1);
  grid.for_runs_around(cell, cells_moved, [&](Index first, Index last) {
    for (Index c = first; c <= last; c += lane_count) {
      const QuadLanes there = load_lanes(displacement, c);
      const LaneVec3 d = mean - xyz(there);
      const LaneMask any = (Lanes(Real(-0.5)) < there.w) & first_lanes(last + 1 - c);
      most = larger(most, select(any, root(dot(d, d)) + there.w, Lanes(Real(-1))));
    }
  });
  const Real result = -least(-most);
  return result < 0 ? result : result + own.w;
}

struct Wear {
  CellGrid grid;
  Span<const std::uint8_t> beside;
  Span<Real> wear;
  Span<std::uint8_t> worn;

  // Adds some skins, and returns how many are beyond one; what is worn is new again when it is renewed.
  HOST_DEVICE Real add(Index cell, Real more, bool renewed) const {
    const Real all = wear[cell] + larger(more, Real(0));
    const bool out = !(all <= 1);
    worn[cell] = out && renewed ? 1 : 0;
    wear[cell] = out && renewed ? Real(0) : all;
    return all - 1;
  }
};

struct WearOfFluid : Wear {
  static constexpr int terms = 1;
  Span<const Quad> own, walls;  // displacements; of walls none while all are at rest
  Real fluid_skin, wall_skin;
  bool renewed;

  HOST_DEVICE Terms<1> operator()(Index cell) const {
    worn[cell] = 0;
    const Quad here = own[cell];
    if (!(here.w >= 0)) return {{-1}};
    Real more = approach(grid, cell, here, own) / fluid_skin;
    if (beside[cell])
      more = larger(
          more, (walls.size > 0 ? approach(grid, cell, here, walls) : norm(xyz(here)) + here.w) / wall_skin);
    return {{static_cast<double>(add(cell, more, renewed))}};
  }
};

struct WearOfWalls : Wear {
  SourceView sources;
  Span<const Quad> fluid, walls;
  Real skin;

  HOST_DEVICE void operator()(Index cell) const {
    worn[cell] = 0;
    if (!beside[cell] || sources.cell_start[cell] == sources.cell_start[cell + 1]) return;
    add(cell, approach(grid, cell, walls.size > 0 ? walls[cell] : Quad{}, fluid) / skin, true);
  }
};

struct KeepWorn {
  StepRecord* record;
  bool renewed;
  HOST_DEVICE void operator()(const Terms<1>& beyond) const {
    record->worn = renewed ? 0 : larger(beyond.value[0], 0.0);
  }
};

struct NoWear {
  Span<Real> fluid, walls;
  HOST_DEVICE void operator()(Index cell) const { fluid[cell] = walls[cell] = 0; }
};

// Room for a register of cells beyond the last.
Offset with_room(Index cells) { return static_cast<Offset>(cells) + lane_count; }

}  // namespace

ListAge::ListAge(Context& context, Renewal renewal)
    : context_(context),
      renewal_(renewal),
      before_(context, "places of the last look"),
      walls_before_(context, "wall places of the last look"),
      displacement_(context, "cell displacements"),
      wall_displacement_(context, "cell displacements of walls"),
      wear_(context, "wear of lists"),
      wall_wear_(context, "wear of lists of walls"),
      worn_(context, "worn cells"),
      walls_worn_(context, "worn cells of walls"),
      opened_(context, "looks at lists", 1) {}

void ListAge::begin(const SourceView& fluid, const SourceView& walls) {
  const Index cells = fluid.grid.cells();
  opened_.upload({0});
  wear_.resize(cells), wall_wear_.resize(cells);
  slagflow::launch(context_, "no wear", cells, NoWear{wear_.span(), wall_wear_.span()});
  restore(fluid, walls);
}

void ListAge::restore(const SourceView& fluid, const SourceView& walls) {
  const Index cells = fluid.grid.cells();
  own_cells_ = fluid.grid.own_cells();
  displacement_.resize(with_room(cells)), worn_.resize(cells), walls_worn_.resize(cells);
  wear_.reserve(cells), wall_wear_.reserve(cells);  // of which a restored state has the rank's own
  wear_.resize(cells), wall_wear_.resize(cells);
  const auto keep = [&](Buffer<Quad>& before, Span<const Quad> places) {
    before.resize(places.size);
    context_.copy_on_device(before.span().data, places.data,
                            static_cast<std::size_t>(places.size) * sizeof(Quad));
  };
  keep(before_, fluid.place), keep(walls_before_, walls.place);
}

bool ListAge::opened() const {
  std::vector<Index> now;
  opened_.download(now);
  return now[0] != 0;
}

void ListAge::launch(const Particles& fluid, const Particles& walls, const ListGate& gate,
                     StepRecord* record) {
  const CellGrid& grid = fluid.now.grid;
  const Index cells = grid.cells();
  const bool renewed = renewal_ == Renewal::by_cell, walls_move = walls_before_.size() > 0;
  if (walls_move) wall_displacement_.resize(with_room(cells));
  const Span<Quad> moved = displacement_.span(),
                   walls_moved = walls_move ? wall_displacement_.span() : Span<Quad>{};
  slagflow::launch(context_, "open lists", 1, IfOpen<Open>{{opened_.span().data}, gate});
  slagflow::launch(context_, "cell displacement", cells,
                   IfOpen<CellDisplacement>{{fluid.now, before_.span(), moved}, gate});
  if (walls_move)
    slagflow::launch(context_, "cell displacement", cells,
                     IfOpen<CellDisplacement>{{walls.now, walls_before_.span(), walls_moved}, gate});
  const WearOfFluid of_fluid{{grid, fluid.beside, wear_.span(), worn_.span()},
                             moved,
                             walls_moved,
                             static_cast<Real>(gate.reach.fluid_skin),
                             static_cast<Real>(gate.reach.wall_skin),
                             renewed};
  Rows own_cells(own_cells_);
  own_cells.halo = fluid.halo;
  launch_reduction<TakeLargest>(context_, "wear of lists", own_cells, IfOpen<WearOfFluid>{of_fluid, gate},
                                KeepWorn{record, renewed});
  if (!renewed) return;
  const WearOfWalls of_walls{{grid, walls.beside, wall_wear_.span(), walls_worn_.span()},
                             walls.now,
                             moved,
                             walls_moved,
                             static_cast<Real>(gate.reach.wall_skin)};
  slagflow::launch(context_, "wear of lists of walls", own_cells_, IfOpen<WearOfWalls>{of_walls, gate});
}

void ListAge::launch_look(const Particles& fluid, const Particles& walls, const ListReach& reach,
                          StepRecord* record) {
  launch(fluid, walls, gate(reach, record), record);
}

bool ListAge::look(const Particles& fluid, const Particles& walls, const ListReach& reach,
                   StepRecord* record) {
  const Verdict verdict = judge(fluid.largest_displacement, walls.largest_displacement, reach);
  if (verdict == Verdict::broken || (verdict == Verdict::hold && !opened())) return false;
  launch(fluid, walls, gate(reach, nullptr), record);
  return true;
}

}  // namespace slagflow
