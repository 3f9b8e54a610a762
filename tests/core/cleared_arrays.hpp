// Particle arrays of a given length that hold zeros: sorting moves every field, also those that a test does
// not use.
#pragma once

#include <type_traits>
#include <vector>

#include "fluid/particles.hpp"

namespace slagflow {

inline void clear(ParticleArrays& arrays, std::size_t count) {
  arrays.resize(static_cast<Index>(count));
  arrays.each([&](auto& array) {
    using T = typename std::decay_t<decltype(array)>::Element;
    if (!has(array.field.fate, Fate::optional)) array.upload(std::vector<T>(count));
  });
}

}  // namespace slagflow
