#include "host/run/start_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <unordered_map>

#include "host/geometry/geometry.hpp"

namespace slagflow {
namespace {

using Site = std::array<std::int64_t, 3>;

// The particles of the start by their sites.
class Sites {
 public:
  Sites(const SimulationSetup& setup, Vec3d origin) : setup_(setup) {
    const std::vector<Vec3d>& all = setup.particles.position;
    site_.reserve(all.size()), particle_.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      Site site{};
      for (int k = 0; k < 3; ++k)
        site[static_cast<std::size_t>(k)] = std::llround((all[i][k] - origin[k]) / setup.spacing - 0.5);
      site_.push_back(site), particle_.emplace(number(site), i);
    }
  }

  std::size_t count() const { return site_.size(); }
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  // The particle some sites away.
  std::size_t beside(std::size_t i, const Site& by) const {
    const Site& own = site_[i];
    const auto found = particle_.find(number({own[0] + by[0], own[1] + by[1], own[2] + by[2]}));
    return found == particle_.end() ? none : found->second;
  }

  // Particles of the same fluid in the shortest row through one along an axis.
  double across(std::size_t i) const {
    std::int64_t least = longest;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(axis == 1 && setup_.dimensions == 2)) least = std::min(least, row(i, axis));
    return static_cast<double>(least);
  }

 private:
  static constexpr std::int64_t longest = 100;

  // 21 bits an axis.
  static std::uint64_t number(const Site& site) {
    std::uint64_t all = 0;
    for (const std::int64_t place : site) all = (all << 21) | (static_cast<std::uint64_t>(place) & 0x1fffff);
    return all;
  }
  int kind(std::size_t i) const { return i < setup_.particles.fluid.size() ? setup_.particles.fluid[i] : 0; }

  std::int64_t row(std::size_t i, std::size_t axis) const {
    std::int64_t count = 1;
    for (const std::int64_t way : {-1, 1})
      for (std::int64_t step = 1; step < longest; ++step) {
        Site by{};
        by[axis] = way * step;
        const std::size_t other = beside(i, by);
        if (other == none || kind(other) != kind(i)) break;
        ++count;
      }
    return count;
  }

  const SimulationSetup& setup_;
  std::vector<Site> site_;
  std::unordered_map<std::uint64_t, std::size_t> particle_;
};

// All that hangs together with a particle.
std::vector<std::size_t> piece_of(const Sites& sites, std::size_t first, std::vector<bool>& taken) {
  std::vector<std::size_t> piece{first};
  taken[first] = true;
  for (std::size_t next = 0; next < piece.size(); ++next)
    for (std::int64_t k = 0; k < 27; ++k) {
      const std::size_t other = sites.beside(piece[next], {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1});
      if (other == Sites::none || taken[other]) continue;
      taken[other] = true;
      piece.push_back(other);
    }
  return piece;
}

// Of a sample where there are many.
double median_across(const Sites& sites, const std::vector<std::size_t>& piece) {
  constexpr std::size_t looked_at = 2000;
  std::vector<double> across;
  for (std::size_t k = 0; k < piece.size(); k += std::max<std::size_t>(1, piece.size() / looked_at))
    across.push_back(sites.across(piece[k]));
  const auto middle = across.begin() + static_cast<std::ptrdiff_t>(across.size() / 2);
  std::nth_element(across.begin(), middle, across.end());
  return *middle;
}

// The surface of a wall, looked through along its normal.
class WallLook {
 public:
  explicit WallLook(const Case& c) : solids_(c), spacing_(c.spacing) {}

  // [spacings] up to the other side, or `most`.
  double thickness(Vec3d foot, Vec3d normal, std::size_t body, double most) const {
    const double stride = 0.05 * spacing_, touch = 1e-3 * spacing_;
    for (double t = stride; t < most * spacing_;) {
      const Vec3d q = foot - t * normal;
      const double d = solids_.distance_to_company(q, body);
      if (d > touch) return t - d > touch && faces_back(q, normal, body) ? (t - d) / spacing_ : most;
      t += std::max(-d, stride);
    }
    return most;
  }
  bool open_before(Vec3d foot, Vec3d normal, std::size_t body) const {
    return solids_.distance_to_company(foot + (1e-3 * spacing_) * normal, body) >= 0;
  }

