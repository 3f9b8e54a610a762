// The separate bodies of a triangle surface, each turned the right way round.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/geometry/stl.hpp"

namespace slagflow {

// A triangle by the numbers of its corners; the same number for the same place.
using Corners = std::array<std::size_t, 3>;

// Turns triangles so that their normals point out of the solid. `corners`: of each triangle, every edge run
// through as often one way as the other. Triangles that hang together by edges are a body. A body inside an
// odd number of others is a cavity, and all others are solid, whichever way they are wound; bodies that cross
// are a union. Throws InputError, `name` standing for the surface, when no body encloses a volume, or when
// two that cross are wound in opposite senses, so that it is open which is solid.
void turn_bodies_outward(std::vector<Triangle>& triangles, const std::vector<Corners>& corners,
                         const std::string& name);

}  // namespace slagflow
