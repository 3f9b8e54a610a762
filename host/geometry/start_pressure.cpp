#include "host/geometry/start_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "backend/host_loop.hpp"

namespace slagflow {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double level = 1e-6;            // of gravity: less of it along an axis leaves the axis level
constexpr std::size_t at_once = 1 << 15;  // particles that a thread looks at

// The part of gravity that a pressure can hold: along a periodic axis fluid has no highest place.
Vec3d held_gravity(const Case& c) {
  Vec3d g = c.gravity;
  for (int axis = 0; axis < 3; ++axis)
    if (c.domain.periodic[static_cast<std::size_t>(axis)]) g[axis] = 0;
  return g;
}

// Heads instead of pressures: the potential at which a particle's own fluid would have its free surface. It
// is one number throughout a fluid at rest, so that nothing adds up on the way.
class Heads {
 public:
  Heads(const Case& c, const StartSites& sites, const std::vector<std::uint8_t>& fluid)
      : c_(c), sites_(sites), fluid_(fluid), gravity_(held_gravity(c)), head_(sites.particles(), unknown) {
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(gravity_[axis]) > level * norm(gravity_))
        up_[static_cast<std::size_t>(axis)] = gravity_[axis] < 0 ? 1 : -1;
  }

  Vec3d gravity() const { return gravity_; }

  const std::vector<double>& find() {
    go_downward();
    std::vector<std::int32_t> left;
    for (std::size_t i = 0; i < head_.size(); ++i)
      if (std::isnan(head_[i])) left.push_back(static_cast<std::int32_t>(i));
    if (left.empty()) return head_;
    spread(sorted(known_beside(left)));
    for (const std::int32_t i : sorted(std::move(left))) {  // no free surface: from its highest place
      if (known(i)) continue;
      head_[at(i)] = own_surface(i);
      spread({i});
    }
    return head_;
  }

 private:
  static std::size_t at(std::int32_t particle) { return static_cast<std::size_t>(particle); }
  bool known(std::int32_t i) const { return !std::isnan(head_[at(i)]); }
  double density(std::int32_t i) const { return c_.fluids[fluid_[at(i)]].density; }
  double potential(std::int32_t i) const { return -dot(gravity_, sites_.position(sites_.site_of(i))); }
  double own_surface(std::int32_t i) const { return potential(i) + 0.5 * c_.spacing * norm(gravity_); }

  // The head of a particle beside one whose head is known: their pressures agree midway between them.
  double carried(std::int32_t from, std::int32_t to) const {
    if (density(from) == density(to)) return head_[at(from)];
    const double face = 0.5 * (potential(from) + potential(to));
    return face + density(from) / density(to) * (head_[at(from)] - face);
  }

  // From site to site: what is above one comes before it.
  void go_downward() {
    std::vector<std::pair<SiteIndex, std::int64_t>> rows;
    sites_.for_each_row([&](std::size_t first, std::size_t count) {
      rows.emplace_back(sites_.index(first), static_cast<std::int64_t>(count));
    });
    const auto order = [&](const SiteIndex& s) {
      return SiteIndex{-up_[2] * s[2], -up_[1] * s[1], -up_[0] * s[0]};
    };
    std::stable_sort(rows.begin(), rows.end(),
                     [&](const auto& a, const auto& b) { return order(a.first) < order(b.first); });
    for (const auto& [first, count] : rows)
      for (std::int64_t k = 0; k < count; ++k) {
        const SiteIndex s{first[0] + (up_[0] > 0 ? count - 1 - k : k), first[1], first[2]};
        const std::int32_t i = sites_.fluid(sites_.lattice().linear(s));
        head_[at(i)] = head_from_above(i, s);
      }
  }

