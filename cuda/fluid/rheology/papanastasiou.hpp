// The growth of the stress in Papanastasiou's regularisation.
#pragma once

#include "fluid/math.hpp"

namespace slagflow {

// (1 - exp(-x)) / x for x >= 0, with its limit 1 at x = 0. expm1 keeps the digits where the exponential is
// close to one; below 1e-30, where a GPU may take a number for zero, the limit is exact.
HOST_DEVICE inline Real growth_ratio(Real x) { return x > Real(1e-30) ? -std::expm1(-x) / x : Real(1); }

}  // namespace slagflow
