// The options of `slagflow rheometry`.
#pragma once

#include <CLI/CLI.hpp>

#include "host/rheometry/rheometry_options.hpp"

namespace slagflow {

// As the keys of a case.
CLI::Validator number_above_zero();

CLI::App* add_rheometry(CLI::App& app, RheometryOptions& options);

}  // namespace slagflow
