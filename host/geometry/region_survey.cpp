#include "host/geometry/region_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "host/case/toml_reader.hpp"

namespace slagflow {
namespace {

constexpr int samples = 48;          // along each axis, of shapes beyond the domain
constexpr double told_share = 0.02;  // of a region that is cut

std::string text_of(const Vec3d& v) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", v.x, v.y, v.z);
  return text;
}

bool counts(const Case& c, int axis) { return !(c.dimensions == 2 && axis == 1); }

bool in_domain(const Case& c, const Vec3d& p) {
  for (int k = 0; k < 3; ++k)
    if (counts(c, k) && !(p[k] >= c.domain.lower[k] && p[k] < c.domain.upper[k])) return false;
  return true;
}

bool meets_domain(const Case& c, const Extents& e) {
  for (int k = 0; k < 3; ++k)
    if (counts(c, k) && !(e.upper[k] > c.domain.lower[k] && e.lower[k] < c.domain.upper[k])) return false;
  return true;
}

// But for half a spacing.
bool within_domain(const Case& c, const Extents& e) {
  for (int k = 0; k < 3; ++k)
    if (counts(c, k) && (e.lower[k] < c.domain.lower[k] - 0.5 * c.spacing ||
                         e.upper[k] > c.domain.upper[k] + 0.5 * c.spacing))
      return false;
  return true;
}

// Whether a body goes on beyond both faces of the domain: "all of it" is meant then.
bool spans(const Case& c, const Extents& e, int axis) {
  return e.lower[axis] <= c.domain.lower[axis] && e.upper[axis] >= c.domain.upper[axis];
}

bool spans_domain(const Case& c, const Extents& e) {
  for (int k = 0; k < 3; ++k)
    if (counts(c, k) && !c.domain.periodic[static_cast<std::size_t>(k)] && spans(c, e, k)) return true;
  return false;
}

// The part of it that is meant: along axes that it spans, that in the domain.
Extents meant(const Case& c, Extents e) {
  for (int k = 0; k < 3; ++k) {
    if (!counts(c, k) || !spans(c, e, k)) continue;
    e.lower[k] = std::max(e.lower[k], c.domain.lower[k]),
    e.upper[k] = std::min(e.upper[k], c.domain.upper[k]);
  }
  return e;
}

bool finite(const Extents& e) { return std::isfinite(norm(e.lower)) && std::isfinite(norm(e.upper)); }

// How much of a body with ends lies in and outside of the domain, by samples.
struct Spread {
  double inside = 0, outside = 0;  // [m^d]

  Spread(const Case& c, const Solid& solid, const Extents& e) {
    const Vec3d cell = (1.0 / samples) * (e.upper - e.lower);
    const double volume = cell.x * cell.z * (c.dimensions == 2 ? 1 : cell.y);
    for (int x = 0; x < samples; ++x)
      for (int y = 0; y < (c.dimensions == 2 ? 1 : samples); ++y)
        for (int z = 0; z < samples; ++z) {
          Vec3d p = e.lower + Vec3d{(x + 0.5) * cell.x, (y + 0.5) * cell.y, (z + 0.5) * cell.z};
          if (c.dimensions == 2) p.y = 0;
          if (solid.contains(p)) (in_domain(c, p) ? inside : outside) += volume;
        }
  }
};

std::string allowed(const Case& c) {
  return std::string(": allowed: shapes that hold a lattice site ") +
         (c.dimensions == 2 ? "in the plane y = 0, " : "") +
         "inside the domain, outside of walls and of earlier regions";
}

std::string fullest_wall(const Case& c, const RegionSites& sites) {
  const auto most = std::max_element(sites.in_wall.begin(), sites.in_wall.end());
  return c.walls[static_cast<std::size_t>(most - sites.in_wall.begin())].name;
}

// "0.12 litres", or of a layer of two dimensions "0.12 litres per metre of width".
std::string litres(const Case& c, double volume) {
  char text[60];
  std::snprintf(text, sizeof text, "%.3g litres%s", 1000 * volume,
                c.dimensions == 2 ? " per metre of width" : "");
  return text;
}

std::string percent(double share) {
  char text[40];
  std::snprintf(text, sizeof text, share > 0.99 ? "%.4g %%" : "%.2g %%", 100 * share);
  return text;
}

std::string all_hints(const Case& c, const RegionSpec& region) {
  std::string hint = unit_hint(c, region.shapes);
  for (const WallSpec& wall : c.walls)
    if (hint.empty()) hint = unit_hint(c, wall.shapes);
  return hint;
}

// Of shapes that hold no site of the domain.
std::string reason_without_site(const Case& c, const RegionSpec& region, const Solid& solid) {
  const Extents e = solid.extents();
  const std::string reach = finite(e) ? "; it reaches " + range_of(e.lower, e.upper) : "";
  if (c.dimensions == 2 && !(e.lower.y <= 0 && e.upper.y >= 0))
    return "the region does not hold the plane y = 0 of two dimensions" + reach;
  const std::string domain = ", the domain " + range_of(c.domain.lower, c.domain.upper);
  if (!meets_domain(c, e)) return "the region lies outside the domain" + reach + domain;
  if (finite(e)) {
    const Spread spread(c, solid, e);
    if (spread.inside + spread.outside == 0 && !region.subtract.empty() &&
        Spread(c, make_solid(c, region.shapes, {}, ""), e).inside > 0)
      return "subtract takes all of the region away";
    if (spread.inside == 0 && spread.outside > 0)
      return "the region lies outside the domain" + reach + domain;
  }
  return "the region is thinner than the spacing of " + show(c.spacing) +
         " m and lies between lattice sites" + reach;
}

constexpr double small = 0.04, enough = 0.2;  // of the domain

// Its largest side over the domain's; 0 where it does not meet the domain, or is larger.
double fit(const Case& c, const Extents& e) {
  if (!meets_domain(c, e)) return 0;
  double size = 0, room = 0;
  for (int k = 0; k < 3; ++k) {
    if (!counts(c, k)) continue;
    const double side = e.upper[k] - e.lower[k], across = c.domain.upper[k] - c.domain.lower[k];
    if (side > 2 * across) return 0;
    size = std::max(size, side), room = std::max(room, across);
  }
  return size / room;
}

// The scale in which a file fits the domain, with "; " before, or empty.
std::string fitting_scale(const Case& c, const StlSpec& stl, const Extents& e) {
  for (const DrawingUnit& unit : drawing_units) {
    const double factor = unit.scale / stl.scale;
    const Extents scaled{stl.translate + factor * (e.lower - stl.translate),
                         stl.translate + factor * (e.upper - stl.translate)};
    if (std::abs(factor - 1) < 0.01 || fit(c, scaled) < enough) continue;
    return "; '" + std::filesystem::path(stl.file).filename().string() + "' reaches " +
           range_of(e.lower, e.upper) + ", the domain " + range_of(c.domain.lower, c.domain.upper) +
           ": with scale = " + show(unit.scale) + " it would fit; was it drawn in " + unit.name + "?";
  }
  return "";
}

// Larger than the domain along every axis manyfold, or hardly more than a speck in it.
bool far_from_fitting(const Case& c, const Extents& e) {
  constexpr double manyfold = 3, speck = 4;  // of the domain; [spacings]
  bool larger = true;
  double size = 0;
  for (int k = 0; k < 3; ++k) {
    if (!counts(c, k)) continue;
    const double side = e.upper[k] - e.lower[k];
    larger = larger && side > manyfold * (c.domain.upper[k] - c.domain.lower[k]);
    size = std::max(size, side);
  }
  return larger || size < speck * c.spacing;
}

}  // namespace

