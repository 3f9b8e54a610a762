// The command `rheometry`: from a viscometer's readings to the [fluid] table of a case.
#pragma once

#include <string>
#include <vector>

#include "host/rheometry/rheometry_options.hpp"
#include "host/rheometry/rheometry_output.hpp"

namespace slagflow {

struct RheometryResult {
  Measurements measured;
  std::vector<FlowFit> fits;  // best first by AICc
  std::size_t chosen = 0;     // index into fits
  std::vector<std::string> warnings;

  const FlowFit& best() const { return fits[chosen]; }
};

// Throws InputError on a model that does not fit the measurements.
RheometryResult analyse(const Measurements& measured, const RheometryOptions& options);

// For people: the fits with their intervals, and which was chosen.
std::string to_text(const RheometryResult&);

// The [fluid.NAME] table of the chosen fit, ready for a case file when the density is known.
std::string to_fluid_table(const RheometryResult&, const RheometryOptions&);

// Measurements and curves as CSV, for the picture: columns x (shear rate or rotation), measured, one for each
// model. Rows of curves have no measured stress.
std::string to_curves(const RheometryResult&);

// Runs the command, whichever of its kinds the options and the file ask for: results to stdout, warnings to
// stderr. With an output X.toml the curves go to X.csv.
void run_rheometry(const RheometryOptions&);

}  // namespace slagflow
