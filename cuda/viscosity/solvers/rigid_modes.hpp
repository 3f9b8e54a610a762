// The six rigid motions of an aggregate, (U, W): the velocity at r from its centre is U + W x r / scale, so
// that all six are speeds [m/s].
#pragma once

#include "fluid/math.hpp"

namespace slagflow {

struct RigidMotion {
  Vec3d translation, rotation;

  HOST_DEVICE double operator[](int k) const { return k < 3 ? translation[k] : rotation[k - 3]; }
  HOST_DEVICE RigidMotion& operator+=(RigidMotion b) {
    return translation += b.translation, rotation += b.rotation, *this;
  }
  HOST_DEVICE Vec3d at(Vec3d r, double scale) const { return translation + cross(rotation, r) * (1 / scale); }
};

// The transpose: what a force at r does to the six motions.
HOST_DEVICE inline RigidMotion force_at(Vec3d r, double scale, Vec3d force) {
  return {force, cross(r, force) * (1 / scale)};
}

HOST_DEVICE inline RigidMotion load_motion(const double* values) {
  return {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}
HOST_DEVICE inline void store_motion(RigidMotion m, double* values) {
  for (int k = 0; k < 6; ++k) values[k] = m[k];
}

// Inverts a symmetric positive definite n x n matrix in place, by sweeping its pivots one after another.
HOST_DEVICE inline void invert(double* a, int n) {
  for (int k = 0; k < n; ++k) {
    const double d = 1 / a[k * n + k];
    for (int i = 0; i < n; ++i) {
      if (i == k || a[i * n + k] == 0) continue;
      const double factor = a[i * n + k] * d;
      for (int j = 0; j < n; ++j)
        if (j != k) a[i * n + j] -= factor * a[k * n + j];
    }
    for (int j = 0; j < n; ++j)
      if (j != k) a[k * n + j] *= d, a[j * n + k] *= d;
    a[k * n + k] = -d;
  }
  for (int k = 0; k < n * n; ++k) a[k] = -a[k];
}

}  // namespace slagflow
