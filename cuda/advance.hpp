// Last part of a step: velocities and positions.
#pragma once

#include "backend/buffer.hpp"
#include "particles.hpp"

namespace slagflow {

struct SolvedVelocity {
  Span<const Quad> velocity;  // [m/s]
  double dt;                  // [s]
};

// v = the solved velocity, x += dt v (positions in fp64). Returns the largest distance [m] from `reference`,
// the places at which the neighbour list was built; not-a-number when a velocity is.
double advance_particles(Context&, FluidArrays&, SolvedVelocity solved, const Buffer<Quad>& reference,
                         Buffer<Real>& scratch);

// Largest speed [m/s].
double largest_speed(Context&, const FluidArrays&, Buffer<Real>& scratch);

// Largest dynamic viscosity over density of any particle [m^2/s]; `scratch` holds one number per particle.
double largest_diffusivity(Context&, const FluidArrays&, Buffer<Real>& scratch);

}  // namespace slagflow
