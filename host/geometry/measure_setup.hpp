// What a simulation is to measure, of the measures of a case.
#pragma once

#include "fluid/setup.hpp"
#include "host/case/case.hpp"

namespace slagflow {

// By kind, in the order of the case; after walls and outlets.
void add_measures(const Case&, SimulationSetup&);

// The share of each wall particle in the surfaces of some bodies [m^2], [m] with two dimensions; 0 of others.
// A particle has the faces of its cell that no other wall particle is behind, each as large as it looks along
// the particle's normal: so planes at any angle to the lattice have their area, and bodies along it theirs.
// Edges of others lose up to a spacing of their width. Only what is in the domain counts.
std::vector<double> site_areas(const Case&, const SimulationSetup&, const std::vector<std::size_t>& bodies);

}  // namespace slagflow
