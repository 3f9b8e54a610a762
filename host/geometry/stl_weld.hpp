// Triangles whose corners are known to be shared.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/stl_bodies.hpp"

namespace slagflow {

struct WeldedSurface {
  std::vector<Triangle> triangles;
  std::vector<Corners> corners;
  double tolerance = 0;  // corners closer than this count as one
};

// Gives corners at about the same place the same number, and drops triangles without area. Throws InputError,
// `name` standing for the surface, when none is left.
WeldedSurface weld(const std::vector<Triangle>& triangles, const std::string& name);

// For messages, rounded.
std::string corner_text(Vec3d corner);
std::string length_text(double length);

}  // namespace slagflow
