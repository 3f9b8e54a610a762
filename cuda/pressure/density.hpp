// First sweep over the pairs: continuity with density diffusion, pressure, shear rate and viscosity.
#pragma once

#include "neighbours/pairs.hpp"

namespace slagflow {

// Advances the density over the last step, which took `moved` seconds, with
//   d rho_i/dt = rho_i sum_j V_j (v_i - v_j).grad W_ij
//              + 2 delta (h/2) c0 sum_j V_j (-F_ij) [(rho_j - rho0_j) - (rho_i - rho0_i) + f_ij.(x_j -
//              x_i)/c0^2] / (1 + eta_ij/(rho0 c0 h)),
// eta_ij the mean viscosity: thick fluid, whose viscosity damps noise, needs none of it, and where it hardly
// flows the least bias pumps (a Bingham fluid at rest lost 1 % of its pressure in a second).
// f_ij the mean force per volume of the pair by pressure in the last step, so that f/c0^2 is minus the
// smooth gradient of the density (over what the sum for it makes of a gradient on a lattice, 1.006 in two
// dimensions and 0.988 in three: fluid that a yield stress holds would else be pumped): what diffuses is
// noise between neighbours, not the gradient that holds gravity, viscosity, a yield stress or surface
// tension. Wall pairs have rho0_i (a_w - g) for f_ij: theirs is the pressure that gravity continues
// (wall_pressure.hpp). With -rho0 g for all pairs it is the diffusion of G. Fourtakas et al., Comput. Fluids
// 190 (2019) 346, which blows up thin fluid that viscous stress holds. Nothing diffuses between fluids: what
// one loses of its energy by that the other does not gain, and sound waves would grow. The sums are taken
// half-way along the last step, x_ij less half of what it has changed: at the end of the step a rigid
// rotation by an angle a would seem to expand by a^2/2. Sets the pressure by the equation of state
//   p = max(c0^2 (rho - rho0), -p_t)
// and the viscosity from the shear rate
//   gamma_i^2 = C (d+2) sum_j (eta_ij/eta_i)^2 V_j |F_ij| ((v_i - v_j).x_ij)^2 / r^2,
// which is the dissipation of the viscous operator itself: sqrt(2 D:D) of a linear incompressible flow, zero
// for a rigid motion. Within a fluid the first factor is 1; of a pair of two fluids it is the share of
// the velocity difference that lies in the fluid of i, where one stress goes through both. Writes motion.w,
// place.w, state, pressure, shear_rate; `scratch` holds one number per particle. Units in particles.hpp.
void update_density(Context&, const PairContext&, FluidArrays&, Buffer<Real>& scratch, Real moved);

}  // namespace slagflow