  // Those whose heads are known beside some of which they are not, by their numbers.
  std::vector<std::int32_t> known_beside(const std::vector<std::int32_t>& left) const {
    std::vector<std::int32_t> all;
    for (const std::int32_t i : left)
      for_each_beside(i, [&](std::int32_t other) {
        if (known(other)) all.push_back(other);
      });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // The highest first.
  std::vector<std::int32_t> sorted(std::vector<std::int32_t> particles) const {
    std::vector<std::pair<double, std::int32_t>> keys;
    for (const std::int32_t i : particles) keys.emplace_back(potential(i), i);
    std::stable_sort(keys.begin(), keys.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t k = 0; k < keys.size(); ++k) particles[k] = keys[k].second;
    return particles;
  }

  // Of several ways up that of the highest head. Unknown below a wall.
  double head_from_above(std::int32_t i, const SiteIndex& site) const {
    double head = unknown;
    bool open = false;
    for (int axis = 0; axis < 3; ++axis) {
      const int up = up_[static_cast<std::size_t>(axis)];
      if (up == 0) continue;
      const auto above = sites_.beside(site, axis, up);
      const std::int32_t other = above ? sites_.fluid(*above) : StartSites::none;
      if (other == StartSites::none)
        open = open || !above || sites_.wall(*above) == StartSites::none;
      else if (known(other))
        head = std::fmax(head, carried(other, i));
    }
    return std::isnan(head) && open ? own_surface(i) : head;
  }

  template <class Visit>
  void for_each_beside(std::int32_t i, const Visit& visit) const {
    const SiteIndex here = sites_.index(sites_.site_of(i));
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        const auto beside = sites_.beside(here, axis, step);
        if (beside && sites_.fluid(*beside) != StartSites::none) visit(sites_.fluid(*beside));
      }
  }

  // From the known to the unknown beside them, the nearest first.
  void spread(std::vector<std::int32_t> edge) {
    std::vector<std::int32_t> next;
    for (; !edge.empty(); edge.swap(next), next.clear())
      for (const std::int32_t i : edge)
        for_each_beside(i, [&](std::int32_t other) {
          if (known(other)) return;
          head_[at(other)] = carried(i, other);
          next.push_back(other);
        });
  }

  const Case& c_;
  const StartSites& sites_;
  const std::vector<std::uint8_t>& fluid_;
  Vec3d gravity_;
  std::array<int, 3> up_{};  // step along each axis that goes up; 0: level
  std::vector<double> head_;
};

// Of each body of fluid whether it has a wall below it, at most `near` open sites away.
std::vector<bool> resting(const Case& c, const StartSites& sites, const FluidBodies& bodies) {
  constexpr std::int64_t near = 2;
  const Vec3d g = held_gravity(c);
  std::vector<bool> rests(static_cast<std::size_t>(bodies.count), false);
  for (std::size_t i = 0; i < sites.particles(); ++i) {
    const auto body = static_cast<std::size_t>(bodies.of[i]);
    for (int axis = 0; axis < 3 && !rests[body]; ++axis)
      for (std::int64_t n = 1; n <= near + 1 && std::abs(g[axis]) > level * norm(g); ++n) {
        const auto below = sites.beside(sites.taken()[i], axis, g[axis] > 0 ? n : -n);
        if (below && sites.wall(*below) != StartSites::none) rests[body] = true;
      }
  }
  return rests;
}

bool any_hydrostatic(const Case& c) {
  return std::any_of(c.regions.begin(), c.regions.end(),
                     [](const RegionSpec& r) { return r.pressure == InitialPressure::hydrostatic; });
}

}  // namespace

std::vector<double> start_pressure(const Case& c, const StartSites& sites, const FluidBodies& bodies,
                                   const FluidParticles& fluid, const std::vector<std::uint32_t>& region) {
  std::vector<double> pressure(sites.particles(), 0);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (c.regions[region[i]].pressure == InitialPressure::uniform)
      pressure[i] = c.regions[region[i]].uniform_pressure;
  if (!any_hydrostatic(c) || !(norm(held_gravity(c)) > 0)) return pressure;
  Heads heads(c, sites, fluid.fluid);
  const Vec3d gravity = heads.gravity();
  const std::vector<double>& head = heads.find();
  const std::vector<bool> rests = resting(c, sites, bodies);
  for_each_range(pressure.size(), at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (c.regions[region[i]].pressure == InitialPressure::hydrostatic &&
          rests[static_cast<std::size_t>(bodies.of[i])])
        pressure[i] =
            std::max(0.0, c.fluids[fluid.fluid[i]].density * (head[i] + dot(gravity, fluid.position[i])));
  });
  return pressure;
}

}  // namespace slagflow
