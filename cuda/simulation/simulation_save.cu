// Saves and restores a simulation to the bit.
#include <cmath>
#include <cstring>
#include <utility>

#include "backend/error.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

namespace {

// Numbers that are not particle arrays.
struct SavedNumbers {
  double time, dt, full_dt, last_dt, displacement, taken, given, capillary_work, list_time;
  std::int64_t steps, builds;
  std::int64_t solver_steps, solver_iterations, solver_retried, yield_iterations, yield_unconverged;
  double worst_residual, residual, velocity_error, lowest_energy, given_before;
  std::int32_t max_iterations, iterations, converged, real_size;
};

// One pass over the arrays serves both ways, so that they cannot differ.
class Saver {
 public:
  explicit Saver(SavedState& state) : state_(state) {}

  template <class T>
  void array(const char* name, Buffer<T>& buffer) {
    std::vector<T> host;
    buffer.download(host);
    values(name, host);
  }
  template <class T>
  void values(const char* name, std::vector<T>& host) {
    SavedArray saved{name, sizeof(T), std::vector<std::byte>(host.size() * sizeof(T))};
    if (!host.empty()) std::memcpy(saved.bytes.data(), host.data(), saved.bytes.size());
    state_.push_back(std::move(saved));
  }

 private:
  SavedState& state_;
};

class Restorer {
 public:
  explicit Restorer(const SavedState& state) : state_(state) {}

  template <class T>
  void array(const char* name, Buffer<T>& buffer) {
    std::vector<T> host;
    values(name, host);
    buffer.upload(host);
  }
  template <class T>
  void values(const char* name, std::vector<T>& host) {
    for (const SavedArray& saved : state_) {
      if (saved.name != name) continue;
      if (saved.element_size != sizeof(T) || saved.bytes.size() % sizeof(T) != 0)
        throw Error("checkpoint: array '" + saved.name + "' has elements of " +
                    std::to_string(saved.element_size) + " bytes, this build has " +
                    std::to_string(sizeof(T)));
      host.resize(saved.bytes.size() / sizeof(T));
      if (!host.empty()) std::memcpy(host.data(), saved.bytes.data(), saved.bytes.size());
      return;
    }
    throw Error("checkpoint: array '" + std::string(name) + "' is missing");
  }

 private:
  const SavedState& state_;
};

template <class Visitor, class State>
void visit_arrays(Visitor& v, State& s) {
  FluidArrays& f = s.fluid;
  v.array("position", f.position), v.array("place", f.place), v.array("motion", f.motion);
  v.array("increment", f.increment), v.array("last_increment", f.last_increment),
      v.array("by_pressure", f.by_pressure), v.array("packing", f.packing), v.array("id", f.id),
      v.array("fluid", f.fluid);
  v.array("state", f.state), v.array("pressure", f.pressure), v.array("shear_rate", f.shear_rate);
  v.array("wall_pressure", s.wall.pressure), v.array("wall_impulse", s.wall_forces.impulses());
  v.array("list_places", s.list_places);
  v.values("departed", s.departed), v.values("planes", s.planes.records);
}

// What indices into other arrays are made of, and what the loop over the steps counts on. Anything else that
// is false in a checkpoint shows as a state that cannot go on.
void require_possible(const SavedNumbers& v) {
  const bool possible = v.time >= 0 && std::isfinite(v.time) && v.dt > 0 && std::isfinite(v.dt) &&
                        v.full_dt > 0 && std::isfinite(v.full_dt) && v.last_dt >= 0 &&
                        std::isfinite(v.last_dt) && v.list_time >= 0 && v.list_time <= v.time &&
                        std::isfinite(v.displacement) && std::isfinite(v.taken) && std::isfinite(v.given) &&
                        std::isfinite(v.capillary_work) && v.steps >= 0 && v.builds >= 0 &&
                        v.solver_steps >= 0;
  if (!possible) throw Error("checkpoint: its numbers are not those of a run");
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

}  // namespace

SavedState Simulation::save() const {
  State& s = *state_;
  SavedState result;
  Saver saver(result);
  visit_arrays(saver, s);
  if (s.exact_yield()) s.viscous.exact_yield().visit_arrays(saver);
  std::vector<SavedNumbers> numbers{{s.time,
                                     s.dt,
                                     s.full_dt,
                                     s.last_dt,
                                     s.displacement,
                                     s.taken,
                                     s.given,
                                     s.capillary_work,
                                     s.list_time,
                                     s.steps,
                                     s.builds,
                                     s.solver.steps,
                                     s.solver.iterations,
                                     s.solver.retried,
                                     s.solver.yield_iterations,
                                     s.solver.yield_unconverged,
                                     s.solver.worst_residual,
                                     s.report.residual,
                                     s.report.velocity_error,
                                     s.watch.lowest_energy,
                                     s.watch.given_before,
                                     s.solver.max_iterations,
                                     s.report.iterations,
                                     s.report.converged ? 1 : 0,
                                     static_cast<std::int32_t>(sizeof(Real))}};
  saver.values("numbers", numbers);
  return result;
}

void Simulation::restore(const SavedState& saved) {
  State& s = *state_;
  std::vector<SavedNumbers> numbers;
  Restorer restorer(saved);
  restorer.values("numbers", numbers);
  if (numbers.size() != 1 || numbers[0].real_size != static_cast<std::int32_t>(sizeof(Real)))
    throw Error("checkpoint: it was written by a build of another precision");
  const std::size_t kinds = s.departed.size();
  const SavedNumbers& v = numbers[0];
  require_possible(v);
  s.time = v.time, s.dt = v.dt, s.full_dt = v.full_dt, s.last_dt = v.last_dt;
  s.displacement = v.displacement, s.taken = v.taken, s.given = v.given;
  s.capillary_work = v.capillary_work, s.list_time = v.list_time;
  s.restore_walls();
  const Offset walls = s.wall.pressure.size(), impulses = s.wall_forces.impulses().size();
  const std::size_t planes = s.planes.records.size();
  visit_arrays(restorer, s);
  if (s.exact_yield()) s.viscous.exact_yield().visit_arrays(restorer);
  const Offset n = s.fluid.id.size();
  const bool fits = s.fluid.position.size() == n && s.fluid.place.size() == n && s.fluid.motion.size() == n &&
                    s.fluid.increment.size() == n && s.fluid.last_increment.size() == n &&
                    s.fluid.by_pressure.size() == n && s.fluid.packing.size() == n &&
                    s.fluid.fluid.size() == n && s.fluid.state.size() == n && s.fluid.pressure.size() == n &&
                    s.fluid.shear_rate.size() == n && s.list_places.size() == n &&
                    s.wall.pressure.size() == walls && s.departed.size() == kinds &&
                    s.planes.records.size() == planes && s.wall_forces.impulses().size() == impulses;
  if (!fits) throw Error("checkpoint: its arrays do not belong to this case");
  s.fluid.count = static_cast<Index>(n);
  require_possible(s.fluid, s.list_places, s.ordering.fluid_sources(s.fluid).grid, kinds);
  s.steps = v.steps, s.builds = v.builds;
  s.solver = {v.solver_steps,     v.solver_iterations, v.max_iterations, v.worst_residual,
              v.yield_iterations, v.yield_unconverged, v.solver_retried};
  s.report = {v.iterations, v.residual, v.velocity_error, v.converged != 0};
  s.watch.lowest_energy = v.lowest_energy, s.watch.given_before = v.given_before;
  s.last.reset();
  s.rebuild_lists_as_saved();
}

}  // namespace slagflow
