// What a .vtkhdf file of a run holds, and where it came from.
#pragma once

#include <string>

namespace slagflow {

// For people: provenance, time steps, particles, and each array with its unit and range over all steps.
// Throws InputError naming the file: it is missing, no HDF5 file, or holds no points with time steps.
std::string describe_file(const std::string& path);

}  // namespace slagflow
