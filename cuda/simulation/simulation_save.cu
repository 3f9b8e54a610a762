// Saves and restores a simulation to the bit.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "backend/error.hpp"
#include "simulation/saved_arrays.hpp"

namespace slagflow {

namespace {

// When and how far: what the walls follow from.
template <class Visitor, class State>
void visit_clock(Visitor& v, State& s) {
  v.number(s.time), v.number(s.dt), v.number(s.full_dt), v.number(s.last_dt), v.number(s.heat_time);
  v.number(s.list_time), v.number(s.heat_dt);
  v.number(s.displacement), v.number(s.taken), v.number(s.given), v.number(s.capillary_work);
  v.number(s.steps), v.number(s.builds);
  v.number(s.largest_compression.value), v.number(s.largest_compression.time);
  v.number(s.lists_worn);
}

template <class Visitor>
void visit_solves(Visitor& v, SolverTotals& all, SolveReport& last) {
  v.number(all.steps), v.number(all.iterations), v.number(all.max_iterations), v.number(all.worst_residual);
  v.number(all.yield_iterations), v.number(all.yield_unconverged), v.number(all.retried);
  v.number(last.iterations), v.number(last.residual), v.number(last.velocity_error), v.number(last.converged);
}

// Each part says itself what of it goes into a checkpoint.
template <class Visitor, class State>
void visit_parts(Visitor& v, State& s) {
  s.fluid.each(Fate::saved, [&](auto& array) { v.of_fluid(array.field.name, array); });
  s.wall.each(Fate::saved, [&](auto& array) { v.of_walls(array.field.name, array); });
  s.wall_forces.save(v), s.planes.save(v), s.rectangles.save(v), s.residence.save(v), s.viscous.save(v),
      s.watch.save(v), s.heat.save(v);
  v.of_fluid("list_places", s.list_places), s.list_age.save(v);
  const char* const bits[] = {"fluid_list_bits", "wall_list_bits", "wall_to_fluid_bits"};
  for (std::size_t k = 0; k < s.list_bits.size(); ++k) v.of_rows(bits[k], s.list_bits[k]);
  v.as_many("departed", s.departed);
  v.as_many("removed", s.ordering.removed);
  visit_solves(v, s.solver, s.report);
  v.end();
}

// What indices into other arrays are made of, and what the loop over the steps counts on. Anything else that
// is false in a checkpoint shows as a state that cannot go on.
template <class State>
void require_possible_clock(const State& s) {
  bool possible = s.time >= 0 && s.dt > 0 && s.full_dt > 0 && s.last_dt >= 0 && s.list_time >= 0 &&
                  s.heat_time >= 0 && s.heat_dt >= 0 && s.list_time <= s.time && s.steps >= 0 &&
                  s.builds >= 0;
  const double finite[] = {s.time,  s.dt,    s.full_dt,        s.last_dt,   s.displacement,
                           s.taken, s.given, s.capillary_work, s.heat_time, s.heat_dt};
  for (const double v : finite) possible = possible && std::isfinite(v);
  if (!possible) Restorer::refuse_numbers();
}

void require_possible(const FluidArrays& fluid, const Buffer<Quad>& list_places, const CellGrid& grid,
                      std::size_t kinds) {
  std::vector<std::uint8_t> kind;
  std::vector<Index> id;
  std::vector<Quad> place;
  fluid.fluid.download(kind), fluid.id.download(id), list_places.download(place);
  std::pair<Index, Index> before{0, -1};
  for (std::size_t k = 0; k < id.size(); ++k) {
    if (kind[k] >= kinds)
      throw Error("checkpoint: particle " + std::to_string(id[k]) + " is of fluid " +
                  std::to_string(kind[k]) + ", the case has " + std::to_string(kinds));
    const std::pair<Index, Index> key{grid.cell_of(xyz(place[k])), id[k]};
    if (key <= before || id[k] < 0) throw Error("checkpoint: its particles are not in order");
    before = key;
  }
}

constexpr const char* clock_name = "clock";  // time and last step [s], lower corner of the domain [m]
constexpr const char* fluid_names[] = {"position", "motion", "by_pressure", "hollow",
                                       "packing",  "id",     "fluid",       "enthalpy"};

bool holds(const SavedState& arrays, const char* name) {
  return std::any_of(arrays.begin(), arrays.end(), [=](const SavedArray& a) { return a.name == name; });
}

// Checks what a simulation counts on, that ids ascend among it.
void require_possible(const FluidState& f) {
  const std::vector<Index>& id = f.particles.memory.id;
  for (std::size_t k = 0; k < id.size(); ++k)
    if (id[k] < 0 || (k > 0 && id[k] <= id[k - 1]))
      throw Error("state: the numbers of its particles are not distinct");
  if (!(f.time >= 0 && f.last_step >= 0)) Restorer::refuse_numbers();
}

}  // namespace

SavedState fluid_arrays(const SavedState& saved, Vec3d lower) {
  SavedState result;
  for (const char* name : fluid_names)
    for (const SavedArray& array : saved)
      if (array.name == name) result.push_back(array);
  Restorer restorer(saved);
  double time = 0, dt = 0, full_dt = 0, last_dt = 0, heat_time = 0;
  restorer.number(time), restorer.number(dt), restorer.number(full_dt), restorer.number(last_dt);
  restorer.number(heat_time);
  std::vector<double> clock{larger(time, heat_time), last_dt, lower.x, lower.y, lower.z};
  Saver(result).values(clock_name, clock);
  return result;
}

SavedState fluid_arrays(const FluidSnapshot& s, const std::vector<FluidSetup>& fluids) {
  SavedState result;
  Saver saver(result);
  std::vector<Vec3d> position = s.position;
  std::vector<Quad> motion, by_pressure(s.id.size());
  std::vector<Real> hollow(s.id.size()), packing;
  std::vector<Index> id(s.id.begin(), s.id.end());
  std::vector<std::uint8_t> kind = s.fluid;
  for (std::size_t k = 0; k < s.id.size(); ++k) {
    const double rest = fluids.at(s.fluid[k]).rest_density, excess = static_cast<double>(s.density[k]) - rest;
    motion.push_back(
        quad(Vec3{s.velocity[k].x, s.velocity[k].y, s.velocity[k].z}, static_cast<Real>(excess)));
    packing.push_back(static_cast<Real>(1 + larger(excess, 0.0) / rest));
  }
  saver.values("position", position), saver.values("motion", motion);
  saver.values("by_pressure", by_pressure), saver.values("hollow", hollow);
  saver.values("packing", packing), saver.values("id", id), saver.values("fluid", kind);
  if (s.heat) {
    std::vector<double> temperature(s.temperature.begin(), s.temperature.end());
    saver.values("temperature", temperature);
  }
  std::vector<double> clock{s.time, 0, 0, 0, 0};
  saver.values(clock_name, clock);
  return result;
}

FluidState fluid_state(const SavedState& arrays) {
  const Restorer restorer(arrays, clock_name);
  std::vector<Vec3d> position;
  std::vector<Quad> motion, by_pressure;
  std::vector<Real> hollow, packing;
  std::vector<Index> id;
  std::vector<std::uint8_t> kind;
  std::vector<double> clock;
  restorer.values("position", position), restorer.values("motion", motion);
  restorer.values("by_pressure", by_pressure), restorer.values("hollow", hollow);
  restorer.values("packing", packing), restorer.values("id", id), restorer.values("fluid", kind);
  restorer.values(clock_name, clock);
  std::vector<double> enthalpy, temperature;  // one of them where heat was on
  if (holds(arrays, "enthalpy")) restorer.values("enthalpy", enthalpy);
  if (holds(arrays, "temperature")) restorer.values("temperature", temperature);
  const std::size_t n = id.size();
  Restorer::require_fit(position.size() == n && motion.size() == n && by_pressure.size() == n &&
                        hollow.size() == n && packing.size() == n && kind.size() == n && clock.size() == 5 &&
                        (enthalpy.empty() || enthalpy.size() == n) &&
                        (temperature.empty() || temperature.size() == n));
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  FluidState result;
  result.time = clock[0], result.last_step = clock[1];
  const Vec3d lower{clock[2], clock[3], clock[4]};
  FluidParticles& p = result.particles;
  for (const std::size_t i : order) {
    p.position.push_back(position[i] + lower), p.velocity.push_back(to_double(xyz(motion[i])));
    p.fluid.push_back(kind[i]), p.memory.id.push_back(id[i]);
    p.memory.excess.push_back(motion[i].w), p.memory.hollow.push_back(hollow[i]);
    p.memory.packing.push_back(packing[i]), p.memory.by_pressure.push_back(xyz(by_pressure[i]));
    if (!enthalpy.empty()) p.memory.enthalpy.push_back(enthalpy[i]);
    if (!temperature.empty()) p.temperature.push_back(temperature[i]);
  }
  require_possible(result);
  return result;
}

SavedState Simulation::save() const {
  State& s = *state_;
  SavedState result;
  s.remember_lists();
  Saver saver(result, s.saved_rows(s.fluid.count));
  visit_clock(saver, s);
  visit_parts(saver, s);
  s.list_bits = {};
  return result;
}

void Simulation::restore(const SavedState& saved) {
  State& s = *state_;
  Restorer restorer(saved);
  visit_clock(restorer, s);
  require_possible_clock(s);
  std::vector<Quad> places;
  restorer.values("list_places", places);
  const Ordering::Dealt dealt = s.ordering.deal_out(places);
  s.restore_walls();
  restorer.rows = s.saved_rows(dealt.own);
  s.fluid.resize(dealt.own);
  visit_parts(restorer, s);
  if (s.solver.steps < 0) Restorer::refuse_numbers();
  s.fluid.resize(dealt.own);
  if (ranks().several()) s.meet_neighbours(dealt.borders);
  require_possible(s.fluid, s.list_places, s.ordering.fluid_sources(s.fluid).grid, s.departed.size());
  s.last.reset();
  s.rebuild_lists_as_saved();
}

}  // namespace slagflow
