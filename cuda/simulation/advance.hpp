// Last part of a step: velocities and positions.
#pragma once

#include "backend/buffer.hpp"
#include "fluid/diagnostic_scratch.hpp"
#include "fluid/particles.hpp"
#include "fluid/step_record.hpp"

namespace slagflow {

struct SolvedVelocity {
  Span<const Quad> velocity;  // [m/s]
  double dt;                  // [s]
};

// v = the solved velocity, x += dt v (positions in fp64). Leaves the square of the largest distance [m] from
// `reference`, the places at which the neighbour list was built, in the record; not-a-number when a velocity
// is. Idle unless the record says that the solve has converged.
void advance_particles(Context&, FluidArrays&, SolvedVelocity solved, const Buffer<Quad>& reference,
                       StepRecord*);

// Largest speed [m/s].
double largest_speed(Context&, const FluidArrays&, DiagnosticScratch&);

// Largest dynamic viscosity over density of any particle [m^2/s].
double largest_diffusivity(Context&, const FluidArrays&, DiagnosticScratch&);

}  // namespace slagflow
