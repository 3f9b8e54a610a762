// Whether the ranks can share a case.
#pragma once

#include "fluid/setup.hpp"

namespace slagflow {

// Throws InputError where the domain is too short for so many ranks.
void require_shareable(const SimulationSetup&);

}  // namespace slagflow
