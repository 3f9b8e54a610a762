// Loops within graphs run on a GPU only, and nowhere yet: tests of them are asked for.
#pragma once

#include <cstdlib>

#include "backend/device.hpp"

namespace slagflow::testing_tools {

inline bool on_gpu() { return device_info().backend == "cuda"; }

// SLAGFLOW_GRAPH_LOOPS=1 in the environment asks for them; a CPU build has loops of its own.
inline bool records_loops() {
  return !on_gpu() || (std::getenv("SLAGFLOW_GRAPH_LOOPS") && missing_for_loops().empty());
}

}  // namespace slagflow::testing_tools
