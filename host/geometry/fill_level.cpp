#include "host/geometry/fill_level.hpp"

#include <cmath>
#include <cstdio>
#include <optional>

#include "backend/error.hpp"

namespace slagflow {
namespace {

std::string text_of(Vec3d p) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) m", p.x, p.y, p.z);
  return text;
}

class Flood {
 public:
  explicit Flood(const FloodSpace& space)
      : s_(space), fill_(space.c.regions[space.region].fill), filled_(space.lattice.size(), false) {}

  std::vector<bool> run() {
    if (norm(s_.c.gravity) == 0) refuse("needs gravity, which makes a level: allowed: shapes");
    if (!below(fill_.from)) refuse("has 'from' above 'level': allowed: a point below it");
    const SiteIndex start = first();
    std::vector<SiteIndex> edge{start};
    filled_[s_.lattice.linear(start)] = true;
    while (!edge.empty()) {
      const SiteIndex here = edge.back();
      edge.pop_back();
      for (int axis = 0; axis < 3; ++axis)
        for (const int way : {-1, 1})
          if (!(axis == 1 && s_.c.dimensions == 2)) spread(here, axis, way, edge);
    }
    return std::move(filled_);
  }

 private:
  bool below(Vec3d p) const { return dot(p - fill_.level, s_.c.gravity) > 0; }

  // The open site nearest to the place.
  SiteIndex first() const {
    std::optional<SiteIndex> nearest;
    double least = s_.c.spacing * std::sqrt(3.0);
    const SiteIndex& n = s_.lattice.count();
    SiteIndex s{};
    for (s[2] = 0; s[2] < n[2]; ++s[2])
      for (s[1] = 0; s[1] < n[1]; ++s[1])
        for (s[0] = 0; s[0] < n[0]; ++s[0]) {
          Vec3d off = s_.lattice.position(s) - fill_.from;
          if (s_.c.dimensions == 2) off.y = 0;
          if (norm(off) >= least || s_.body[s_.lattice.linear(s)] != 0 || !s_.lattice.in_domain(s)) continue;
          least = norm(off), nearest = s;
        }
    if (!nearest) refuse("has 'from' in a wall or outside the domain: allowed: a point in the vessel");
    return *nearest;
  }

  void spread(const SiteIndex& here, int axis, int way, std::vector<SiteIndex>& edge) {
    SiteIndex s = here;
    const bool there = s_.lattice.move(s, axis, way);
    if (there && (filled_[s_.lattice.linear(s)] || s_.body[s_.lattice.linear(s)] != 0)) return;
    if (there && !below(s_.lattice.position(s))) return;
    if (!there || !s_.lattice.in_domain(s))
      refuse("would run out of the domain at " + text_of(s_.lattice.position(here)) +
             ": allowed: a level below the rim of a vessel that is closed there");
    filled_[s_.lattice.linear(s)] = true;
    edge.push_back(s);
  }

  [[noreturn]] void refuse(const std::string& what) const {
    const std::string key = "region." + std::to_string(s_.region) + ".fill";
    throw InputError(s_.c.place_of(key) + ": key '" + key + "': " + what);
  }

  const FloodSpace& s_;
  const FillSpec& fill_;
  std::vector<bool> filled_;
};

}  // namespace

std::vector<bool> flood(const FloodSpace& space) { return Flood(space).run(); }

}  // namespace slagflow
