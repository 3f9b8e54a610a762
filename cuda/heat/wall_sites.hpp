// Sites of walls that heat passes.
#pragma once

#include "fluid/setup.hpp"

namespace slagflow {

// A site is a wall particle of the first layer; deeper ones belong to the site nearest to their foot. As in
// SiteView. Areas are those of the setup or, without any, those of a lattice.
struct WallSites {
  std::vector<Index> of_wall, first{0}, member;
  std::vector<std::uint8_t> body;
  std::vector<double> area;  // [m^2]
};
WallSites wall_sites(const SimulationSetup&);

}  // namespace slagflow
