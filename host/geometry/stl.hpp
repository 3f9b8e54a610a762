// Triangle surfaces from STL files, binary or ASCII.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fluid/math.hpp"

namespace slagflow {

using Triangle = std::array<Vec3d, 3>;

// The triangles of a file, as they stand there. Throws InputError naming the file when it cannot be read,
// is truncated, holds no triangle, or a coordinate that is not a number or beyond 1e30.
std::vector<Triangle> read_stl(const std::string& file);

// Checks that the triangles enclose a volume, and turns them so that their normals point out of it, body by
// body (stl_bodies.hpp). Those without area are dropped. Throws InputError with the number of open edges;
// `name` stands for the surface.
std::vector<Triangle> closed_surface(const std::vector<Triangle>& triangles, const std::string& name);

}  // namespace slagflow