std::string range_of(const Vec3d& lower, const Vec3d& upper) {
  return "from " + text_of(lower) + " to " + text_of(upper) + " m";
}

std::string reason_without_particle(const Case& c, const RegionSpec& region, const Solid& solid,
                                    const RegionSites& sites) {
  const std::string all = std::to_string(sites.all) + " lattice sites in the domain";
  std::string reason;
  if (sites.all == 0)
    reason = reason_without_site(c, region, solid);
  else if (sites.in_earlier_regions == sites.all)
    reason = "earlier regions have all of its " + all;
  else if (sites.in_earlier_regions == 0 && sites.in_walls > 0)
    reason = "the region lies inside walls, which have all of its " + all + "; most are in wall '" +
             fullest_wall(c, sites) + "'";
  else if (sites.in_walls == 0 && sites.in_earlier_regions == 0)
    reason = "walls leave no room, less than half a spacing, at its " + all;
  else
    reason = "walls and earlier regions have all of its " + all;
  return "no particle: " + reason + all_hints(c, region) + allowed(c);
}

std::vector<std::string> cut_warnings(const Case& c, std::size_t index, const Solid& solid,
                                      const RegionSites& sites) {
  std::vector<std::string> warnings;
  const RegionSpec& region = c.regions[index];
  const std::string name = "region " + std::to_string(index);
  const Extents whole = solid.extents(), e = meant(c, whole);
  const double share = static_cast<double>(sites.in_walls) / static_cast<double>(sites.all);
  if (share > told_share && !spans_domain(c, whole))
    warnings.push_back(name + " lies partly in walls: " + percent(share) + " of it, " +
                       litres(c, std::pow(c.spacing, c.dimensions) * static_cast<double>(sites.in_walls)) +
                       ", get no fluid, most of that in wall '" + fullest_wall(c, sites) +
                       "'; are its shapes where they should be? What is meant to be cut goes into region." +
                       std::to_string(index) + ".subtract" + all_hints(c, region));
  if (!finite(e) || within_domain(c, e)) return warnings;
  const Spread spread(c, solid, e);
  const double outside = spread.outside / (spread.inside + spread.outside);
  if (spread.outside > 0 && outside > told_share)
    warnings.push_back(name + " lies partly outside the domain: " + percent(outside) + " of it, " +
                       litres(c, spread.outside) + ", are cut off; it reaches " + range_of(e.lower, e.upper) +
                       ", the domain " + range_of(c.domain.lower, c.domain.upper) +
                       ": a larger domain, or smaller shapes" + unit_hint(c, region.shapes));
  return warnings;
}

std::string unit_hint(const Case& c, const std::vector<ShapeSpec>& shapes) {
  for (const ShapeSpec& shape : shapes) {
    const auto* const stl = std::get_if<StlSpec>(&shape.form);
    if (!stl) continue;
    const Extents e = make_form({*stl, false})->extents();
    if (fit(c, e) > small && !far_from_fitting(c, e)) continue;
    std::string told = fitting_scale(c, *stl, e);
    if (!told.empty()) return told;
  }
  return "";
}

std::string unit_warning(const Case& c, const WallSpec& wall, const Solid& solid) {
  const std::vector<Extents> extents = solid.form_extents();
  auto e = extents.begin();
  for (const std::vector<ShapeSpec>* const shapes : {&wall.shapes, &wall.subtract})
    for (const ShapeSpec& shape : *shapes) {
      const Extents& here = *e++;
      const auto* const stl = std::get_if<StlSpec>(&shape.form);
      const std::string told = stl && far_from_fitting(c, here) ? fitting_scale(c, *stl, here) : "";
      if (!told.empty()) return "wall '" + wall.name + "' does not suit the domain" + told;
    }
  return "";
}

}  // namespace slagflow
