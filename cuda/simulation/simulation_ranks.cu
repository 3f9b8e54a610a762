// What a simulation does with several ranks.
#include "simulation/sharing.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

// The ranks begin with all particles each, and keep theirs at the first sort.
void Simulation::State::deal_out() {
  if (!ranks().several()) return;
  const auto places = [&](const std::vector<Vec3d>& positions) {
    std::vector<Vec3d> result;
    for (const Vec3d& x : positions) result.push_back(x - setup.domain.lower);
    return result;
  };
  ordering.deal_out(places(setup.particles.position), places(setup.walls.position));
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
