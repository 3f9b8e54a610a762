// Warnings of values that do not go together.
#pragma once

#include <vector>

#include "host/geometry/setup_builder.hpp"

namespace slagflow {

// Of a case that is built, but for these warnings; wall_speeds: of each wall by its motion [m/s].
void warn_of_setup(BuiltCase& built, const std::vector<double>& wall_speeds);

}  // namespace slagflow
