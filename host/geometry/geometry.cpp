#include "host/geometry/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "backend/error.hpp"
#include "host/geometry/fill_level.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/region_fields.hpp"
#include "host/geometry/region_survey.hpp"
#include "host/geometry/start_pressure.hpp"
#include "host/geometry/wall_survey.hpp"

namespace slagflow {
namespace {

constexpr double wall_room = 0.25;         // [spacings] that fluid needs before a wall at the start
constexpr double wall_gap = 0.02;          // [spacings] that fluid keeps from a wall at the start
constexpr double off_lattice = 0.05;       // [spacings] that a face may lie beside its place
constexpr std::size_t faces_told = 3;      // of a wall, that lie beside theirs; of more the number
constexpr double bytes_per_particle = 89;  // position, normals, depths, index of a wall particle
constexpr std::size_t most_particles = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t room_check = 1 << 20;  // particles between looks at the memory

class Filler {
 public:
  explicit Filler(const Case& c)
      : c_(c), lattice_(c), solids_(c), survey_(c, lattice_, solids_), inlets_(c, columns()) {
    steps_ = steps_by_length();
    body_.assign(lattice_.size(), 0);
    flags_.assign(lattice_.size(), 0);
  }

  Filling run() {
    mark_walls();
    for (std::size_t r = 0; r < c_.regions.size(); ++r) fill_region(r);
    place_walls([&](std::size_t body) { return !solids_.moves(body); });
    for (std::size_t b = 0; b < solids_.count(); ++b)
      if (solids_.moves(b)) place_walls([&](std::size_t body) { return body == b; });
    warn_of_more_faces();
    warn_of_walls();
    for (std::string& warning : survey_.warnings()) result_.warnings.push_back(std::move(warning));
    const auto sites = std::make_shared<StartSites>(lattice_, std::move(body_), std::move(site_));
    result_.fluid.pressure = start_pressure(c_, *sites, result_.fluid, region_);
    result_.sites = sites;
    result_.region = std::move(region_);
    result_.inlets = inlets_.inlets();
    warn_of_openings(c_, result_.inlets, result_.fluid.position, result_.warnings);
    return std::move(result_);
  }

 private:
  // Bits of flags_. open << (axis + 1): within the layers of an open site, along this axis and those before.
  static constexpr int fluid = 1, open = 2, sees_open = open << 3;

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
    lattice_.visit_inside([&](Vec3d p) { return solids_[b].distance(p); },
                          [&](const SiteIndex& s, Vec3d p) {
                            std::uint8_t& body = body_[lattice_.linear(s)];
                            if (body == 0)
                              body = static_cast<std::uint8_t>(b + 1);
                            else if (solids_.moves(b) && !solids_.moves(body - std::size_t{1}))
                              survey_.covered(p, b);
                          });
  }

