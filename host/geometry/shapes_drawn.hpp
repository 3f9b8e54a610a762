// Forms that a profile makes, turned about an axis or drawn out along one.
#pragma once

#include <memory>

#include "host/geometry/shapes.hpp"

namespace slagflow {

std::shared_ptr<const Form> make_frustum(const FrustumSpec&);
std::shared_ptr<const Form> make_prism(const PrismSpec&);

// Any unit vector across the given one.
Vec3d any_across(Vec3d axis);

}  // namespace slagflow
