// The state of a run from which another one starts: `slagflow run --from`.
#pragma once

#include <string>
#include <vector>

#include "host/case/case_changes.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/checkpoint.hpp"

namespace slagflow {

constexpr const char* start_name = "start.h5";  // what such a run begins with, in its folder

// What a run starts from. The texts of the checkpoint are those of the earlier run, and from_folder,
// from_file, from_time and, of a checkpoint, from_step; its state holds fluid_arrays().
struct StartState {
  Checkpoint checkpoint;
  Case before;                        // the case of the earlier run
  std::vector<std::string> warnings;  // what the state lacks

  // "checkpoint.h5 of DIR at 0.02 s, step 134"
  std::string text() const;
};

// `from`: DIR, whose newest sound checkpoint is taken, or DIR@TIME: the checkpoint or snapshot nearest to
// that time [s]. Throws InputError: no such folder, nothing in it, nothing near that time (with what there
// is), a checkpoint of another precision.
StartState find_state(const std::string& from);

// Reads start.h5 in the folder of a run. Throws InputError when it is missing or damaged.
StartState read_start(const std::string& folder);

// Puts the fluid of the state in the place of that of the regions. A particle keeps its place, velocity and
// volume; its mass and pressure go with the density of its fluid at rest; with another sound speed the
// pressure stays. Throws InputError when a fluid of the state is none of the case.
void start_from(const StartState&, BuiltCase&);

// Throws InputError with all that is wrong: keys that cannot change, particles outside of the domain or in
// walls, an end that the state has passed. After start_from().
void require_startable(const StartState&, const BuiltCase&, const std::vector<KeyChange>&);

}  // namespace slagflow
