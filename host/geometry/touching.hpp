// Which fluid hangs together at the start.
#pragma once

#include <cstdint>
#include <vector>

#include "host/geometry/start_sites.hpp"

namespace slagflow {

// Fluid whose sites touch, corners included, round periodic axes too.
FluidBodies touching_bodies(const StartSites& sites);

// Sets that grow together.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    for (std::size_t k = 0; k < count; ++k) parent_[k] = k;
  }
  std::size_t root(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

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