  void fill_region(std::size_t r) {
    const RegionSpec& region = c_.regions[r];
    const std::string key = "region." + std::to_string(r);
    const Solid solid = make_solid(c_, region.shapes, region.subtract, key);
    FluidParticles& out = result_.fluid;
    const std::size_t first = out.position.size();
    RegionSites sites;
    sites.in_wall.assign(c_.walls.size(), 0);
    const auto take = [&](const SiteIndex& s, Vec3d p) { take_site(region, s, p, sites); };
    if (region.fill.given)
      fill_to_level(r, solid, take);
    else
      lattice_.visit_inside([&](Vec3d p) { return solid.distance(p); }, take);
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

  void take_site(const RegionSpec& region, const SiteIndex& s, Vec3d p, RegionSites& sites) {
    if (!is_free(s, sites)) return;
    const std::optional<Vec3d> place = off_walls(p);
    if (!place) {
      ++sites.without_room;
      return;
    }
    FluidParticles& out = result_.fluid;
    flags_[lattice_.linear(s)] |= fluid;
    check_room();
    out.position.push_back(region.jitter > 0 ? jittered(*place, region.jitter) : *place);
    out.velocity.push_back(initial_velocity(region, out.position.back()));
    site_.push_back(lattice_.linear(s));
  }

  // The sites that a pour would fill, in the order of the lattice.
  template <class Take>
  void fill_to_level(std::size_t r, const Solid& without, const Take& take) {
    const std::vector<bool> filled = flood({c_, lattice_, body_, r});
    for_all_sites([&](const SiteIndex& s) {
      const Vec3d p = lattice_.position(s);
      if (filled[lattice_.linear(s)] && !without.subtracts(p)) take(s, p);
    });
  }

  // Whether a site in the domain is in no wall and no earlier region; counts what it is.
  bool is_free(const SiteIndex& s, RegionSites& sites) const {
    if (!lattice_.in_domain(s)) return false;
    ++sites.all;
    const std::size_t at = lattice_.linear(s);
    if (body_[at] != 0) ++sites.in_walls, ++sites.in_wall[body_[at] - std::size_t{1}];
    if (flags_[at] & fluid) ++sites.in_earlier_regions;
    return body_[at] == 0 && !(flags_[at] & fluid) && !inlets_.holds_fluid(lattice_.position(s));
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
  Vec3d jittered(Vec3d site, double jitter) const {
    Vec3d offset = jitter * lattice_.spacing() * jitter_of(result_.fluid.position.size());
    if (c_.dimensions == 2) offset.y = 0;
    for (int tries = 0; tries < 20; ++tries, offset = 0.5 * offset) {
      const Vec3d p = lattice_.wrapped(site + offset);
      if (lattice_.in_domain(p) && solids_.distance(p) >= wall_room * lattice_.spacing()) return p;
    }
    return site;
  }

  template <class Visit>
  void for_all_sites(const Visit& visit) const {
    const SiteIndex& n = lattice_.count();
    SiteIndex s{};
    for (s[2] = 0; s[2] < n[2]; ++s[2])
      for (s[1] = 0; s[1] < n[1]; ++s[1])
        for (s[0] = 0; s[0] < n[0]; ++s[0]) visit(s);
  }

  // Marks what is open when only the walls of the company are there.
  template <class Company>
  void mark_open(const Company& company) {
    for_all_sites([&](const SiteIndex& s) {
      const std::size_t at = lattice_.linear(s);
      flags_[at] &= fluid;
      if ((body_[at] == 0 || !company(body_[at] - std::size_t{1})) && lattice_.in_domain(s))
        flags_[at] |= open;
    });
    for (int axis = 0; axis < 3; ++axis) widen_open(axis);
  }

  // Carries the bit of the axis before on to all sites within the layers along this axis.
  void widen_open(int axis) {
    const auto k = static_cast<std::size_t>(axis);
    const int from = open << axis, to = open << (axis + 1);
    const std::int64_t layers = lattice_.layers(), n = lattice_.count()[k];
    const std::int64_t wrap = lattice_.periodic(axis) ? layers : 0;
    for_all_sites([&](const SiteIndex& start) {
      if (start[k] != 0) return;
      for (const std::int64_t way : {1, -1}) {
        std::int64_t since = layers + 1;  // steps since the last open site
        for (std::int64_t step = -wrap; step < n; ++step) {
          SiteIndex s = start;
          lattice_.move(s, axis, way > 0 ? step : n - 1 - step);
          std::uint8_t& flags = flags_[lattice_.linear(s)];
          since = (flags & from) ? 0 : since + 1;
          if (since <= layers) flags = static_cast<std::uint8_t>(flags | to);
        }
      }
    });
  }

  // All steps within the layers, short ones first.
  std::vector<SiteIndex> steps_by_length() const {
    const std::int64_t n = lattice_.layers();
    std::vector<SiteIndex> steps;
    for (std::int64_t z = -n; z <= n; ++z)
      for (std::int64_t y = -n; y <= n; ++y)
        for (std::int64_t x = -n; x <= n; ++x) steps.push_back({x, y, z});
    const auto square_of = [](const SiteIndex& s) { return s[0] * s[0] + s[1] * s[1] + s[2] * s[2]; };
    std::stable_sort(steps.begin(), steps.end(),
                     [&](const SiteIndex& a, const SiteIndex& b) { return square_of(a) < square_of(b); });
    return steps;
  }

  // Position of the nearest open site; a wall site that is placed has one within its layers.
  Vec3d nearest_open(const SiteIndex& site, Vec3d p) const {
    for (const SiteIndex& step : steps_) {
      SiteIndex s = site;
      bool there = true;
      for (int axis = 0; axis < 3; ++axis)
        there = lattice_.move(s, axis, step[static_cast<std::size_t>(axis)]) && there;
      if (there && (flags_[lattice_.linear(s)] & open))
        return p + lattice_.spacing() * Vec3d{static_cast<double>(step[0]), static_cast<double>(step[1]),
                                              static_cast<double>(step[2])};
    }
    return p;
  }

  // Places the particles of a company: the walls at rest, or one that moves.
  template <class Company>
  void place_walls(const Company& company) {
    mark_open(company);
    const WallFaces faces(c_, lattice_, solids_);
    WallParticles& out = result_.walls;
    for_all_sites([&](const SiteIndex& s) {
      const std::size_t at = lattice_.linear(s);
      if (body_[at] == 0 || !(flags_[at] & sees_open) || !company(body_[at] - std::size_t{1})) return;
      const auto body = static_cast<std::uint8_t>(body_[at] - 1);
      const Vec3d p = lattice_.position(s);
      if (inlets_.holds_wall(p)) return;
      const WallFace face = faces.of(p, body, nearest_open(s, p));
      if (face.depth == 0) return survey_.dropped(p, body);
      check_room();
      out.position.push_back(p);
      out.normal.push_back(face.normal);
      out.depth.push_back(face.depth);
      out.back_normal.push_back(face.back_normal);
      out.back_depth.push_back(face.back_depth);
      out.body.push_back(body);
      check_face(s, p, face);
      survey_.placed(p, body, face);
    });
  }

  // Warns of a planar face that borders the fluid but does not lie midway between two layers of sites.
  void check_face(const SiteIndex& s, Vec3d p, const WallFace& face) {
    const double depth = face.depth / lattice_.spacing();
    if (depth > 1 || std::abs(depth - 0.5) <= off_lattice) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(face.normal[axis]) < 1 - 1e-9) continue;
      const int sign = face.normal[axis] > 0 ? 1 : -1;
      const double coordinate = p[axis] + face.depth * face.normal[axis];
      if (!fluid_beyond(s, axis, sign)) return;
      const std::size_t body = body_[lattice_.linear(s)] - std::size_t{1};
      if (!is_plane(p + face.depth * face.normal, axis, body)) return;
      const long rounded = std::lround(1000 * coordinate / lattice_.spacing());
      if (!warned_.emplace(body, axis, sign, rounded).second || ++faces_off_[body] > faces_told) return;
      char text[160];
      std::snprintf(text, sizeof text, "the face %c = %.6g m lies %.2f spacings off the lattice", "xyz"[axis],
                    coordinate, std::abs(depth - 0.5));
      result_.warnings.push_back("wall '" + c_.walls[body].name + "': " + text +
                                 "; faces that border the fluid should be a whole number of spacings from "
                                 "resolution.origin");
    }
  }

