#include "host/geometry/stl_weld.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "backend/error.hpp"

namespace slagflow {
namespace {

// Numbers places; those closer than the tolerance to one that has a number get that number.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance) {}

  std::size_t number(Vec3d v) {
    Cell low{}, high{};
    for (int k = 0; k < 3; ++k) low[k] = cell(v[k] - tolerance_), high[k] = cell(v[k] + tolerance_);
    for (long x = low[0]; x <= high[0]; ++x)
      for (long y = low[1]; y <= high[1]; ++y)
        for (long z = low[2]; z <= high[2]; ++z) {
          const auto found = places_.find({x, y, z});
          if (found == places_.end()) continue;
          for (const auto& [place, number] : found->second)
            if (norm(place - v) <= tolerance_) return number;
        }
    places_[{cell(v.x), cell(v.y), cell(v.z)}].emplace_back(v, count_);
    return count_++;
  }

 private:
  using Cell = std::array<long, 3>;
  long cell(double value) const { return std::lround(value / (8 * tolerance_)); }

  double tolerance_;
  std::size_t count_ = 0;
  std::map<Cell, std::vector<std::pair<Vec3d, std::size_t>>> places_;
};

// Corners closer than this count as one, since writers round: some print five digits.
double weld_tolerance(const std::vector<Triangle>& triangles) {
  double largest = 0;
  const Vec3d base = triangles.front()[0];
  for (const Triangle& t : triangles)
    for (const Vec3d& v : t)
      for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(v[k] - base[k]));
  return largest > 0 ? 1e-5 * largest : 1;
}

// Gives corners at the same place the same number.
std::vector<Corners> numbered(const std::vector<Triangle>& triangles) {
  const Vec3d base = triangles.front()[0];
  Welder welder(weld_tolerance(triangles));
  std::vector<Corners> welded;
  for (const Triangle& t : triangles) {
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = welder.number(t[c] - base);
    welded.push_back(corners);
  }
  return welded;
}

// One corner that is far away makes all others one.
std::string far_corner(const std::vector<Triangle>& triangles) {
  Vec3d farthest = triangles.front()[0];
  for (const Triangle& t : triangles)
    for (const Vec3d& v : t)
      if (norm(v) > norm(farthest)) farthest = v;
  return ": corners closer than " + length_text(weld_tolerance(triangles)) +
         " count as one, 1e-5 of the extent; the farthest corner is " + corner_text(farthest);
}

}  // namespace

std::string corner_text(Vec3d corner) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.7g, %.7g, %.7g)", corner.x, corner.y, corner.z);
  return text;
}

std::string length_text(double length) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", length);
  return text;
}

WeldedSurface weld(const std::vector<Triangle>& triangles, const std::string& name) {
  const std::vector<Corners> corners = numbered(triangles);
  WeldedSurface surface;
  surface.tolerance = weld_tolerance(triangles);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = corners[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    surface.triangles.push_back(triangles[t]);
    surface.corners.push_back(c);
  }
  if (surface.triangles.empty()) throw InputError(name + ": no triangle has an area" + far_corner(triangles));
  return surface;
}

}  // namespace slagflow
