// From a case to the particles and parameters that a simulation starts from.
#pragma once

#include <string>
#include <vector>

#include "fluid/setup.hpp"
#include "host/case/case.hpp"
#include "host/geometry/geometry.hpp"
#include "host/geometry/sound_speed.hpp"

namespace slagflow {

struct BuiltCase {
  SimulationSetup setup;              // fronts: one for each measure, in the order of Case::measures
  Case resolved;                      // the case with automatic speeds replaced by their values
  std::vector<std::string> warnings;  // one line each, for stderr
  std::vector<SoundSpeedTerm> sound_speed_terms;
};

// Places the particles of a validated case.
// Throws InputError: a region without a particle, more particles than fit into memory, a bad STL file,
// a sound speed that cannot be chosen automatically.
// `stage` is told what is being done.
BuiltCase build_setup(const Case& c, const Stage& stage = {});

}  // namespace slagflow
