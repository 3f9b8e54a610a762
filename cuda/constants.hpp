// From a setup to the constants that the device bodies use.
#pragma once

#include <vector>

#include "params.hpp"
#include "setup.hpp"

namespace slagflow {

// Throws InputError on values that no run can have.
void validate(const SimulationSetup&);

// Whether the stress is a yield stress plus a viscous one.
bool allows_exact_yield(RheologyKind);

FlowConstants flow_constants(const SimulationSetup&);
std::vector<FluidConstants> fluid_constants(const SimulationSetup&);
// Of one particle of fluid `kind` [kg].
double particle_mass(const SimulationSetup&, std::size_t kind);

PeriodicBox periodic_box(const SimulationSetup&);

// C of equation (7): as given, or what takes out the bias of the operator, 1 / lattice_viscosity().
double viscosity_correction(const SimulationSetup&);

// courant sqrt(rho dx^3/(2 pi sigma)), of the shortest capillary wave [s]; infinite without surface tension.
// J. U. Brackbill et al., J. Comput. Phys. 100 (1992) 335.
double capillary_time_step(const SimulationSetup&);

// dt <= courant (h/2)/c0, capillary_time_step(), and max_time_step when there is one [s].
double stable_time_step(const SimulationSetup&);

}  // namespace slagflow
