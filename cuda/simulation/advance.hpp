// Last part of a step: velocities and positions.
#pragma once

#include "backend/buffer.hpp"
#include "fluid/diagnostic_scratch.hpp"
#include "fluid/params.hpp"
#include "fluid/particles.hpp"
#include "fluid/step_record.hpp"

namespace slagflow {

struct Move {
  Span<const Quad> velocity;   // as solved [m/s]
  double dt;                   // [s]
  Span<const Quad> reference;  // places at which the neighbour list was built [m]
  Span<const FluidConstants> fluids;
};

// v = the solved velocity, x += dt v (positions in fp64). Leaves in the record the square of the largest
// distance from the reference, not-a-number when a velocity is, the largest compression and speed. Idle
// unless the record says that the solve has converged.
void advance_particles(Context&, FluidArrays&, const Move&, StepRecord*);

// Largest speed [m/s].
double largest_speed(Context&, const FluidArrays&, DiagnosticScratch&);

// Largest dynamic viscosity over density of any particle [m^2/s].
double largest_diffusivity(Context&, const FluidArrays&, DiagnosticScratch&);

}  // namespace slagflow
