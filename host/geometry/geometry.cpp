#include "host/geometry/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "backend/error.hpp"
#include "backend/host_loop.hpp"
#include "host/geometry/falls.hpp"
#include "host/geometry/fill_level.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/region_fields.hpp"
#include "host/geometry/region_survey.hpp"
#include "host/geometry/start_pressure.hpp"
#include "host/geometry/touching.hpp"
#include "host/geometry/wall_filler.hpp"

namespace slagflow {
namespace {

constexpr double wall_room = 0.25;         // [spacings] that fluid needs before a wall at the start
constexpr double wall_gap = 0.02;          // [spacings] that fluid keeps from a wall at the start
constexpr double bytes_per_particle = 89;  // position, normals, depths, index of a wall particle
constexpr std::size_t most_particles = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t room_check = 1 << 20;  // particles between looks at the memory
constexpr std::size_t parts_at_once = 64;    // of the lattice, whose particles are kept before they are added

class Filler {
 public:
  explicit Filler(const Case& c)
      : c_(c),
        lattice_(c),
        solids_(c),
        survey_(c, lattice_, solids_),
        inlets_(c, columns()),
        body_(lattice_.size(), 0),
        fluid_(lattice_) {}

  Filling run(const Stage& stage) {
    tell(stage, "looking for the sites of walls");
    mark_walls();
    tell(stage, "filling the regions");
    for (std::size_t r = 0; r < c_.regions.size(); ++r) fill_region(r);
    tell(stage, "placing wall particles");
    place_walls();
    warn_of_walls();
    for (std::string& warning : survey_.warnings()) result_.warnings.push_back(std::move(warning));
    tell(stage, "working out the pressure of the start");
    const auto sites = std::make_shared<StartSites>(lattice_, std::move(body_), std::move(site_));
    result_.touching = touching_bodies(*sites);
    result_.bodies = fluid_bodies(c_, *sites, result_.touching);
    result_.fluid.pressure = start_pressure(c_, *sites, result_.bodies, result_.fluid, region_);
    result_.sites = sites;
    result_.region = std::move(region_);
    result_.inlets = inlets_.inlets();
    warn_of_openings(c_, result_.inlets, result_.fluid.position, result_.warnings);
    return std::move(result_);
  }

 private:
  std::vector<InletColumns> columns() const {
    std::vector<InletColumns> columns;
    for (std::size_t k = 0; k < c_.inlets.size(); ++k)
      columns.push_back(inlet_columns(c_, k, lattice_, solids_));
    require_apart(c_, columns);
    return columns;
  }

  // Of walls that share a site the first has it; one at rest goes before one that moves and may uncover it.
  void mark_walls() {
    for (const bool moving : {false, true})
      for (std::size_t b = 0; b < solids_.count(); ++b)
        if (solids_.moves(b) == moving) mark_wall(b);
  }

  void mark_wall(std::size_t b) {
    std::vector<std::vector<Vec3d>> covered(lattice_.parts());
    for_each_part(lattice_.parts(), [&](std::size_t part) {
      lattice_.visit_part(
          part, [&](Vec3d p) { return solids_[b].distance(p); },
          [&](const SiteIndex& first, std::int64_t count) { mark_row(b, first, count, covered[part]); });
    });
    for (const std::vector<Vec3d>& part : covered)
      for (const Vec3d& p : part) survey_.covered(p, b);
  }

  void mark_row(std::size_t b, SiteIndex s, std::int64_t count, std::vector<Vec3d>& covered) {
    std::uint8_t* const bodies = body_.data() + lattice_.linear(s);
    for (std::int64_t k = 0; k < count; ++k) {
      if (bodies[k] == 0) {
        bodies[k] = static_cast<std::uint8_t>(b + 1);
      } else if (solids_.moves(b) && !solids_.moves(bodies[k] - std::size_t{1})) {
        const Vec3d p = lattice_.position({s[0] + k, s[1], s[2]});
        if (survey_.comes_out(p, b)) covered.push_back(p);
      }
    }
  }

  // Particles of a part of the lattice.
  struct Taken {
    RegionSites sites;
    std::vector<std::size_t> site;
    std::vector<Vec3d> place;
  };

  // Parts of the lattice that threads may share, and what visits those of their sites that a region may have.
  struct Parts {
    std::size_t count;
    std::function<void(std::size_t part, const Lattice::VisitRow&)> visit;
  };

