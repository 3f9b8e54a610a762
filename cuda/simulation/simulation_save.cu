// Saves and restores a simulation to the bit.
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "backend/error.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

namespace {

constexpr const char* numbers_name = "numbers";

// One pass over all that is saved serves both ways, so that they cannot differ. Single numbers go into an
// array of their own, in the order in which they are visited.
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
  template <class T>
  void number(T& value) {
    numbers_.push_back(static_cast<double>(value));
  }
  void end() { values(numbers_name, numbers_); }

 private:
  SavedState& state_;
  std::vector<double> numbers_;
};

class Restorer {
 public:
  explicit Restorer(const SavedState& state) : state_(state) { values(numbers_name, numbers_); }

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
  template <class T>
  void number(T& value) {
    require_fit(next_ < numbers_.size());
    const double saved = numbers_[next_++];
    constexpr double exact = 9007199254740992;  // as are whole numbers up to there
    const double largest = smaller(exact, static_cast<double>(std::numeric_limits<T>::max()));
    if (std::is_integral_v<T> && !(std::abs(saved) <= largest)) refuse_numbers();
    value = static_cast<T>(saved);
  }
  void end() const { require_fit(next_ == numbers_.size()); }

  static void require_fit(bool fits) {
    if (!fits) throw Error("checkpoint: its arrays do not belong to this case");
  }
  [[noreturn]] static void refuse_numbers() { throw Error("checkpoint: its numbers are not those of a run"); }

 private:
  const SavedState& state_;
  std::vector<double> numbers_;
  std::size_t next_ = 0;
};

// When and how far: what the walls follow from.
template <class Visitor, class State>
void visit_clock(Visitor& v, State& s) {
  v.number(s.time), v.number(s.dt), v.number(s.full_dt), v.number(s.last_dt), v.number(s.list_time);
  v.number(s.displacement), v.number(s.taken), v.number(s.given), v.number(s.capillary_work);
  v.number(s.steps), v.number(s.builds);
  v.number(s.largest_compression.value), v.number(s.largest_compression.time);
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
  s.fluid.each(Fate::saved, [&](auto& array) { v.array(array.field.name, array); });
  s.wall.each(Fate::saved, [&](auto& array) { v.as_many(array.field.name, array); });
  s.wall_forces.save(v), s.planes.save(v), s.viscous.save(v), s.watch.save(v);
  v.array("list_places", s.list_places), v.as_many("departed", s.departed);
  visit_solves(v, s.solver, s.report);
  v.end();
}

// What indices into other arrays are made of, and what the loop over the steps counts on. Anything else that
// is false in a checkpoint shows as a state that cannot go on.
template <class State>
void require_possible_clock(const State& s) {
  bool possible = s.time >= 0 && s.dt > 0 && s.full_dt > 0 && s.last_dt >= 0 && s.list_time >= 0 &&
                  s.list_time <= s.time && s.steps >= 0 && s.builds >= 0;
  const double finite[] = {s.time,         s.dt,    s.full_dt, s.last_dt,
                           s.displacement, s.taken, s.given,   s.capillary_work};
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

}  // namespace

SavedState Simulation::save() const {
  State& s = *state_;
  SavedState result;
  Saver saver(result);
  visit_clock(saver, s);
  visit_parts(saver, s);
  return result;
}

void Simulation::restore(const SavedState& saved) {
  State& s = *state_;
  Restorer restorer(saved);
  visit_clock(restorer, s);
  require_possible_clock(s);
  s.restore_walls();
  visit_parts(restorer, s);
  if (s.solver.steps < 0) Restorer::refuse_numbers();
  const Offset n = s.fluid.id.size();
  Restorer::require_fit(s.list_places.size() == n);
  s.fluid.each(Fate::saved, [&](const auto& array) { Restorer::require_fit(array.size() == n); });
  s.fluid.resize(static_cast<Index>(n));
  require_possible(s.fluid, s.list_places, s.ordering.fluid_sources(s.fluid).grid, s.departed.size());
  s.last.reset();
  s.rebuild_lists_as_saved();
}

}  // namespace slagflow
