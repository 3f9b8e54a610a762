// What several ranks told each other in a run.
#pragma once

#include <string>

#include "host/output/summary_json.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

// For summary.json: messages, bytes and reductions of all ranks, a step, the time that each waited for
// others, and how uneven the particles are dealt out. A call of all ranks.
Json rank_report(const Simulation&);

}  // namespace slagflow
