// What a simulation does with several ranks.
#include "simulation/sharing.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

namespace {

template <class T>
void keep_only(const std::vector<std::size_t>& kept, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> result;
  result.reserve(kept.size());
  for (const std::size_t i : kept) result.push_back(values[i]);
  values = std::move(result);
}

}  // namespace

// Of the fluid of the start a rank uploads that of its slab; of walls all, and keeps its own at the first
// sort.
void Simulation::State::deal_out() {
  const auto places = [&](const std::vector<Vec3d>& positions) {
    std::vector<Vec3d> result;
    for (const Vec3d& x : positions) result.push_back(x - setup.domain.lower);
    return result;
  };
  FluidParticles& p = setup.particles;
  const std::vector<Vec3d> fluid_places = places(p.position);
  ordering.deal_out(fluid_places, places(setup.walls.position));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < fluid_places.size(); ++i)
    if (ordering.owns(fluid_places[i])) kept.push_back(i);
  keep_only(kept, p.position), keep_only(kept, p.velocity), keep_only(kept, p.pressure);
  keep_only(kept, p.fluid), keep_only(kept, p.temperature);
  FluidMemory& m = p.memory;
  keep_only(kept, m.excess), keep_only(kept, m.hollow), keep_only(kept, m.packing);
  keep_only(kept, m.by_pressure), keep_only(kept, m.id), keep_only(kept, m.enthalpy);
}

void Simulation::State::sort_walls() {
  if (!wall.count.halo || !knows_wall_forces()) return ordering.sort(wall);
  const std::vector<Index> before = own_walls();
  ordering.sort(wall);
  wall_forces.follow(before, own_walls());
}

std::vector<Index> Simulation::State::own_walls() const {
  std::vector<Index> ids;
  wall.id.download(ids);
  ids.resize(static_cast<std::size_t>(wall.count.now));
  return ids;
}

SavedRows Simulation::State::saved_rows(Index fluid_rows) const {
  return {PartOfRows(fluid_rows), PartOfRows(wall.count),
          PartOfRows(ordering.fluid_sources(fluid).grid.own_cells())};
}

// Of a state from a file, which is without the copies of the neighbours' particles.
void Simulation::State::meet_neighbours(const Borders& borders) {
  fluid.resize(slagflow::meet_neighbours(ordering.slabs(), fluid.count, borders));
  exchange_all(fluid);
  list_places.reserve(fluid.local());
  list_places.resize(fluid.local());
  exchange(context, fluid.count, list_places);
  exchange(context, wall.count, wall.pressure);
  if (knows_wall_forces()) wall_forces.keep(own_walls());
}

}  // namespace slagflow
