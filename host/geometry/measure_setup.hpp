// What a simulation is to measure, of the measures of a case.
#pragma once

#include "fluid/setup.hpp"
#include "host/case/case.hpp"

namespace slagflow {

// By kind, in the order of the case; after walls and outlets.
void add_measures(const Case&, SimulationSetup&);

}  // namespace slagflow
