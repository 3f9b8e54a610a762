#include "host/geometry/falls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backend/host_loop.hpp"
#include "host/geometry/flight_path.hpp"
#include "host/geometry/touching.hpp"

namespace slagflow {
namespace {

constexpr std::int64_t near = 2;            // open sites between fluid and what it rests on
constexpr std::size_t at_once = 1 << 15;    // particles that a thread looks at
constexpr std::size_t flown_at_once = 256;  // flights of a thread

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
  const SiteIndex here = sites.index(site);
  for (std::int64_t n = 1; n <= near + 1; ++n) {
    const auto below = sites.beside(here, down.axis, n * down.step);
    if (!below) return {};
    if (sites.wall(*below) != StartSites::none || sites.fluid(*below) != StartSites::none) return below;
  }
  return {};
}

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
    for (std::size_t i = 0; i < sites.particles(); ++i) {
      if (rests_[at(bodies.of[i])]) continue;
      if (const auto below = support(sites, sites.taken()[i], down_))
        if (holds(*below)) rests_[at(bodies.of[i])] = true;
    }
  }

  ImpactSpeeds fastest() {
    const std::vector<std::int64_t> surface = surfaces();
    fly_bodies();
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

  struct Flight {
    double speed = 0;                   // [m/s] at which it meets something
    std::optional<std::size_t> landed;  // where it can stand
  };

  // Along a parabola until half a spacing before something. Of a body's fluid only what is in front flies.
  // `beside`: sites from those of the path to those of the flight.
  Flight fly(FlightPath& path, std::size_t beside, std::int32_t body) const {
    const double dx = sites_.lattice().spacing();
    Flight flight;
    bool in_front = false, met = false;  // met: a wall that may go away
    for (std::size_t k = 0; const FlightPath::Point* const point = path.at(k); ++k) {
      const std::size_t here = point->here + beside, ahead = point->ahead + beside;
      if (!in_front && point->off >= dx) {
        const std::int32_t other = sites_.fluid(here);
        if (other != StartSites::none && bodies_.of[at(other)] == body) return flight;
        in_front = true;
      }
      const bool stopped = holds(ahead) || at_rest(ahead), wall = sites_.wall(ahead) != StartSites::none;
      if ((stopped || (wall && !met)) && point->off > near * dx)
        flight.speed = std::max(flight.speed, point->speed);
      if (stopped) {
        flight.landed = here;
        return flight;
      }
      met = met || wall;
      if (point->leaves) return flight;
    }
    return flight;
  }

  void land(const Flight& flight) {
    flown_ = std::max(flown_, flight.speed);
    if (flight.landed) stand(*flight.landed, height(*flight.landed) + depth_);
  }

  // Of bodies that rest on nothing.
  void fly_bodies() {
    if (std::find(rests_.begin(), rests_.end(), false) == rests_.end()) return;
    for (std::size_t first = 0; first < sites_.particles(); first += at_once) {
      std::vector<Flight> flights(std::min(at_once, sites_.particles() - first));
      for_each_range(flights.size(), flown_at_once, [&](std::size_t from, std::size_t to) {
        FlightPath path(sites_, a_);
        for (std::size_t k = from; k < to; ++k) {
          const std::size_t i = first + k;
          if (rests_[at(bodies_.of[i])]) continue;
          path.begin(fluid_.position[i], fluid_.velocity[i]);
          flights[k] = fly(path, 0, bodies_.of[i]);
        }
      });
      for (const Flight& flight : flights) land(flight);
    }
  }

  std::int64_t height(std::size_t site) const {  // [sites] along the axis, upward
    return -down_.step * sites_.index(site)[static_cast<std::size_t>(down_.axis)];
  }

  // Fluid on a site, driven by a surface as high as `top`.
  void stand(std::size_t site, std::int64_t top) {
    if (state_[site] == stood) return;
    state_.set(site, stood);
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

  // Whether fluid on a site may fall, or spread to a side.
  bool may_go_on(std::size_t site) const {
    const auto below = sites_.beside(site, down_.axis, down_.step);
    if (!below || !(holds(*below) || sites_.fluid(*below) != StartSites::none)) return true;
    bool beside = false;
    for_each_open_side(site, [&](std::size_t, int, int) { beside = true; });
    return beside;
  }

  // Of the fluid that rests, sites from which some may go on.
  std::vector<std::size_t> edges() const {
    std::vector<std::vector<std::size_t>> parts((sites_.particles() + at_once - 1) / at_once);
    for_each_range(sites_.particles(), at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        if (rests_[at(bodies_.of[i])] && may_go_on(sites_.taken()[i]))
          parts[first / at_once].push_back(sites_.taken()[i]);
    });
    std::vector<std::size_t> all;
    for (const std::vector<std::size_t>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  // The highest fluid goes first.
  void spill(const std::vector<std::int64_t>& surface) {
    std::vector<std::size_t> resting = edges();
    std::stable_sort(resting.begin(), resting.end(),
                     [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
    for (const std::size_t site : resting) stand(site, surface[at(bodies_.of[at(sites_.fluid(site))])]);
    for (std::size_t next = 0; next < standing_.size();) {
      const std::size_t end = std::min(standing_.size(), next + at_once);
      const std::vector<Flight> flights = leaps(next, end);
      for (auto flight = flights.begin(); next < end; ++next) {
        const auto [site, top] = standing_[next];
        fall(site, top);
        for_each_open_side(site, [&, top = top](std::size_t beside, int, int) {
          if (!support(sites_, beside, down_)) land(*flight++);
          if (state_[beside] == untouched) fall(beside, top);
        });
      }
    }
  }

  template <class Visit>
  void for_each_open_side(std::size_t site, const Visit& visit) const {
    const SiteIndex here = sites_.index(site);
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        if (axis == down_.axis) continue;
        const auto beside = sites_.beside(here, axis, step);
        if (beside && open(*beside)) visit(*beside, axis, step);
      }
  }

  struct Leap {
    std::size_t site;
    int axis, step;
    std::int64_t top;
  };

  // Off the edges beside some of those that stand.
  std::vector<Flight> leaps(std::size_t first, std::size_t last) const {
    std::vector<Leap> all;
    for (std::size_t k = first; k < last; ++k)
      for_each_open_side(standing_[k].first, [&](std::size_t beside, int axis, int step) {
        if (!support(sites_, beside, down_))
          all.push_back({standing_[k].first, axis, step, standing_[k].second});
      });
    std::vector<Flight> flights(all.size());
    for_each_range(all.size(), flown_at_once, [&](std::size_t from, std::size_t to) {
      FlightPath path(sites_, a_);
      for (std::size_t k = from; k < to; ++k) flights[k] = leap(all[k], path);
    });
    return flights;
  }

  // At the speed that the surface gives. Leaps side by side share their path.
  Flight leap(const Leap& leap, FlightPath& path) const {
    const Lattice& lattice = sites_.lattice();
    const double head = lattice.spacing() * (static_cast<double>(leap.top - height(leap.site)) - 0.5);
    Vec3d velocity;
    velocity[leap.axis] = leap.step * std::sqrt(2 * std::abs(a_[down_.axis]) * std::max(0.0, head));
    const Vec3d start = sites_.position(leap.site);
    const int across = 3 - leap.axis - down_.axis;
    if (!path.serves(start, velocity, across)) path.begin(start, velocity);
    const std::size_t first = *sites_.at(path.start());
    return fly(path, leap.site - first, StartSites::none);
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
      if (state_[site] == untouched) state_.set(site, passed);
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
  Paged<std::uint8_t> state_;  // of each site
  // Floors and fluid from which more may fall, and how high the surface is that drives it.
  std::vector<std::pair<std::size_t, std::int64_t>> standing_;
};

}  // namespace

FluidBodies fluid_bodies(const Case& c, const StartSites& sites, const FluidBodies& touching) {
  const Down down = down_of(acceleration(c));
  if (touching.count < 2 || down.step == 0) return touching;
  Sets sets(static_cast<std::size_t>(touching.count));
  for (std::size_t i = 0; i < sites.particles(); ++i) {
    const auto below = support(sites, sites.taken()[i], down);
    if (!below || sites.fluid(*below) == StartSites::none) continue;
    const std::int32_t other = touching.of[at(sites.fluid(*below))];
    if (other != touching.of[i]) sets.join(at(other), at(touching.of[i]));
  }
  return numbered_bodies(sites.particles(), at(touching.count),
                         [&](std::size_t i) { return sets.root(at(touching.of[i])); });
}

ImpactSpeeds impact_speeds(const Case& c, const StartSites& sites, const FluidParticles& fluid,
                           const FluidBodies& bodies) {
  const Down down = down_of(acceleration(c));
  if (down.step == 0 || sites.lattice().periodic(down.axis)) return {};
  return Falls(c, sites, fluid, bodies).fastest();
}

}  // namespace slagflow
