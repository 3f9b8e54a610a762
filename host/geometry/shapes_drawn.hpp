// Forms that a profile makes, turned about an axis or drawn out along one.
#pragma once

#include <memory>

#include "host/geometry/shapes.hpp"

namespace slagflow {

std::shared_ptr<const Form> make_frustum(const FrustumSpec&);
std::shared_ptr<const Form> make_prism(const PrismSpec&);

// A place about an axis through `start`.
struct AxisParts {
  double along, radius;  // [m]
  Vec3d radial;          // unit vector away from the axis; any across it within `none` [m] of it
};
AxisParts parts_about(Vec3d start, Vec3d axis, Vec3d p, double none);

}  // namespace slagflow
