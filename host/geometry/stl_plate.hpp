// Plates out of triangle surfaces that enclose no volume, as CAD programs export shells.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/stl.hpp"

namespace slagflow {

// Gives a surface a thickness [m > 0] on one side of it, or half of it on both: "back" is where the normals
// do not look. Each face keeps its distance from its copy, also where faces meet at an angle; the rim is
// closed. Triangles that do not agree with the first of their part which side is the front are turned.
// Returns a closed surface. Throws InputError, `name` standing for the surface, at an edge of more than two
// triangles, at a corner on an edge of others, and where parts cannot be turned to agree.
std::vector<Triangle> plate(const std::vector<Triangle>& surface, double thickness, PlateSide side,
                            const std::string& name);

}  // namespace slagflow
