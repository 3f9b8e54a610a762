#include "host/geometry/falls.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace slagflow {
namespace {

constexpr std::int64_t near = 2;  // open sites between fluid and what it rests on

Vec3d acceleration(const Case& c) { return c.gravity + c.body_force; }

// Axis and step of the largest component; step 0 without any.
struct Down {
  int axis = 2;
  std::int64_t step = 0;
};
Down down_of(Vec3d a) {
  Down down;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(a[axis]) > std::abs(a[down.axis])) down.axis = axis;
  if (a[down.axis] != 0) down.step = a[down.axis] > 0 ? 1 : -1;
  return down;
}

std::size_t at(std::int32_t particle) { return static_cast<std::size_t>(particle); }

// What lies below a fluid site, through at most `near` open sites.
std::optional<std::size_t> support(const StartSites& sites, std::size_t site, Down down) {
  for (std::int64_t n = 1; n <= near + 1; ++n) {
    const auto below = sites.beside(site, down.axis, n * down.step);
    if (!below) return {};
    if (sites.wall(*below) != StartSites::none || sites.fluid(*below) != StartSites::none) return below;
  }
  return {};
}

// Gives all that hangs together with a particle its number.
class Labels {
 public:
  Labels(const StartSites& sites, Down down) : sites_(sites), down_(down) {
    bodies_.of.assign(sites.particles(), StartSites::none);
    above_.resize(sites.particles(), StartSites::none);
    for (std::size_t i = 0; down.step != 0 && i < sites.particles(); ++i) {
      const auto below = support(sites, sites.taken()[i], down);
      if (below && sites.fluid(*below) != StartSites::none)
        above_[at(sites.fluid(*below))] = static_cast<std::int32_t>(i);
    }
  }

  FluidBodies find() {
    for (std::size_t i = 0; i < sites_.particles(); ++i)
      if (bodies_.of[i] == StartSites::none) {
        take(static_cast<std::int32_t>(i));
        while (!edge_.empty()) visit(next());
        ++bodies_.count;
      }
    return std::move(bodies_);
  }

 private:
  void take(std::int32_t particle) {
    if (particle == StartSites::none || bodies_.of[at(particle)] != StartSites::none) return;
    bodies_.of[at(particle)] = bodies_.count;
    edge_.push_back(particle);
  }
  std::int32_t next() {
    const std::int32_t i = edge_.back();
    edge_.pop_back();
    return i;
  }

  // All sites around it, corners included, and what is near above and below.
  void visit(std::int32_t i) {
    const std::size_t site = sites_.site_of(i);
    const Lattice& lattice = sites_.lattice();
    const SiteIndex here = sites_.index(site);
    for (std::int64_t z = -1; z <= 1; ++z)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t x = -1; x <= 1; ++x) {
          SiteIndex s = here;
          if (lattice.move(s, 0, x) && lattice.move(s, 1, y) && lattice.move(s, 2, z))
            take(sites_.fluid(lattice.linear(s)));
        }
    take(above_[at(i)]);
    if (down_.step == 0) return;
    if (const auto below = support(sites_, site, down_)) take(sites_.fluid(*below));
  }

  const StartSites& sites_;
  Down down_;
  FluidBodies bodies_;
  std::vector<std::int32_t> above_;  // of each particle, the one that rests on it, not far above
  std::vector<std::int32_t> edge_;
};

class Falls {
 public:
  Falls(const Case& c, const StartSites& sites, const FluidParticles& fluid, const FluidBodies& bodies)
      : c_(c),
        sites_(sites),
        fluid_(fluid),
        bodies_(bodies),
        a_(acceleration(c)),
        down_(down_of(a_)),
        state_(sites.lattice().size(), untouched) {
    rests_.assign(static_cast<std::size_t>(bodies.count), false);
    for (std::size_t i = 0; i < sites.particles(); ++i)
      if (const auto below = support(sites, sites.taken()[i], down_))
        if (holds(*below)) rests_[at(bodies.of[i])] = true;
  }

  ImpactSpeeds fastest() {
    const std::vector<std::int64_t> surface = surfaces();
    for (std::size_t i = 0; i < sites_.particles(); ++i)
      if (!rests_[at(bodies_.of[i])]) fly(fluid_.position[i], fluid_.velocity[i], bodies_.of[i]);
    const double body = flown_;
    spill(surface);
    const double height = sites_.lattice().spacing() * static_cast<double>(fallen_);
    return {body, std::max(flown_, std::sqrt(2 * std::abs(a_[down_.axis]) * height))};
  }

 private:
  bool holds(std::size_t site) const {
    const std::int32_t wall = sites_.wall(site);
    return wall != StartSites::none && !c_.walls[at(wall)].motion.moves();
  }
  bool at_rest(std::size_t site) const {
    const std::int32_t i = sites_.fluid(site);
    return i != StartSites::none && rests_[at(bodies_.of[at(i)])];
  }

