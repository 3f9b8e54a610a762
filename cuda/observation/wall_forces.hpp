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

  // Since the start; torques about the lower corner of the domain.
  void load(std::size_t body, GatheredSums&, WallLoad&) const;
  void work(GatheredSums&, WallWork&) const;  // of all walls

  // Of each wall particle, in the order of ids.
  struct Impulse {
    Vec3d pressure, viscous;                    // [N s]
    Vec3d pressure_torque, viscous_torque;      // [N m s] about the lower corner of the domain
    double work = 0;                            // [J]
    double viscous_work = 0, elastic_work = 0;  // [J] of it, see WallWork
  };
  template <class Visitor>
  void save(Visitor& v) {
    v.as_many("wall_impulse", impulse_);
  }

 private:
  Context& context_;
  Buffer<Impulse> impulse_;
  Buffer<std::uint8_t> body_;
};

}  // namespace slagflow