  // Whether the walls have a face there, half a spacing wide and more, across an axis: not so at the pole of
  // a sphere, nor where a wall particle counts as below the plane of a face that does not reach so far.
  bool is_plane(Vec3d foot, int axis, std::size_t body) const {
    const auto on_face = [&](Vec3d q) {
      return std::abs(solids_.distance_to_company(lattice_.wrapped(q), body)) < 1e-3 * lattice_.spacing();
    };
    if (!on_face(foot)) return false;
    for (int across = 0; across < 3; ++across) {
      if (across == axis || (across == 1 && c_.dimensions == 2)) continue;
      Vec3d one = foot, other = foot;
      one[across] -= 0.5 * lattice_.spacing(), other[across] += 0.5 * lattice_.spacing();
      if (!on_face(one) && !on_face(other)) return false;
    }
    return true;
  }

  void warn_of_more_faces() {
    for (const auto& [body, faces] : faces_off_)
      if (faces > faces_told)
        result_.warnings.push_back(
            "wall '" + c_.walls[body].name +
            "': faces off the lattice besides these: " + std::to_string(faces - faces_told));
  }

  bool fluid_beyond(SiteIndex s, int axis, int sign) const {
    for (int step = 0; step < 2; ++step)
      if (lattice_.move(s, axis, sign) && (flags_[lattice_.linear(s)] & fluid)) return true;
    return false;
  }

  void check_room() const {
    const std::size_t particles = result_.fluid.position.size() + result_.walls.position.size();
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
  std::vector<std::uint8_t> flags_;    // per site
  std::vector<std::size_t> site_;      // of each fluid particle
  std::vector<std::uint32_t> region_;  // of each fluid particle
  std::set<std::tuple<std::size_t, int, int, long>> warned_;
  std::map<std::size_t, std::size_t> faces_off_;  // of each wall: off the lattice
  std::vector<SiteIndex> steps_;
  Filling result_;
};

}  // namespace

Filling::Filling() = default;
Filling::~Filling() = default;
Filling::Filling(Filling&&) noexcept = default;
Filling& Filling::operator=(Filling&&) noexcept = default;

Filling fill(const Case& c) { return Filler(c).run(); }

}  // namespace slagflow
