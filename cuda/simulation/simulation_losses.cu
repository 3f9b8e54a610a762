// What a simulation tells of particles that are lost.
#include "simulation/simulation_state.hpp"

namespace slagflow {

std::int64_t Simulation::particles() const { return state_->fluid.count.of_all(); }

std::int64_t Simulation::particles_of_rank() const { return state_->fluid.count; }

std::int64_t Simulation::copies_of_rank() const { return state_->fluid.local() - state_->fluid.count; }

std::vector<Vec3d> Simulation::positions() const {
  const State& s = *state_;
  std::vector<Vec3d> all = rows_of_all(s.fluid.position, s.fluid.count, On::first_rank);
  for (Vec3d& p : all) p += s.setup.domain.lower;
  return all;
}

std::vector<Vec3d> Simulation::below_wall_faces() {
  State& s = *state_;
  std::vector<Vec3d> found = ranks().gathered(s.below_faces.find(s.pairs(), s.fluid.position.span()));
  for (Vec3d& p : found) p += s.setup.domain.lower;
  return found;
}

}  // namespace slagflow
