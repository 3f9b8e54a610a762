// The faces of inlets as planes with an outline.
#pragma once

#include <functional>
#include <string>

#include "host/case/case.hpp"

namespace slagflow {

// Coordinates over the face: p = center + a u + b v.
struct FaceFrame {
  Vec3d center, normal, u, v;
  double a(Vec3d p) const { return dot(p - center, u); }
  double b(Vec3d p) const { return dot(p - center, v); }
  Vec3d at(double x, double y) const { return center + x * u + y * v; }
};

// v as near to `up` as the normal allows, which may have any length.
FaceFrame frame_of(const Case&, Vec3d center, Vec3d normal, Vec3d up);

// The face: whether it holds a place, and its area.
struct InletOutline {
  FaceFrame frame;
  double half_a = 0, half_b = 0;  // [m] extent to either side
  double area = 0;                // [m^2], a height [m] with two dimensions
  std::function<bool(double, double)> holds;
  // Of a file that does not lie in the domain and would in another unit; with "; " before, or empty.
  std::string unit_hint;
};

// Throws InputError as refuse_inlet does.
InletOutline face_of(const Case&, std::size_t inlet);

// Throws InputError naming the key of an inlet; "": the inlet itself.
[[noreturn]] void refuse_inlet(const Case&, std::size_t inlet, const std::string& key,
                               const std::string& what);

}  // namespace slagflow
