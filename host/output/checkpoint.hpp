// The content of a checkpoint: the simulation's state, what the run loop remembers, and where both come from.
//
// File: HDF5, the texts of the provenance as attributes of the root, one data set of bytes for each array in
// the groups `simulation` and `run` (a row is an element), each with its checksum as an attribute. Behind
// what HDF5 knows of lie 16 bytes, the seal: a mark and the checksum of all bytes before it. It finds any
// damage before HDF5 interprets a byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fluid/saved_state.hpp"

namespace slagflow {

// What the run loop remembers.
struct RunRecord {
  double time = 0;                             // [s] simulated
  double next_snapshot = 0, next_history = 0;  // [s] when the outputs are due
  double wall_time = 0, setup_time = 0;        // [s], over all parts of the run
  double deepest_in_wall = 0;                  // [spacings], of any particle at any look
  std::int64_t steps = 0;                      // of the simulation
  std::int64_t recorded_step = -1;             // of the last line of the history
  std::int64_t snapshot_step = -1;             // of the last snapshot
  std::int64_t particles_now = 0;              // at the last line of the history
  std::int64_t particle_steps = 0;             // see RunCounts
  double time_of_most_in_sheets = 0;           // [s]
  std::int64_t most_in_sheets = 0;             // see ThinSheets
  std::int64_t most_in_walls = 0;              // see InWalls
  std::int64_t history_lines = 0;              // without the header
  std::int64_t history_bytes = 0;              // of the file up to the end of the last line
  std::int64_t snapshots = 0;                  // time steps in particles.vtkhdf and in walls.vtkhdf
  std::int64_t resumes = 0;                    // how often the run has been resumed
  std::int64_t geometry = 0;                   // checksum of the particles that the case starts from
  std::vector<double> measures;                // Measures::state()
  std::vector<std::int64_t> profiles;          // ProfileFiles::finish()
};

struct Checkpoint {
  std::vector<std::pair<std::string, std::string>> texts;  // Provenance::attributes()
  RunRecord run;
  SavedState state;

  // Throws Error when there is no such text.
  const std::string& text(const std::string& name) const;
};

// A 64-bit checksum after FNV-1a, over words of 8 bytes; the last word is filled up with zeros. `so_far`
// continues the checksum of what lies before, whose length must be a multiple of 8.
constexpr std::uint64_t checksum_start = 14695981039346656037ull;
std::uint64_t checksum(const void* data, std::size_t bytes, std::uint64_t so_far = checksum_start);

// The bytes of the file, seal included; `path` is for errors.
std::vector<std::byte> checkpoint_bytes(Checkpoint checkpoint, const std::string& path);

// Throws Error that names the file and what is wrong: missing, damaged, truncated, of another kind.
Checkpoint read_checkpoint(const std::string& path);

}  // namespace slagflow
