// Reads the particles of a snapshot back.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "simulation/simulation.hpp"

namespace slagflow {

// Of a particles.vtkhdf: when its snapshots were taken [s], and where they come from.
struct SnapshotList {
  std::vector<double> times;
  std::vector<std::pair<std::string, std::string>> texts;  // Provenance::attributes()
};

// Throws Error naming the file.
SnapshotList list_snapshots(const std::string& path);

// Places, velocities, densities, fluids and ids of the particles. Throws Error naming the file.
FluidSnapshot read_snapshot(const std::string& path, std::size_t number);

}  // namespace slagflow
