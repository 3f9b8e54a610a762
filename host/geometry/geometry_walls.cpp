#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/error.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {
namespace {

std::vector<Shape> make_shapes(const Case& c, const std::vector<ShapeSpec>& specs, const std::string& key) {
  std::vector<Shape> shapes;
  for (const ShapeSpec& spec : specs) {
    const std::string entry = key + "." + std::to_string(shapes.size());
    try {
      shapes.emplace_back(spec);
    } catch (const InputError& e) {
      throw InputError(c.place_of(entry) + ": key '" + entry + "': " + e.what());
    }
  }
  return shapes;
}

}  // namespace

Solid make_solid(const Case& c, const std::vector<ShapeSpec>& shapes, const std::vector<ShapeSpec>& subtract,
                 const std::string& key) {
  return Solid(make_shapes(c, shapes, key + ".shapes"), make_shapes(c, subtract, key + ".subtract"));
}

WallSolids::WallSolids(const Case& c) {
  for (const WallSpec& wall : c.walls) {
    moves_.push_back(wall.motion.moves());
    solids_.push_back(make_solid(c, wall.shapes, wall.subtract, "wall." + std::to_string(solids_.size())));
  }
}

double WallSolids::distance(Vec3d p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids_) nearest = std::min(nearest, solid.distance(p));
  return nearest;
}

double WallSolids::distance_to_company(Vec3d p, std::size_t body) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < count(); ++other)
    if (in_company(body, other)) nearest = std::min(nearest, solids_[other].distance(p));
  return nearest;
}

WallFaces::WallFaces(const Case& c, const Lattice& lattice, const WallSolids& solids)
    : solids_(solids),
      domain_(c.domain),
      gravity_(c.gravity),
      spacing_(c.spacing),
      reach_(lattice.layers() * c.spacing) {
  if (c.dimensions == 2) domain_.lower.y = -c.spacing, domain_.upper.y = c.spacing;
}

Vec3d WallFaces::wrapped(Vec3d p) const {
  for (int k = 0; k < 3; ++k) {
    const double lower = domain_.lower[k], extent = domain_.upper[k] - lower;
    if (domain_.periodic[static_cast<std::size_t>(k)]) p[k] -= extent * std::floor((p[k] - lower) / extent);
  }
  return p;
}

// A point just outside of the surface, brought into the domain, must be in no wall. So faces beyond the
// domain do not count, and a wall cut off by a periodic face goes on behind it.
bool WallFaces::borders_open(const Foot& foot, std::size_t body) const {
  const double nudge = 1e-3 * spacing_;
  Vec3d p = wrapped(foot.point + nudge * foot.normal);
  for (int k = 0; k < 3; ++k)
    if (!domain_.periodic[static_cast<std::size_t>(k)])
      p[k] = std::clamp(p[k], domain_.lower[k] + nudge, domain_.upper[k] - nudge);
  return solids_.distance_to_company(p, body) >= 0;
}

std::vector<Foot> WallFaces::feet_by_depth(Vec3d p, std::size_t body) const {
  const double tie = 1e-6 * spacing_;
  std::vector<Foot> feet;
  // A site on a face counts as inside by a nudge; rounding may put it outside, where it would be told another
  // face of the wall.
  const bool outside = solids_[body].distance(p) > 0;
  solids_[body].feet(outside ? p + tie * tie_direction : p, 2 * reach_, feet);
  if (feet.empty()) solids_[body].feet(p + tie * tie_direction, 2 * reach_, feet);
  // Of forms that tell the nearest of their faces however far it is.
  const auto far = [&](const Foot& f) { return dot(f.point - p, f.normal) > 2 * reach_; };
  feet.erase(std::remove_if(feet.begin(), feet.end(), far), feet.end());
  const auto steps = [&](const Foot& f) { return std::round(dot(f.point - p, f.normal) / tie); };
  std::stable_sort(feet.begin(), feet.end(), [&](const Foot& a, const Foot& b) {
    const double difference = steps(a) - steps(b);
    return difference != 0 ? difference < 0 : dot(a.normal, gravity_) < dot(b.normal, gravity_);
  });
  return feet;
}

WallFace WallFaces::of(Vec3d p, std::size_t body, Vec3d open) const {
  const std::vector<Foot> feet = feet_by_depth(p, body);
  const double limit = std::min(reach_, norm(open - p) + 1e-6 * spacing_);
  const auto depth = [&](const Foot& f) { return dot(f.point - p, f.normal); };
  auto chosen = std::find_if(feet.begin(), feet.end(),
                             [&](const Foot& f) { return depth(f) <= limit && borders_open(f, body); });
  // A face on which two parts of a wall touch does not count: the open must lie beyond its plane, or on it
  // where no other face fits, as a site of the lattice may.
  const double tie = 1e-6 * spacing_;
  for (const double beyond : {tie, -tie})
    if (chosen == feet.end())
      chosen = std::find_if(feet.begin(), feet.end(),
                            [&](const Foot& f) { return dot(open - f.point, f.normal) > beyond; });
  if (chosen == feet.end())
    chosen = std::find_if(feet.begin(), feet.end(), [&](const Foot& f) { return borders_open(f, body); });
  WallFace face = chosen != feet.end()
                      ? WallFace{std::max(depth(*chosen), 1e-3 * spacing_), chosen->normal, 0, {}}
                      : towards(p, body, open);
  if (face.depth > 0) add_back(p, body, feet, face);
  return face;
}

// Where no face fits, as behind steps smaller than a spacing or where a periodic face cuts a wall: up to
// where the way to the open site leaves the walls.
WallFace WallFaces::towards(Vec3d p, std::size_t body, Vec3d open) const {
  const double length = norm(open - p);
  if (!(length > 0)) return {};
  const Vec3d way = (open - p) * (1 / length);
  double inside = 0, outside = length;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (inside + outside);
    (solids_.distance_to_company(wrapped(p + middle * way), body) < 0 ? inside : outside) = middle;
  }
  return {std::max(outside, 1e-3 * spacing_), way, 0, {}};
}

void WallFaces::add_back(Vec3d p, std::size_t body, const std::vector<Foot>& feet, WallFace& face) const {
  for (const Foot& foot : feet) {
    const double depth = dot(foot.point - p, foot.normal);
    constexpr double opposite = -0.9;
    if (depth > reach_ || dot(foot.normal, face.normal) > opposite || !borders_open(foot, body)) continue;
    face.back_depth = std::max(depth, 1e-3 * spacing_);
    face.back_normal = foot.normal;
    return;
  }
}

}  // namespace slagflow
