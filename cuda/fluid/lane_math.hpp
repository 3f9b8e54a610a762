// Vectors and pair rows in lanes.
#pragma once

#include "backend/lanes.hpp"
#include "backend/span.hpp"
#include "fluid/math.hpp"

namespace slagflow {

using LaneVec3 = Vector3<Lanes>;

// The same vector in all lanes.
HOST_DEVICE inline LaneVec3 in_lanes(Vec3 a) { return {a.x, a.y, a.z}; }

// Sum over the lanes.
HOST_DEVICE inline Vec3 total(LaneVec3 a) { return {total(a.x), total(a.y), total(a.z)}; }

HOST_DEVICE inline Symmetric3 total(const SymmetricMatrix3<Lanes>& a) {
  return {total(a.xx), total(a.yy), total(a.zz), total(a.xy), total(a.xz), total(a.yz)};
}

struct QuadLanes {
  Lanes x, y, z, w;
};
HOST_DEVICE inline LaneVec3 xyz(const QuadLanes& q) { return {q.x, q.y, q.z}; }

// Elements at[0], at[1], ... of `from`, one a lane.
HOST_DEVICE_INLINED QuadLanes gather(Span<const Quad> from, const Entries& at) {
  Lanes parts[4];
  gather(from.data, at, parts);
  return {parts[0], parts[1], parts[2], parts[3]};
}
// Where from[at[lane]] is `wanted`.
HOST_DEVICE inline LaneMask same(Span<const std::uint8_t> from, const Entries& at, std::uint8_t wanted) {
  Real found[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) found[lane] = from[at[lane]] == wanted ? Real(1) : Real(0);
  return Lanes(0) < load_lanes(found);
}
HOST_DEVICE inline Lanes gather(Span<const Real> from, const Entries& at) { return gather(from.data, at); }

// Elements first, first + 1, ...
HOST_DEVICE inline QuadLanes load_lanes(Span<const Quad> from, Index first) {
#if defined(SLAGFLOW_CUDA)
  return gather(from, {first});
#else
  Index at[lane_count];
  for (int k = 0; k < lane_count; ++k) at[k] = first + k;
  return gather(from, {at});
#endif
}

}  // namespace slagflow