 private:
  // Not at the corner of two faces.
  bool faces_back(Vec3d p, Vec3d normal, std::size_t body) const {
    Vec3d away;
    for (int k = 0; k < 3; ++k) {
      Vec3d ahead = p, behind = p;
      ahead[k] += 1e-3 * spacing_, behind[k] -= 1e-3 * spacing_;
      away[k] = solids_.distance_to_company(ahead, body) - solids_.distance_to_company(behind, body);
    }
    return norm(away) > 0 && dot(away, normal) < -0.5 * norm(away);
  }

  WallSolids solids_;
  double spacing_;
};

void add_stl(const std::vector<ShapeSpec>& shapes, const Case& c, std::set<std::string>& lines) {
  for (const ShapeSpec& shape : shapes) {
    const StlSpec* const stl = std::get_if<StlSpec>(&shape.form);
    if (stl == nullptr) continue;
    const Extents e = make_solid(c, {shape}, {}, "").form_extents().front();
    std::array<char, 300> text{};
    std::snprintf(text.data(), text.size(), " from (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g) m", e.lower.x,
                  e.lower.y, e.lower.z, e.upper.x, e.upper.y, e.upper.z);
    lines.insert(stl->file + text.data());
  }
}

}  // namespace

std::vector<FluidPiece> fluid_pieces(const SimulationSetup& setup, Vec3d origin) {
  const Sites sites(setup, origin);
  std::vector<FluidPiece> pieces;
  std::vector<bool> taken(sites.count());
  for (std::size_t i = 0; i < sites.count(); ++i) {
    if (taken[i]) continue;
    const std::vector<std::size_t> piece = piece_of(sites, i, taken);
    pieces.push_back({piece.size(), setup.particles.position[i], median_across(sites, piece)});
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const FluidPiece& a, const FluidPiece& b) { return a.particles > b.particles; });
  return pieces;
}

namespace {

// How far is looked [spacings]; through a wall that takes up heat as far as that gets in the run.
double depth_of_interest(const SimulationSetup& setup, std::size_t body) {
  const WallThermal& wall = setup.bodies[body].thermal;
  if (wall.kind != WallHeat::semi_infinite) return ThinnestWall::thick;
  constexpr double most = 5000;
  const double diffusivity = wall.conductivity / (wall.density * wall.heat_capacity);
  const double way = 2 * std::sqrt(diffusivity * (setup.end_time - setup.start_time));
  return std::min(most, std::max(ThinnestWall::thick, way / setup.spacing));
}

}  // namespace

std::vector<ThinnestWall> wall_thicknesses(const Case& c, const SimulationSetup& setup) {
  const WallParticles& walls = setup.walls;
  std::vector<ThinnestWall> thinnest(c.walls.size());
  for (std::size_t k = 0; k < thinnest.size() && k < setup.bodies.size(); ++k)
    thinnest[k].across = depth_of_interest(setup, k);
  if (c.walls.empty() || walls.normal.size() != walls.position.size()) return thinnest;
  const WallLook look(c);
  constexpr std::size_t looked_at = 20000;
  const std::size_t stride = std::max<std::size_t>(1, walls.position.size() / looked_at);
  for (std::size_t w = 0; w < walls.position.size(); w += stride) {
    const std::size_t body = walls.body[w];
    if (body >= c.walls.size() || walls.depth[w] >= setup.spacing) continue;
    const Vec3d foot = walls.position[w] + walls.depth[w] * walls.normal[w];
    if (!look.open_before(foot, walls.normal[w], body)) continue;
    const double across = look.thickness(foot, walls.normal[w], body, depth_of_interest(setup, body));
    if (across < thinnest[body].across - 1e-3) thinnest[body] = {c.walls[body].name, across, foot};
  }
  return thinnest;
}

ThinnestWall thinnest_of(const std::vector<ThinnestWall>& walls) {
  ThinnestWall thinnest;
  for (const ThinnestWall& wall : walls)
    if (wall.across < thinnest.across - 1e-3) thinnest = wall;
  return thinnest;
}

std::vector<std::string> stl_extents(const Case& c) {
  std::set<std::string> lines;
  for (const RegionSpec& region : c.regions)
    add_stl(region.shapes, c, lines), add_stl(region.subtract, c, lines);
  for (const WallSpec& wall : c.walls) add_stl(wall.shapes, c, lines), add_stl(wall.subtract, c, lines);
  return {lines.begin(), lines.end()};
}

}  // namespace slagflow
