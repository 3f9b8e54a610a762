// What a simulation tells of itself: totals and profiles.
#include "observation/surfaces.hpp"
#include "simulation/simulation_state.hpp"
#include "viscosity/shear_stress.hpp"

namespace slagflow {

double Simulation::neighbours_mean() const {
  State& s = *state_;
  return mean_neighbours(s.context, s.pairs(), s.diagnostics);
}

void Simulation::State::tell_openings(Totals& t) const {
  t.mass_fed = fed_mass(), t.fed = inlets.fed();
  for (std::size_t k = 0; k < t.fed.size(); ++k)
    t.fed_mass.push_back(static_cast<double>(t.fed[k]) * particle_mass(setup, setup.inlets[k].fluid));
  for (std::size_t k = 0; k < setup.outlets.size(); ++k) {
    t.removed.push_back(0), t.removed_mass.push_back(0);
    for (std::size_t kind = 0; kind < departed.size(); ++kind) {
      const std::int64_t count = ordering.removed[k * departed.size() + kind];
      t.removed.back() += count;
      t.removed_mass.back() += static_cast<double>(count) * particle_mass(setup, kind);
    }
    t.mass_left += t.removed_mass.back();
  }
}

// What left through the face, or an outlet, beyond a front's plane has passed it.
void Simulation::State::tell_passed(Totals& t) const {
  for (std::size_t k = 0; k < t.fronts.size(); ++k) {
    const FrontSetup& front = setup.fronts[k];
    t.fronts[k].passed += t.departed[2 * static_cast<std::size_t>(front.axis) + (front.sign > 0 ? 1U : 0U)];
    for (std::size_t o = 0; o < setup.outlets.size(); ++o) {
      const OutletSetup& outlet = setup.outlets[o];
      const bool beyond = front.sign > 0 ? outlet.lower[front.axis] >= front.position
                                         : outlet.upper[front.axis] <= front.position;
      if (beyond) t.fronts[k].passed += t.removed[o];
    }
  }
}

// Nothing here waits but the search for levels, surfaces and ages, and the heat of walls.
void Simulation::State::gather(GatheredSums& sums, Totals& t) {
  gather_totals(sums, fluid, fluids.span(), setup, t);
  sheets.count_thin(pairs(), sums, t.in_thin_sheets);
  if (setup.measure_walls) t.walls.resize(setup.bodies.size());
  for (std::size_t body = 0; body < t.walls.size(); ++body) wall_forces.load(body, sums, t.walls[body]);
  planes.states(fluid, list_places.span(), sums, t.planes);
  rectangles.states(fluid, sums, t.fluxes);
  contact.states(pairs(), wall_to_fluid.view(), sums, t.contacts);
  residence.states(fluid, time, sums, t.residences);
  t.boxes.resize(setup.boxes.size()), t.solids.resize(setup.solids.size());
  for (std::size_t k = 0; k < t.boxes.size(); ++k)
    count_in_box(sums, fluid, setup.boxes[k], setup.domain.lower, t.boxes[k]);
  t.heat_is_on = heat.any();
  if (t.heat_is_on) heat.balance(fluid, fluids.span(), sums, t.heat);
  for (std::size_t k = 0; k < t.solids.size(); ++k)
    count_solid(sums, fluid, setup.solids[k], setup.domain.lower, t.solids[k]);
}

Totals Simulation::totals() {
  State& s = *state_;
  Totals t;
  GatheredSums sums(s.context, s.diagnostics);
  s.gather(sums, t);
  WallWork work;
  if (s.knows_wall_forces()) s.wall_forces.work(sums, work);
  sums.read();
  t.particles = s.fluid.count.of_all();
  t.mass_start = s.start_mass;
  t.dissipated_energy = s.taken + work.viscous;
  for (std::size_t kind = 0; kind < s.departed.size(); ++kind)
    for (std::size_t face = 0; face < faces; ++face) {
      t.departed[face] += s.departed[kind][face];
      t.mass_left += static_cast<double>(s.departed[kind][face]) * particle_mass(s.setup, kind);
    }
  s.tell_openings(t);
  t.impulse_time = s.time - 0.5 * s.last_dt;
  for (WallLoad& load : t.walls) {  // torques about the lower corner become those about the origin
    load.pressure_torque += cross(s.setup.domain.lower, load.pressure);
    load.viscous_torque += cross(s.setup.domain.lower, load.viscous);
  }
  s.tell_passed(t);
  for (const LineSetup& line : s.setup.levels) t.levels.push_back(level_of(s.profile(line)));
  for (std::size_t k = 0; k < s.setup.surfaces.size(); ++k) t.surfaces.push_back(surface(k));
  return t;
}

std::vector<ProfilePoint> Simulation::profile(std::size_t line) const {
  return state_->profile(state_->setup.lines.at(line));
}

std::vector<LevelState> Simulation::surface(std::size_t index) const {
  State& s = *state_;
  return measure_surface(s.context, s.profile_source(), s.setup.surfaces.at(index), s.setup.domain.lower);
}

ProfileSource Simulation::State::profile_source() const {
  return {fluid, ordering.fluid_sources(fluid), box, flow.smoothing, displacement};
}

std::vector<ProfilePoint> Simulation::State::profile(const LineSetup& line) {
  std::vector<ProfilePoint> profile = measure_profile(context, profile_source(), line, setup.domain.lower);
  for (ProfilePoint& point : profile) point.temperature += heat.reference();
  return profile;
}

void Simulation::State::measure_stress(Span<Real> result) {
  if (exact_yield())
    viscous.exact_yield().measure_stress(pairs(), fluid.shear_rate.span(), result);
  else
    measure_shear_stress(context, pairs(), static_cast<Real>(last_dt), result);
}

}  // namespace slagflow