  // Along a parabola until half a spacing before something. Of a body's fluid only what is in front flies.
  void fly(Vec3d start, Vec3d velocity, std::int32_t body) {
    const double dx = sites_.lattice().spacing();
    const auto [nx, ny, nz] = sites_.lattice().count();
    const double longest = 4 * dx * static_cast<double>(nx + ny + nz);  // round periodic axes
    Vec3d x = start, v = velocity;
    bool in_front = false, met = false;  // met: a wall that may go away
    for (double t = 0, way = 0; way < longest;) {
      const double step = 0.25 * dx / std::max(norm(v), std::sqrt(norm(a_) * dx));
      t += step, way += step * norm(v);
      x = start + t * velocity + (0.5 * t * t) * a_;
      v = velocity + t * a_;
      const auto here = sites_.at(x), ahead = sites_.at(x + (0.5 * dx / norm(v)) * v);
      if (!here || !ahead) return;
      if (!in_front && norm(x - start) >= dx) {
        const std::int32_t other = sites_.fluid(*here);
        if (other != StartSites::none && bodies_.of[at(other)] == body) return;
        in_front = true;
      }
      const bool stopped = holds(*ahead) || at_rest(*ahead), wall = sites_.wall(*ahead) != StartSites::none;
      if ((stopped || (wall && !met)) && norm(x - start) > near * dx) flown_ = std::max(flown_, norm(v));
      if (stopped) return stand(*here, height(*here) + depth_);
      met = met || wall;
      if (!sites_.in_domain(*ahead)) return;
    }
  }

  std::int64_t height(std::size_t site) const {  // [sites] along the axis, upward
    return -down_.step * sites_.index(site)[static_cast<std::size_t>(down_.axis)];
  }

  // Fluid on a site, driven by a surface as high as `top`.
  void stand(std::size_t site, std::int64_t top) {
    if (state_[site] == stood) return;
    state_[site] = stood;
    standing_.push_back({site, top});
  }

  bool open(std::size_t site) const {
    return sites_.in_domain(site) && !holds(site) && sites_.fluid(site) == StartSites::none;
  }

  // The surface of each body, above its highest site, and depth_ of the deepest.
  std::vector<std::int64_t> surfaces() {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    std::vector<std::int64_t> surface(rests_.size(), -most), floor(rests_.size(), most);
    for (std::size_t i = 0; i < sites_.particles(); ++i) {
      const std::int64_t here = height(sites_.taken()[i]);
      const std::size_t body = at(bodies_.of[i]);
      surface[body] = std::max(surface[body], here + 1), floor[body] = std::min(floor[body], here);
    }
    for (std::size_t b = 0; b < surface.size(); ++b) depth_ = std::max(depth_, surface[b] - floor[b]);
    return surface;
  }

  // The highest fluid goes first.
  void spill(const std::vector<std::int64_t>& surface) {
    std::vector<std::size_t> resting;
    for (std::size_t i = 0; i < sites_.particles(); ++i)
      if (rests_[at(bodies_.of[i])]) resting.push_back(sites_.taken()[i]);
    std::stable_sort(resting.begin(), resting.end(),
                     [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
    for (const std::size_t site : resting) stand(site, surface[at(bodies_.of[at(sites_.fluid(site))])]);
    for (; !standing_.empty(); standing_.pop_front()) {
      const auto [site, top] = standing_.front();
      fall(site, top);
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          if (axis == down_.axis) continue;
          const auto beside = sites_.beside(site, axis, step);
          if (!beside || !open(*beside)) continue;
          if (!support(sites_, *beside, down_)) leap(site, axis, step, top);
          if (state_[*beside] == untouched) fall(*beside, top);
        }
    }
  }

  // Off an edge at the speed that the surface gives.
  void leap(std::size_t site, int axis, int step, std::int64_t top) {
    const double head = sites_.lattice().spacing() * (static_cast<double>(top - height(site)) - 0.5);
    Vec3d velocity;
    velocity[axis] = step * std::sqrt(2 * std::abs(a_[down_.axis]) * std::max(0.0, head));
    fly(sites_.position(site), velocity, StartSites::none);
  }

  // Straight down to where it can stand, or out of the domain.
  void fall(std::size_t site, std::int64_t top) {
    const std::int64_t from = height(site);
    for (bool met = false;;) {
      const auto below = sites_.beside(site, down_.axis, down_.step);
      const std::int64_t here = height(site);
      const bool stopped = below && (holds(*below) || sites_.fluid(*below) != StartSites::none);
      const bool wall = below && sites_.wall(*below) != StartSites::none;
      if ((stopped || (wall && !met)) && from - here > near) fallen_ = std::max(fallen_, top - here);
      if (stopped) return stand(site, from - here > near ? here + depth_ : top);
      met = met || wall;
      if (state_[site] == untouched) state_[site] = passed;
      if (!below || !sites_.in_domain(*below)) return;
      site = *below;
    }
  }

  const Case& c_;
  const StartSites& sites_;
  const FluidParticles& fluid_;
  const FluidBodies& bodies_;
  Vec3d a_;
  Down down_;
  std::vector<bool> rests_;              // of each body
  double flown_ = 0;                     // [m/s] at the end of the fastest parabola
  std::int64_t fallen_ = 0, depth_ = 0;  // [sites] from a surface to where fluid falls; of the deepest body
  static constexpr std::uint8_t untouched = 0, passed = 1, stood = 2;
  std::vector<std::uint8_t> state_;  // of each site
  // Floors and fluid from which more may fall, and how high the surface is that drives it.
  std::deque<std::pair<std::size_t, std::int64_t>> standing_;
};

}  // namespace

FluidBodies fluid_bodies(const Case& c, const StartSites& sites) {
  return Labels(sites, down_of(acceleration(c))).find();
}

ImpactSpeeds impact_speeds(const Case& c, const StartSites& sites, const FluidParticles& fluid,
                           const FluidBodies& bodies) {
  const Down down = down_of(acceleration(c));
  if (down.step == 0 || sites.lattice().periodic(down.axis)) return {};
  return Falls(c, sites, fluid, bodies).fastest();
}

}  // namespace slagflow
