// What the fluid does to the walls: the reaction of the pair sums of predictor and viscous solve, so that the
// momentum of fluid and walls together is kept.
#pragma once

#include "capillarity/surface_tension.hpp"
#include "fluid/diagnostic_scratch.hpp"
#include "fluid/solve_state.hpp"
#include "observation/totals.hpp"
#include "viscosity/exact_yield.hpp"

namespace slagflow {

// A step as the walls feel it: the solved velocity, and the one that the explicit part of (7) acted on.
struct WallForceStep {
  double dt, theta;
  Span<const Quad> velocity, explicit_velocity;
  WallYield yield;
  CapillaryView capillary{};
  const SolveState* solve = nullptr;  // if given: nothing is added unless it has converged
};

// What walls did on the fluid since the start [J]: by viscosity, and by the fluid's own part of the pressure
// of their pairs, which its elastic energy balances.
struct WallWork {
  double viscous = 0, elastic = 0;
};

class WallForces {
 public:
  explicit WallForces(Context&);

  // Starts at zero; `body`: index of the body of each wall particle, in the order of ids.
  void start(const std::vector<std::uint8_t>& body);

  // Adds the impulses of a step. `list`: for each wall particle, the fluid particles in reach. Call before
  // the particles move.
  void add(const PairContext&, const ListView& list, const WallArrays&, const WallForceStep&);

  // With several ranks the impulse of a wall particle is with the one that has it, in the rows `now`; those
  // that went, of the ids `before`, go along. A call of all ranks.
  void follow(const std::vector<Index>& before, const std::vector<Index>& now);
  // The same once a state is restored, of which each rank has all.
  void keep(const std::vector<Index>& now);

  // Since the start; torques about the lower corner of the domain.
  void load(std::size_t body, GatheredSums&, WallLoad&);
  void work(GatheredSums&, WallWork&);  // of all walls

  // Of each wall particle, in the order of ids.
  struct Impulse {
    Vec3d pressure, viscous;                    // [N s]
    Vec3d pressure_torque, viscous_torque;      // [N m s] about the lower corner of the domain
    double work = 0;                            // [J]
    double viscous_work = 0, elastic_work = 0;  // [J] of it, see WallWork
  };
  template <class Visitor>
  void save(Visitor& v) {
    v.of_one_rank_each("wall_impulse", impulse_);
  }

 private:
  Span<const Impulse> of_all();

  Context& context_;
  Buffer<Impulse> impulse_;
  Buffer<Impulse> all_;  // of all ranks
  Buffer<std::uint8_t> body_;
};

}  // namespace slagflow
