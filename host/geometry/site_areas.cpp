#include "host/geometry/site_areas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/geometry/geometry.hpp"

namespace slagflow {
namespace {

constexpr double level = 1e-6;  // of a normal along an axis

bool along_axis(Vec3d normal) {
  return std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}) > 1 - level;
}

class Areas {
 public:
  Areas(const Case& c, const WallParticles& walls)
      : c_(c),
        walls_(walls),
        lattice_(c),
        solids_(c),
        flat_(c.dimensions == 2),
        area_(walls.position.size()) {
    for (std::size_t w = 0; w < walls.position.size(); ++w)
      if (const auto site = lattice_.at(walls.position[w])) at_.emplace(lattice_.linear(*site), w);
  }

  std::vector<double> of(const std::vector<std::size_t>& bodies) {
    for (std::size_t b = 0; b < solids_.count(); ++b) {
      if (std::find(bodies.begin(), bodies.end(), b) == bodies.end()) continue;
      aligned(b) ? add_open_faces(b) : add_surface(b);
    }
    return std::move(area_);
  }

 private:
  bool borders(std::size_t w, std::size_t body) const {
    return walls_.body[w] == body && walls_.depth[w] > 0 && walls_.depth[w] < c_.spacing;
  }
  bool aligned(std::size_t body) const {
    for (std::size_t w = 0; w < area_.size(); ++w)
      if (borders(w, body) && !along_axis(walls_.normal[w])) return false;
    return true;
  }
  bool in_domain(Vec3d p) const {
    const double tie = level * c_.spacing;
    for (int k = 0; k < 3; ++k)
      if (!(k == 1 && flat_) && !(p[k] >= c_.domain.lower[k] - tie && p[k] <= c_.domain.upper[k] + tie))
        return false;
    return true;
  }

  // A face across the normal is that of an edge, where there is one along it.
  void add_open_faces(std::size_t body) {
    const double face = std::pow(c_.spacing, c_.dimensions - 1);
    for (std::size_t w = 0; w < area_.size(); ++w) {
      if (!borders(w, body) || !in_domain(walls_.position[w] + walls_.depth[w] * walls_.normal[w])) continue;
      int ahead = 0, across = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (const int way : {-1, 1}) {
          if ((axis == 1 && flat_) || is_taken(w, axis, way)) continue;
          const double looks = way * walls_.normal[w][axis];
          if (looks > -level) ++(looks > level ? ahead : across);
        }
      if (ahead > 0) area_[w] = face * (ahead + across);
    }
  }

  bool is_taken(std::size_t w, int axis, int way) const {
    const auto site = lattice_.at(walls_.position[w]);
    if (!site) return false;
    SiteIndex beside = *site;
    return lattice_.move(beside, axis, way) && at_.count(lattice_.linear(beside)) > 0;
  }

  void add_surface(std::size_t body) {
    const double near = (1 + 0.5 * std::sqrt(3.0)) * c_.spacing;
    const auto distance = [&](Vec3d p) { return solids_[body].distance(p); };
    lattice_.visit_inside([&](Vec3d p) { return distance(p) - near; },
                          [&](const SiteIndex& s, Vec3d p) {
                            if (distance(p) > -near) add_cell(body, s, p);
                          });
  }

  void add_cell(std::size_t body, const SiteIndex& site, Vec3d middle) {
    const int across = 4;
    const double width = c_.spacing / across, volume = std::pow(width, c_.dimensions);
    const auto offset = [&](int k) { return (k - 0.5 * (across - 1)) * width; };
    for (int z = 0; z < across; ++z)
      for (int y = 0; y < (flat_ ? 1 : across); ++y)
        for (int x = 0; x < across; ++x) {
          const Vec3d p = middle + Vec3d{offset(x), flat_ ? 0 : offset(y), offset(z)};
          const double d = solids_[body].distance(p), share = 1 - std::abs(d) / c_.spacing;
          if (share <= 0 || !open_beyond(p, d, body)) continue;
          if (const auto w = nearest(p, site, body)) area_[*w] += share / c_.spacing * volume;
        }
  }

  // Whether the surface nearest to a place is in the domain and in no other wall.
  bool open_beyond(Vec3d p, double distance, std::size_t body) const {
    const double step = 1e-3 * c_.spacing;
    const Vec3d out = away_from([&](Vec3d q) { return solids_[body].distance(q); }, p, step, flat_);
    if (!(norm(out) > 0)) return false;
    const Vec3d foot = p + ((2 * step - distance) / norm(out)) * out;
    return in_domain(lattice_.wrapped(foot)) && solids_.distance_to_company(foot, body) > 0;
  }

  // Of the body's particles beside a site.
  std::optional<std::size_t> nearest(Vec3d p, const SiteIndex& site, std::size_t body) const {
    std::optional<std::size_t> best;
    double least = 0;
    const std::int64_t reach = 2, flat = flat_ ? 0 : reach;
    for (std::int64_t z = -reach; z <= reach; ++z)
      for (std::int64_t y = -flat; y <= flat; ++y)
        for (std::int64_t x = -reach; x <= reach; ++x) {
          SiteIndex s = site;
          if (!lattice_.move(s, 0, x) || !lattice_.move(s, 1, y) || !lattice_.move(s, 2, z)) continue;
          const auto found = at_.find(lattice_.linear(s));
          if (found == at_.end() || !borders(found->second, body)) continue;
          const Vec3d step{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
          const double off = norm(lattice_.position(site) + c_.spacing * step - p);
          if (!best || off < least) best = found->second, least = off;
        }
    return best;
  }

  const Case& c_;
  const WallParticles& walls_;
  Lattice lattice_;
  WallSolids solids_;
  bool flat_;
  std::vector<double> area_;
  std::map<std::size_t, std::size_t> at_;  // wall particle of a site
};

}  // namespace

std::vector<double> site_areas(const Case& c, const SimulationSetup& setup,
                               const std::vector<std::size_t>& bodies) {
  return Areas(c, setup.walls).of(bodies);
}

}  // namespace slagflow
