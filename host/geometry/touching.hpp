// Which fluid hangs together at the start.
#pragma once

#include <cstdint>
#include <vector>

#include "host/geometry/sets.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {

// Fluid whose sites touch, corners included, round periodic axes too.
FluidBodies touching_bodies(const StartSites& sites);

// Bodies from the sets that particles are in: set(i) < sets of particle i.
template <class SetOf>
FluidBodies numbered_bodies(std::size_t particles, std::size_t sets, const SetOf& set) {
  FluidBodies bodies;
  bodies.of.resize(particles);
  std::vector<std::int32_t> number(sets, StartSites::none);
  for (std::size_t i = 0; i < particles; ++i) {
    std::int32_t& own = number[set(i)];
    if (own == StartSites::none) own = bodies.count++;
    bodies.of[i] = own;
  }
  return bodies;
}

}  // namespace slagflow
