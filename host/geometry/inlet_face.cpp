#include "host/geometry/inlet_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/region_survey.hpp"
#include "host/geometry/stl.hpp"

namespace slagflow {
namespace {

Vec3d unit(Vec3d v) { return v * (1 / norm(v)); }

}  // namespace

FaceFrame frame_of(const Case& c, Vec3d center, Vec3d normal, Vec3d up) {
  FaceFrame f{center, unit(normal), {}, {}};
  if (c.dimensions == 2) {
    f.center.y = 0;
    f.u = {0, 1, 0}, f.v = cross(f.normal, f.u);
    return f;
  }
  const auto square = [&](Vec3d way) { return way - dot(way, f.normal) * f.normal; };
  Vec3d v = square(up);
  if (!(norm(v) > 1e-6 * norm(up))) v = square({0, 0, 1});
  if (!(norm(v) > 1e-6)) v = square({1, 0, 0});
  f.v = unit(v), f.u = cross(f.v, f.normal);
  return f;
}

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double flat = 1e-3;  // of its size, that a patch may be bent

double side(Vec3d a, Vec3d b, Vec3d p, Vec3d normal) { return dot(cross(b - a, p - a), normal); }

// Inside or on the edge, whichever way round the triangle goes.
bool in_triangle(const Triangle& t, Vec3d p, Vec3d normal) {
  const double s[] = {side(t[0], t[1], p, normal), side(t[1], t[2], p, normal), side(t[2], t[0], p, normal)};
  return (s[0] >= 0 && s[1] >= 0 && s[2] >= 0) || (s[0] <= 0 && s[1] <= 0 && s[2] <= 0);
}

// But for a spacing.
bool in_domain(const Case& c, Vec3d low, Vec3d high) {
  for (int k = 0; k < 3; ++k)
    if (!(k == 1 && c.dimensions == 2) &&
        !(low[k] > c.domain.lower[k] - c.spacing && high[k] < c.domain.upper[k] + c.spacing))
      return false;
  return true;
}

// The corners of a patch as they are placed; the unit has it lie in the domain and hold some particles.
std::string unit_hint(const Case& c, const StlSpec& stl, Vec3d low, Vec3d high) {
  constexpr double least = 2;  // [spacings] across
  std::string reach = "; '" + std::filesystem::path(stl.file).filename().string() + "' reaches " +
                      range_of(low, high) + ", the domain " + range_of(c.domain.lower, c.domain.upper);
  for (const DrawingUnit& unit : drawing_units) {
    const double factor = unit.scale / stl.scale;
    if (std::abs(factor - 1) < 0.01 || factor * norm(high - low) < least * c.spacing) continue;
    if (in_domain(c, stl.translate + factor * (low - stl.translate),
                  stl.translate + factor * (high - stl.translate)))
      return reach + ": with scale = " + show(unit.scale) + " it would lie in it; was it drawn in " +
             unit.name + "?";
  }
  return reach;
}

std::string rounded(double number) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.4g", number);
  return text.data();
}

InletOutline patch_face(const Case& c, std::size_t inlet) {
  const InletSpec& spec = c.inlets[inlet];
  std::vector<Triangle> triangles = read_stl(spec.stl.file);
  Vec3d low{1e300, 1e300, 1e300}, high = -1.0 * low;
  for (Triangle& t : triangles)
    for (Vec3d& p : t) {
      p = spec.stl.scale * p + spec.stl.translate;
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
  InletOutline face;
  face.unit_hint = unit_hint(c, spec.stl, low, high);
  face.frame = frame_of(c, 0.5 * (low + high), spec.normal, {});
  const Vec3d n = face.frame.normal;
  double furthest = 0;
  for (const Triangle& t : triangles) {
    face.area += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
    for (const Vec3d& p : t) {
      furthest = std::max(furthest, std::abs(dot(p - triangles[0][0], n)));
      face.half_a = std::max(face.half_a, std::abs(face.frame.a(p)));
      face.half_b = std::max(face.half_b, std::abs(face.frame.b(p)));
    }
  }
  face.frame.center += dot(triangles[0][0] - face.frame.center, n) * n;
  if (furthest > flat * norm(high - low))
    refuse_inlet(
        c, inlet, "file",
        "its triangles lie up to " + show(furthest) +
            " m beside a plane square to normal: allowed: a flat patch, and the normal of its plane");
  const FaceFrame frame = face.frame;
  face.holds = [triangles, frame](double a, double b) {
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const Triangle& t) { return in_triangle(t, frame.at(a, b), frame.normal); });
  };
  return face;
}

InletOutline outline_of(const Case& c, std::size_t inlet) {
  const InletSpec& spec = c.inlets[inlet];
  if (spec.face == InletFace::stl) return patch_face(c, inlet);
  InletOutline face;
  face.frame = frame_of(c, spec.center, spec.normal, spec.up);
  if (spec.face == InletFace::rectangle) {
    face.half_a = 0.5 * spec.width, face.half_b = 0.5 * spec.height;
    face.area = spec.height * (c.dimensions == 2 ? 1 : spec.width);
    return face;
  }
  const double outer = spec.radius, inner = spec.face == InletFace::annulus ? spec.inner_radius : 0;
  face.half_a = face.half_b = outer;
  face.area = pi * (outer * outer - inner * inner);
  face.holds = [inner, outer](double a, double b) {
    const double r2 = a * a + b * b;
    return r2 < outer * outer && r2 >= inner * inner;
  };
  return face;
}

}  // namespace

InletOutline face_of(const Case& c, std::size_t inlet) {
  InletOutline face = outline_of(c, inlet);
  Vec3d size = c.domain.upper - c.domain.lower;
  if (c.dimensions == 2) size.y = 0;
  const double across = 2 * std::max(c.dimensions == 2 ? 0 : face.half_a, face.half_b);
  if (across <= norm(size)) return face;
  const bool patch = c.inlets[inlet].face == InletFace::stl;
  refuse_inlet(c, inlet, patch ? "scale" : "",
               "its face is " + rounded(across) + " m across, the domain " + rounded(norm(size)) +
                   " m from corner to corner: allowed: a face within the domain" + face.unit_hint);
}

void refuse_inlet(const Case& c, std::size_t inlet, const std::string& key, const std::string& what) {
  const std::string path = "inlet." + std::to_string(inlet) + (key.empty() ? "" : "." + key);
  throw InputError(c.place_of(path) + ": key '" + path + "': " + what);
}

}  // namespace slagflow
