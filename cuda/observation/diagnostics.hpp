// Sums over the fluid that a history line needs.
#pragma once

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/setup.hpp"
#include "neighbours/pairs.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// Mass, energies, momenta, densities and fronts of the particles in the domain. Positions on the device are
// relative to setup.domain.lower. Counts, the other masses and dissipation are the caller's.
void gather_totals(GatheredSums&, const FluidArrays&, Span<const FluidConstants>, const SimulationSetup&,
                   Totals&);

// What the watch looks at.
struct Vitals {
  double max_speed = 0;        // [m/s]
  double max_compression = 0;  // (rho - rho0)/rho0
  double kinetic_energy = 0;   // [J]
  double stored_energy = 0;    // [J] potential, from the lowest point of the domain, and elastic
  double elastic_energy = 0;   // [J]
  double pressure_energy = 0;  // [J] sum of |p| m/rho0
};
void gather_vitals(GatheredSums&, const FluidArrays&, Span<const FluidConstants>, const SimulationSetup&,
                   Vitals&);

// Kinetic and stored energy, as of Vitals, of the particles from one on [J].
double energy_from(Context&, Index first, const FluidArrays&, Span<const FluidConstants>,
                   const SimulationSetup&, DiagnosticScratch&);

// Mean number of fluid and wall particles within the support radius of a fluid particle, itself not counted.
double mean_neighbours(Context&, const PairContext&, DiagnosticScratch&);

}  // namespace slagflow
