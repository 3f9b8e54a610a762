// Looks at the fluid of the start for what is probably not meant.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {

// Warns of
// - a region in more pieces than it has shapes, of which none touches another, as where a wall cuts a box in
// two;
// - two pieces that almost touch: up to three open sites apart along an axis, no wall between;
// - the region that is thinnest, if most of it is less than three particles across along some axis;
// - fronts and jets that have arrived.
void warn_of_start(const Case& c, const Filling& filling, std::vector<std::string>& warnings);

}  // namespace slagflow
