// How finely the particles of the start resolve fluid and walls, and how large the files of a case are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/geometry/setup_builder.hpp"

namespace slagflow {

// Fluid that touches, corners included.
struct FluidPiece {
  std::size_t particles = 0;
  Vec3d first;    // [m] of one of them
  double across;  // particles: half of it is in rows as short as that, along the axis of the shortest
};

// The pieces of the start, the largest first.
std::vector<FluidPiece> fluid_pieces(const SimulationSetup& setup, Vec3d origin);

// The wall that is thinnest behind its surface, along the normal; where none ends within a few spacings,
// thick.
struct ThinnestWall {
  static constexpr double thick = 20;  // spacings, as far as is looked for what flows
  std::string name;
  double across = thick;  // spacings
  Vec3d place;            // [m]
};
// Where each wall of the case is thinnest; `name` is empty where it is thick, or thicker than heat goes in
// the run where it takes up any.
std::vector<ThinnestWall> wall_thicknesses(const Case& c, const SimulationSetup& setup);
ThinnestWall thinnest_of(const std::vector<ThinnestWall>& walls);

// "FILE from (..) to (..) m" of each STL file, once.
std::vector<std::string> stl_extents(const Case& c);

}  // namespace slagflow