  void fill_region(std::size_t r) {
    const RegionSpec& region = c_.regions[r];
    const std::string key = "region." + std::to_string(r);
    const Solid solid = make_solid(c_, region.shapes, region.subtract, key);
    FluidParticles& out = result_.fluid;
    const std::size_t first = out.position.size();
    RegionSites sites;
    sites.in_wall.assign(c_.walls.size(), 0);
    const Parts parts = region.fill.given ? parts_to_level(r, solid) : parts_inside(solid);
    for (std::size_t from = 0; from < parts.count; from += parts_at_once) {
      std::vector<Taken> taken(std::min(parts_at_once, parts.count - from));
      for_each_part(taken.size(), [&](std::size_t k) { take(parts, from + k, taken[k]); });
      add(region, taken);
      for (const Taken& part : taken) sites.add(part.sites);
    }
    if (out.position.size() == first)
      throw InputError(c_.place_of(key) + ": key '" + key +
                       "': " + reason_without_particle(c_, region, solid, sites));
    if (!region.fill.given)
      for (std::string& warning : cut_warnings(c_, r, solid, sites))
        result_.warnings.push_back(std::move(warning));
    out.fluid.resize(out.position.size(), static_cast<std::uint8_t>(region.fluid));
    if (c_.thermal.on) out.temperature.resize(out.position.size(), region.temperature);
    region_.resize(out.position.size(), static_cast<std::uint32_t>(r));
  }

  Parts parts_inside(const Solid& solid) const {
    return {lattice_.parts(), [this, &solid](std::size_t part, const Lattice::VisitRow& visit) {
              lattice_.visit_part(
                  part, [&](Vec3d p) { return solid.distance(p); }, visit);
            }};
  }

  // The sites that a pour would fill, in the order of the lattice.
  Parts parts_to_level(std::size_t r, const Solid& without) const {
    const auto filled = std::make_shared<const std::vector<bool>>(flood({c_, lattice_, body_, r}));
    return {fluid_.rows(), [this, filled, &without](std::size_t row, const Lattice::VisitRow& visit) {
              SiteIndex s = fluid_.first_of(row);
              for (std::size_t at = lattice_.linear(s); s[0] < lattice_.count()[0]; ++s[0], ++at)
                if ((*filled)[at] && !without.subtracts(lattice_.position(s))) visit(s, 1);
            }};
  }

  void take(const Parts& parts, std::size_t number, Taken& taken) {
    taken.sites.in_wall.assign(c_.walls.size(), 0);
    parts.visit(number, [&](const SiteIndex& first, std::int64_t count) {
      SiteIndex s = first;
      for (; s[0] < first[0] + count; ++s[0]) take_site(s, taken);
    });
  }

  void take_site(const SiteIndex& s, Taken& taken) {
    if (!lattice_.in_domain(s)) return;
    const Vec3d p = lattice_.position(s);
    if (!is_free(s, p, taken.sites)) return;
    const std::optional<Vec3d> place = off_walls(p);
    if (!place) {
      ++taken.sites.without_room;
      return;
    }
    fluid_.set(s);
    taken.site.push_back(lattice_.linear(s));
    taken.place.push_back(*place);
  }

  void add(const RegionSpec& region, const std::vector<Taken>& parts) {
    FluidParticles& out = result_.fluid;
    std::vector<std::size_t> begin{out.position.size()};
    for (const Taken& part : parts) begin.push_back(begin.back() + part.site.size());
    for (std::size_t i = begin.front(); i < begin.back(); ++i) check_room(i + result_.walls.position.size());
    out.position.resize(begin.back()), out.velocity.resize(begin.back()), site_.resize(begin.back());
    for_each_part(parts.size(), [&](std::size_t part) {
      for (std::size_t k = 0; k < parts[part].site.size(); ++k) {
        const std::size_t i = begin[part] + k;
        const Vec3d place = parts[part].place[k];
        out.position[i] = region.jitter > 0 ? jittered(place, region.jitter, i) : place;
        out.velocity[i] = initial_velocity(region, out.position[i]);
        site_[i] = parts[part].site[k];
      }
    });
  }

  // Whether a site of the domain is in no wall and no earlier region; counts what it is.
  bool is_free(const SiteIndex& s, Vec3d p, RegionSites& sites) const {
    ++sites.all;
    const std::uint8_t body = body_[lattice_.linear(s)];
    const bool taken = fluid_.test(s);
    if (body != 0) ++sites.in_walls, ++sites.in_wall[body - std::size_t{1}];
    if (taken) ++sites.in_earlier_regions;
    return body == 0 && !taken && !inlets_.holds_fluid(p);
  }

