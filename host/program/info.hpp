// What a .vtkhdf file or a checkpoint of a run holds, and where it came from.
#pragma once

#include <string>

namespace slagflow {

// For people: provenance, time steps, particles, and each array with its unit and range over all steps; of a
// checkpoint where the run stood.
// Throws InputError naming the file: it is missing, damaged, or neither of the two.
std::string describe_file(const std::string& path);

}  // namespace slagflow
