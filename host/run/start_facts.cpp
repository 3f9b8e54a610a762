#include "host/run/start_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "host/geometry/geometry.hpp"

namespace slagflow {
namespace {

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
