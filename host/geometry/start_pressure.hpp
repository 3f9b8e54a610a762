// The pressure that fluid starts with.
#pragma once

#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {

// [Pa] of each particle. Hydrostatic regions bear the weight of all fluid above them, of whatever region and
// fluid, up to the first gap: half a spacing above its highest site the pressure is zero. Where a wall lies
// on the fluid it has the pressure of the fluid that it is connected with at its level, the nearest if there
// are several. Fluid that hangs together and rests on no wall falls, under no pressure. Along a periodic axis
// nothing is up or down. region: index of each particle's region.
std::vector<double> start_pressure(const Case& c, const StartSites& sites, const FluidBodies& bodies,
                                   const FluidParticles& fluid, const std::vector<std::uint32_t>& region);

}  // namespace slagflow
