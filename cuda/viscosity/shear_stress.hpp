// The viscous stress that each particle bears.
#pragma once

#include "neighbours/pairs.hpp"

namespace slagflow {

// |tau_i| [Pa], the length sqrt(tau:tau / 2) of the deviator of the pair forces' virial
//   sigma_i = 1/2 sum_j f_ij x_ij / V_i
// (J. H. Irving, J. G. Kirkwood, J. Chem. Phys. 18 (1950) 817), f_ij the viscous force of equation (7) at the
// velocities and viscosities that the particles have now, of walls with factor (14). A stress that varies
// linearly is told exactly, unlike one by eta gamma, which sees the shear within the support radius alone.
// `way`: how long the particles have come with their velocities [s]: as in the step, directions of pairs of
// fluid are those in the middle of it.
// Writes one number a particle.
void measure_shear_stress(Context&, const PairContext&, Real way, Span<Real> result);

}  // namespace slagflow
