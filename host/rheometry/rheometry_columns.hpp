// What a column of a table holds, before it is known which sign is decimal.
#pragma once

#include <utility>

#include "host/rheometry/rheometry_table.hpp"

namespace slagflow {

constexpr double temperature_spread = 2;  // [K] within a flow curve

// What a viscometer does not know, such as the shear rate at a disc, it writes as 0.
bool is_zero(const Block& block, int k);

// The least and the largest number; both 0: none.
std::pair<double, double> range_of(const Block& block, int k);

// Whether it is viscosity over temperature that the table has; `wanted`: that is asked for.
bool is_series(const Block& block, bool wanted);

}  // namespace slagflow
