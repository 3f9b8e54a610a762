// The share of wall particles in the surfaces of walls.
#pragma once

#include <vector>

#include "fluid/setup.hpp"
#include "host/case/case.hpp"

namespace slagflow {

// Of each wall particle of some bodies [m^2], [m] with two dimensions; 0 of others. What lies in the domain
// and on no other wall counts. A body whose faces all lie along the lattice has the open faces of its cells.
// Of others the surface is spread over a spacing on either side and summed over pieces of cells (a smoothed
// delta function of the distance: B. Engquist et al., J. Comput. Phys. 207 (2005) 28), each to the nearest
// particle: edges lose 0.07 of a spacing of width.
std::vector<double> site_areas(const Case&, const SimulationSetup&, const std::vector<std::size_t>& bodies);

}  // namespace slagflow
