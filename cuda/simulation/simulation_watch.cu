// What ends a run that cannot go on.
#include <cmath>
#include <sstream>

#include "backend/error.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

void Simulation::State::look() {
  Section timer(context, "watch");
  std::int64_t left = 0;
  for (const auto& by_face : departed)
    for (const std::int64_t count : by_face) left += count;
  GatheredSums sums(context, diagnostics);
  WallWork work;
  Vitals vitals;
  if (knows_wall_forces()) wall_forces.work(sums, work);
  if (fluid.count.of_all() > 0) gather_vitals(sums, fluid, fluids.span(), setup, vitals);
  sums.read();
  watch.look(fluid, vitals,
             {now(), dt, taken + work.viscous, work.viscous + work.elastic + capillary_work, given,
              last ? last->given : 0, steps, left, inlets.all_fed(), fed_mass()});
  heat.require_possible(fluid, now(), diagnostics);
}

// Names the first particle that is not a number: by its motion, or else by its density, which follows within
// a step.
void Simulation::State::check_finite() {
  const auto position = rows_of_all(fluid.position, fluid.count, On::all_ranks);
  const auto motion = rows_of_all(fluid.motion, fluid.count, On::all_ranks);
  const auto id = rows_of_all(fluid.id, fluid.count, On::all_ranks);
  std::ostringstream message;
  message << "not a number in step " << steps + 1 << " at " << time << " s: ";
  for (const bool motion_only : {true, false})
    for (std::size_t i = 0; i < id.size(); ++i) {
      const Quad m = motion[i];
      const Vec3d x = position[i] + setup.domain.lower;
      if (std::isfinite(m.x + m.y + m.z) && std::isfinite(x.x + x.y + x.z) &&
          (motion_only || std::isfinite(m.w)))
        continue;
      message << "particle " << id[i] << " at (" << x.x << ", " << x.y << ", " << x.z << ") m, velocity ("
              << m.x << ", " << m.y << ", " << m.z << ") m/s, density excess " << m.w
              << " kg/m^3; try a smaller courant or a larger sound_speed";
      throw Error(message.str());
    }
  message << "in the viscous solve; try a smaller courant";
  throw Error(message.str());
}

}  // namespace slagflow
