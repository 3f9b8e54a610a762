// What becomes of the shapes of regions: where they have no particle, and what walls and the domain cut of
// them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/geometry/geometry.hpp"

namespace slagflow {

// What files of CAD programs are drawn in.
struct DrawingUnit {
  double scale;  // [m]
  const char* name;
};
constexpr std::array<DrawingUnit, 4> drawing_units{
    {{1e-3, "mm"}, {0.0254, "inches"}, {1e-2, "cm"}, {1, "m"}}};

// "from (0, 0, 0) to (1, 1, 1) m"
std::string range_of(const Vec3d& lower, const Vec3d& upper);

// Lattice sites of the domain in the shapes of a region.
struct RegionSites {
  std::size_t all = 0, in_walls = 0, in_earlier_regions = 0, without_room = 0;
  std::vector<std::size_t> in_wall;  // each, of in_walls

  void add(const RegionSites& part) {
    all += part.all, in_walls += part.in_walls, in_earlier_regions += part.in_earlier_regions;
    without_room += part.without_room;
    for (std::size_t b = 0; b < in_wall.size(); ++b) in_wall[b] += part.in_wall[b];
  }
};

// Why a region without a particle has none, and what is allowed.
std::string reason_without_particle(const Case& c, const RegionSpec& region, const Solid& solid,
                                    const RegionSites& sites);

// Warnings of what walls and the domain cut of a region, of this index, that has particles.
std::vector<std::string> cut_warnings(const Case& c, std::size_t index, const Solid& solid,
                                      const RegionSites& sites);

// Of STL files among the shapes that do not fit the domain, but would in another unit; with "; " before, or
// empty.
std::string unit_hint(const Case& c, const std::vector<ShapeSpec>& shapes);

// Of a wall that has particles, from a file that is far too large or small for the domain; or empty.
std::string unit_warning(const Case& c, const WallSpec& wall, const Solid& solid);

}  // namespace slagflow
