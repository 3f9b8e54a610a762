// How fast this machine computes: a short simulation, timed once and kept.
#pragma once

#include <string>

namespace slagflow {

struct MachineSpeed {
  double particle_steps = 0;  // fluid particles times steps [1/s]
  std::string made;           // UTC, ISO 8601; empty: not of this machine
  bool now = false;           // timed by this call
};

// Of this build on this machine with as many threads as it would take, in two or three dimensions. It is read
// from the user's cache folder, $XDG_CACHE_HOME/slagflow or ~/.cache/slagflow; where it is not there, or with
// `anew`, it takes about a second to find, and is kept there if that can be. Where the device does not answer
// nothing is known: 0.
MachineSpeed machine_speed(int dimensions, bool anew = false);

// Times it.
double timed_speed(int dimensions);

// A model figure for an H100, not measured: as scripts/bench --model predicts it from counts of instructions
// and bytes. [s] a step.
double modelled_gpu_step(double particles);

}  // namespace slagflow