  void place_walls() {
    WallFiller filler({c_, lattice_, solids_, inlets_, body_, fluid_}, survey_);
    const auto place = [&](const std::vector<bool>& company) {
      const auto room = [&] { check_room(result_.fluid.position.size() + result_.walls.position.size()); };
      filler.place(company, room, result_.walls);
    };
    std::vector<bool> at_rest;
    for (std::size_t b = 0; b < solids_.count(); ++b) at_rest.push_back(!solids_.moves(b));
    place(at_rest);
    for (std::size_t b = 0; b < solids_.count(); ++b) {
      if (!solids_.moves(b)) continue;
      std::vector<bool> alone(solids_.count(), false);
      alone[b] = true;
      place(alone);
    }
    for (std::string& warning : filler.warnings()) result_.warnings.push_back(std::move(warning));
  }

  // Where the sites are.
  std::string plane() const { return c_.dimensions == 2 ? "in the plane y = 0, " : ""; }

  // Fluid passes through those without a particle.
  void warn_of_walls() {
    const std::vector<std::uint8_t>& bodies = result_.walls.body;
    for (std::size_t b = 0; b < c_.walls.size(); ++b) {
      const bool empty = std::find(bodies.begin(), bodies.end(), b) == bodies.end();
      const std::string told = empty ? "wall '" + c_.walls[b].name +
                                           "' has no particle: its shapes hold no lattice site " + plane() +
                                           "near the inside of the domain, or other walls have them" +
                                           unit_hint(c_, c_.walls[b].shapes)
                                     : unit_warning(c_, c_.walls[b], solids_[b]);
      if (!told.empty()) result_.warnings.push_back(told);
    }
  }

  // A site, or the place just off the wall that it lies on. Fluid that is moved by more leaves the lattice,
  // and then never comes to rest in corners of walls whose faces go through sites. Nothing between two walls
  // that leave no room for a place a quarter of a spacing off both.
  std::optional<Vec3d> off_walls(Vec3d p) const {
    const double distance = solids_.distance(p);
    if (distance >= wall_room * lattice_.spacing()) return p;
    if (!moved_off(p, distance, wall_room)) return {};
    return distance < wall_gap * lattice_.spacing() ? moved_off(p, distance, wall_gap) : p;
  }

  // To a distance [spacings] off the nearest wall, where that is possible.
  std::optional<Vec3d> moved_off(Vec3d p, double distance, double wanted) const {
    const double lacking = wanted * lattice_.spacing() - distance;
    const Vec3d away = away_from([this](Vec3d q) { return solids_.distance(q); }, p,
                                 1e-4 * lattice_.spacing(), c_.dimensions == 2);
    if (!(norm(away) > 0)) return {};
    const Vec3d place = lattice_.wrapped(p + (lacking / norm(away)) * away);
    if (solids_.distance(place) < 0.99 * wanted * lattice_.spacing() || !lattice_.in_domain(place)) return {};
    return place;
  }

  // The particle's place beside its site; nearer to it where it would be in a wall or outside of the domain.
  Vec3d jittered(Vec3d site, double jitter, std::size_t particle) const {
    Vec3d offset = jitter * lattice_.spacing() * jitter_of(particle);
    if (c_.dimensions == 2) offset.y = 0;
    for (int tries = 0; tries < 20; ++tries, offset = 0.5 * offset) {
      const Vec3d p = lattice_.wrapped(site + offset);
      if (lattice_.in_domain(p) && solids_.distance(p) >= wall_room * lattice_.spacing()) return p;
    }
    return site;
  }

  // Before one more particle.
  void check_room(std::size_t particles) const {
    if (particles >= most_particles) refuse("more than 2147483647 particles");
    if (particles == 0 || particles % room_check != 0) return;
    // Arrays that grow are held twice for a moment.
    const double needed = 2 * bytes_per_particle * static_cast<double>(particles),
                 available = available_memory();
    if (needed > available)
      refuse("more than " + std::to_string(particles) + " particles need " + gigabytes(needed) +
             " of memory, " + gigabytes(available) + " are available");
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(c_.place_of("resolution.spacing") + ": key 'resolution.spacing': " + why +
                     ": allowed: a larger spacing");
  }

  const Case& c_;
  Lattice lattice_;
  WallSolids solids_;
  WallSurvey survey_;
  InletSpace inlets_;
  std::vector<std::uint8_t> body_;     // per site: 0, or index of the wall + 1
  SiteBits fluid_;                     // sites with a particle
  std::vector<std::size_t> site_;      // of each fluid particle
  std::vector<std::uint32_t> region_;  // of each fluid particle
  Filling result_;
};

}  // namespace

Filling::Filling() = default;
Filling::~Filling() = default;
Filling::Filling(Filling&&) noexcept = default;
Filling& Filling::operator=(Filling&&) noexcept = default;

Filling fill(const Case& c, const Stage& stage) { return Filler(c).run(stage); }

}  // namespace slagflow
