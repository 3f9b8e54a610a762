// What a simulation tells of particles that are lost.
#include "simulation/simulation_state.hpp"

namespace slagflow {

std::int64_t Simulation::particles() const { return state_->fluid.count; }

std::vector<Vec3d> Simulation::positions() const {
  const State& s = *state_;
  std::vector<Vec3d> all;
  s.fluid.position.download(all);
  for (Vec3d& p : all) p += s.setup.domain.lower;
  return all;
}

std::vector<Vec3d> Simulation::below_wall_faces() {
  State& s = *state_;
  std::vector<Vec3d> found = s.below_faces.find(s.pairs(), s.fluid.position.span());
  for (Vec3d& p : found) p += s.setup.domain.lower;
  return found;
}

}  // namespace slagflow
