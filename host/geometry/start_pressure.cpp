#include "host/geometry/start_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "host/geometry/falls.hpp"

namespace slagflow {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double level = 1e-6;  // of gravity: less of it along an axis leaves the axis level

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
    for (const std::size_t site : sites.taken()) potential_.push_back(-dot(gravity_, sites.position(site)));
  }

  Vec3d gravity() const { return gravity_; }

  const std::vector<double>& find() {
    std::vector<std::int32_t> downward(sites_.particles());
    std::iota(downward.begin(), downward.end(), 0);
    std::stable_sort(downward.begin(), downward.end(),
                     [this](std::int32_t a, std::int32_t b) { return potential(a) > potential(b); });
    for (const std::int32_t i : downward) head_[at(i)] = head_from_above(i);
    std::vector<std::int32_t> known_ones;
    std::copy_if(downward.begin(), downward.end(), std::back_inserter(known_ones),
                 [this](std::int32_t i) { return known(i); });
    spread(std::move(known_ones));
    for (const std::int32_t i : downward) {  // fluid without a free surface: from its highest place
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
  double potential(std::int32_t i) const { return potential_[at(i)]; }
  double own_surface(std::int32_t i) const { return potential(i) + 0.5 * c_.spacing * norm(gravity_); }

  // The head of a particle beside one whose head is known: their pressures agree midway between them.
  double carried(std::int32_t from, std::int32_t to) const {
    if (density(from) == density(to)) return head_[at(from)];
    const double face = 0.5 * (potential(from) + potential(to));
    return face + density(from) / density(to) * (head_[at(from)] - face);
  }

  // Of several ways up that of the highest head. Unknown below a wall.
  double head_from_above(std::int32_t i) const {
    double head = unknown;
    bool open = false;
    for (int axis = 0; axis < 3; ++axis) {
      const int up = up_[static_cast<std::size_t>(axis)];
      if (up == 0) continue;
      const auto above = sites_.beside(sites_.site_of(i), axis, up);
      const std::int32_t other = above ? sites_.fluid(*above) : StartSites::none;
      if (other == StartSites::none)
        open = open || !above || sites_.wall(*above) == StartSites::none;
      else if (known(other))
        head = std::fmax(head, carried(other, i));
    }
    return std::isnan(head) && open ? own_surface(i) : head;
  }

  // From the known to the unknown beside them, the nearest first.
  void spread(std::vector<std::int32_t> edge) {
    std::vector<std::int32_t> next;
    for (; !edge.empty(); edge.swap(next), next.clear())
      for (const std::int32_t i : edge)
        for (int axis = 0; axis < 3; ++axis)
          for (const int step : {-1, 1}) {
            const auto beside = sites_.beside(sites_.site_of(i), axis, step);
            const std::int32_t other = beside ? sites_.fluid(*beside) : StartSites::none;
            if (other == StartSites::none || known(other)) continue;
            head_[at(other)] = carried(i, other);
            next.push_back(other);
          }
  }

  const Case& c_;
  const StartSites& sites_;
  const std::vector<std::uint8_t>& fluid_;
  Vec3d gravity_;
  std::vector<double> potential_;  // -g.x of each particle's site [m^2/s^2]
  std::array<int, 3> up_{};        // step along each axis that goes up; 0: level
  std::vector<double> head_;
};

// Of each body of fluid whether it has a wall below it, at most `near` open sites away.
std::vector<bool> resting(const Case& c, const StartSites& sites, const FluidBodies& bodies) {
  constexpr std::int64_t near = 2;
  const Vec3d g = held_gravity(c);
  std::vector<bool> rests(static_cast<std::size_t>(bodies.count), false);
  for (std::size_t i = 0; i < sites.particles(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      for (std::int64_t n = 1; n <= near + 1 && std::abs(g[axis]) > level * norm(g); ++n) {
        const auto below = sites.beside(sites.taken()[i], axis, g[axis] > 0 ? n : -n);
        if (below && sites.wall(*below) != StartSites::none)
          rests[static_cast<std::size_t>(bodies.of[i])] = true;
      }
  return rests;
}

bool any_hydrostatic(const Case& c) {
  return std::any_of(c.regions.begin(), c.regions.end(),
                     [](const RegionSpec& r) { return r.pressure == InitialPressure::hydrostatic; });
}

}  // namespace

std::vector<double> start_pressure(const Case& c, const StartSites& sites, const FluidParticles& fluid,
                                   const std::vector<std::uint32_t>& region) {
  std::vector<double> pressure(sites.particles(), 0);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (c.regions[region[i]].pressure == InitialPressure::uniform)
      pressure[i] = c.regions[region[i]].uniform_pressure;
  Heads heads(c, sites, fluid.fluid);
  const Vec3d gravity = heads.gravity();
  if (!any_hydrostatic(c) || !(norm(gravity) > 0)) return pressure;
  const std::vector<double>& head = heads.find();
  const FluidBodies bodies = fluid_bodies(c, sites);
  const std::vector<bool> rests = resting(c, sites, bodies);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (c.regions[region[i]].pressure == InitialPressure::hydrostatic &&
        rests[static_cast<std::size_t>(bodies.of[i])])
      pressure[i] =
          std::max(0.0, c.fluids[fluid.fluid[i]].density * (head[i] + dot(gravity, fluid.position[i])));
  return pressure;
}

}  // namespace slagflow
