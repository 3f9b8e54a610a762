// What a region gives its particles at the start: velocities and disorder.
#pragma once

#include "host/case/case.hpp"

namespace slagflow {

// Velocity at p [m/s]: uniform, rigid rotation and plane waves of a region, added up.
Vec3d initial_velocity(const RegionSpec& region, Vec3d p);

// Where the particle of a lattice site starts relative to it, in parts of the region's jitter: each component
// is uniform between -1 and 1 and depends on the particle's number in the case alone, so that a case starts
// the same on every machine.
Vec3d jitter_of(std::uint64_t number);

}  // namespace slagflow
