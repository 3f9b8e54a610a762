// The free surface in columns of points.
#pragma once

#include "observation/measures.hpp"

namespace slagflow {

// In each column as level_of() tells it of a profile along it.
std::vector<LevelState> measure_surface(Context&, const ProfileSource&, const SurfaceSetup&, Vec3d origin);

}  // namespace slagflow
