// Fills a vessel up to a level, as a pour would.
#pragma once

#include <vector>

#include "host/geometry/geometry.hpp"

namespace slagflow {

struct FloodSpace {
  const Case& c;
  const Lattice& lattice;
  const std::vector<std::uint8_t>& body;  // per site: 0 where no wall is
  std::size_t region;                     // which is to be filled
};

// The sites below the level that hang together with the place it is filled from, along the axes and without a
// wall between. Throws InputError that names the place where it would run out of the domain, or what is wrong
// with the place or the level.
std::vector<bool> flood(const FloodSpace&);

}  // namespace slagflow
