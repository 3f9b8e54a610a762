// Particle shifting: keeps sheared particles evenly spread, so that they resist as their lattice did.
#pragma once

#include "fluid/solve_state.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

struct ShiftStep {
  Real amount, dt;                    // A of shift_particles, [s]
  Span<const Real> shear_rate;        // [1/s]
  const SolveState* solve = nullptr;  // nothing moves unless it has converged; without it all do
};

// Moves each particle down the gradient of the concentration of particles, walls included,
//   dx_i = -h^2 min(A gamma_i dt, 0.024) D_i S_i sum_j V_j F18_ij x_ij,  D = 1/(1 + rho gamma h^2/(20 eta))
// (S. J. Lind et al., J. Comput. Phys. 231 (2012) 1499, with the shear rate for the pace: nothing moves in a
// plug, or in a rigid motion), F18 that of a function so steep that only the nearest neighbours count
// (Smoothing::crowding_gradient). S_i is 0 at and next to a free surface, where T_i = sum_j V_j |F_ij| r^2 /
// d falls below 0.92, and 1 from T_i = 0.97 on, inside T_i is 0.99; 0 within the support of another fluid;
// and in the row next to a wall, a spacing from its particles, 1 from two spacings on. Velocities stay as
// they are. `position` [m]: the places of the pairs still lag it.
void shift_particles(Context&, const PairContext&, const ShiftStep&, Span<Vec3d> position);

}  // namespace slagflow
