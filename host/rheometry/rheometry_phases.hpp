// From a table of thermodynamics software to the solid_fraction and heat of a [fluid] table.
#pragma once

#include "host/rheometry/rheometry_options.hpp"
#include "host/rheometry/rheometry_output.hpp"

namespace slagflow {

// Throws InputError.
Answer phases_answer(const RheometryOptions& options);

}  // namespace slagflow
