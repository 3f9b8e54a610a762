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
  double compression, compression_time;
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
  template <class T>
  void as_many(const char* name, Buffer<T>& buffer) {
    array(name, buffer);
  }
  template <class T>
  void as_many(const char* name, std::vector<T>& host) {
    values(name, host);
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
  // What the case decides the number of.
  template <class T>
  void as_many(const char* name, Buffer<T>& buffer) {
    const Offset size = buffer.size();
    array(name, buffer);
    require_fit(buffer.size() == size);
  }
  template <class T>
  void as_many(const char* name, std::vector<T>& host) {
    const std::size_t size = host.size();
    values(name, host);
    require_fit(host.size() == size);
  }
  static void require_fit(bool fits) {
    if (!fits) throw Error("checkpoint: its arrays do not belong to this case");
  }

 private:
  const SavedState& state_;
};

// Each part says itself what of it goes into a checkpoint.
template <class Visitor, class State>
void visit_arrays(Visitor& v, State& s) {
  s.fluid.each(Fate::saved, [&](auto& array) { v.array(array.field.name, array); });
  s.wall.each(Fate::saved, [&](auto& array) { v.as_many(array.field.name, array); });
  s.wall_forces.save(v), s.planes.save(v), s.viscous.save(v);
  v.array("list_places", s.list_places), v.as_many("departed", s.departed);
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
                                     s.largest_compression.value,
                                     s.largest_compression.time,
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
  const SavedNumbers& v = numbers[0];
  require_possible(v);
  s.time = v.time, s.dt = v.dt, s.full_dt = v.full_dt, s.last_dt = v.last_dt;
  s.displacement = v.displacement, s.taken = v.taken, s.given = v.given;
  s.capillary_work = v.capillary_work, s.list_time = v.list_time;
  s.restore_walls();
  visit_arrays(restorer, s);
  const Offset n = s.fluid.id.size();
  Restorer::require_fit(s.list_places.size() == n);
  s.fluid.each(Fate::saved, [&](const auto& array) { Restorer::require_fit(array.size() == n); });
  s.fluid.resize(static_cast<Index>(n));
  require_possible(s.fluid, s.list_places, s.ordering.fluid_sources(s.fluid).grid, s.departed.size());
  s.steps = v.steps, s.builds = v.builds;
  s.solver = {v.solver_steps,     v.solver_iterations, v.max_iterations, v.worst_residual,
              v.yield_iterations, v.yield_unconverged, v.solver_retried};
  s.report = {v.iterations, v.residual, v.velocity_error, v.converged != 0};
  s.watch.lowest_energy = v.lowest_energy, s.watch.given_before = v.given_before;
  s.largest_compression = {v.compression, v.compression_time};
  s.last.reset();
  s.rebuild_lists_as_saved();
}

}  // namespace slagflow
