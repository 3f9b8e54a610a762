// From a setup to the constants that the device bodies use.
#pragma once

#include <string>
#include <vector>

#include "fluid/params.hpp"
#include "fluid/setup.hpp"

namespace slagflow {

// Throws InputError on values that no run can have.
void validate(const SimulationSetup&);

// Keys of [numerics] that do not go together: the one at fault, and "value ... with ...: allowed: ...".
struct Conflict {
  std::string key, what;
};
std::vector<Conflict> conflicts(const NumericsSetup&);

// The same of a wall's tension limit; empty: none. Where a wall holds better than the fluid itself, the fluid
// parts beside the wall; and what such a wall pulls in has no store of energy to come from.
std::string tension_conflict(double wall_limit, const NumericsSetup&);

// Whether the stress is a yield stress plus a viscous one.
bool allows_exact_yield(RheologyKind);

FlowConstants flow_constants(const SimulationSetup&);
std::vector<FluidConstants> fluid_constants(const SimulationSetup&);
// Wall particles in a column of an inlet: those that come on with the fluid, two more than the support holds,
// and behind them, between where the last two come and go, those that stay and hold back what is behind.
int inlet_moving_rows(const SimulationSetup&);
int inlet_rows(const SimulationSetup&);
// [strides] behind the face, of a row while nothing has been fed.
double inlet_row_place(int row, int moving_rows);
// Of one particle of fluid `kind` [kg].
double particle_mass(const SimulationSetup&, std::size_t kind);

// What a wall's pairs with fluid bear [Pa]: as given; else the fluid's limit, and none where the fluid's
// tension follows its viscous stress: wetting is the wall's own.
double wall_tension_limit(const WallBody&, const NumericsSetup&);
// That of all walls; -1: they differ.
double common_wall_tension_limit(const SimulationSetup&);

// epsilon of the term that keeps pairs apart: as given, or 0.1 where surface tension, or the negative Fourier
// transform of Lucy's function, draws particles together.
double anti_pairing(const SimulationSetup&);

PeriodicBox periodic_box(const SimulationSetup&);

// C of equation (7): as given, or what takes out the bias of the operator, 1 / lattice_viscosity().
double viscosity_correction(const SimulationSetup&);

// courant sqrt(rho dx^3/(2 pi sigma)), of the shortest capillary wave [s]; infinite without surface tension.
// J. U. Brackbill et al., J. Comput. Phys. 100 (1992) 335.
double capillary_time_step(const SimulationSetup&);

// The sound speed at which fluid that a present one leaves compressed by `compression` stays below `allowed`
// [m/s]: the compression by an impact falls as one over the sound speed, that by weight or speed faster. In
// two digits, with a tenth to spare.
double stiff_enough(double sound_speed, double compression, double allowed);

// Longest step [s] that the diffusion of density bears: its rate, delta h c0 times the sum of V |F|, may be
// up to 2/dt on a lattice. 0.7 of that, as particles that start half a spacing off their sites have locally
// larger sums: they bear 0.76 in 2-D and 0.88 in 3-D.
double diffusion_time_step(const SimulationSetup&);

// dt <= courant (h/2)/c0, diffusion_time_step(), capillary_time_step(), half of end_time, and max_time_step
// when there is one [s].
double stable_time_step(const SimulationSetup&);

}  // namespace slagflow
