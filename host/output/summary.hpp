// The summary of a run, for summary.json.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/case/case.hpp"
#include "host/output/provenance.hpp"
#include "host/output/summary_json.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

struct RunCounts {
  std::int64_t particles_start = 0;  // fluid
  std::int64_t walls = 0;
  std::int64_t particle_steps = 0;  // fluid particles, summed over the steps
  double wall_time = 0;             // [s] of the steps and their output
  double setup_time = 0;            // [s] before the first step
};

// What is known before the first step.
Json summary_of_case(const Case& resolved, const Provenance& provenance, const RunCounts& counts);

// "largest compression 1.2 % at 0.31 s".
std::string compression_line(const PeakCompression& largest);

// Adds what the simulation, its totals of now and its run led to.
void add_results(Json& summary, const Simulation& simulation, const Totals& totals, const RunCounts& counts);

}  // namespace slagflow
