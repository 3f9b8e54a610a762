// Warnings of slips: of units, of times, and of measures that see nothing.
#pragma once

#include <string>
#include <vector>

#include "fluid/setup.hpp"
#include "host/case/case.hpp"

namespace slagflow {

void warn_of_slips(const Case& c, const SimulationSetup& setup, std::vector<std::string>& warnings);

}  // namespace slagflow
