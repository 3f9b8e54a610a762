// From the composition of a liquid slag to its [fluid] table.
#pragma once

#include "host/rheometry/rheometry_options.hpp"
#include "host/rheometry/rheometry_output.hpp"

namespace slagflow {

// Both models side by side, and the table of one of them. Throws InputError.
Answer composition_answer(const RheometryOptions& options);

}  // namespace slagflow
