#include "host/geometry/inlets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "backend/error.hpp"
#include "fluid/constants.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/inlet_face.hpp"
#include "host/geometry/inlet_profile.hpp"

namespace slagflow {
namespace {

constexpr double nearest_wall = 0.25;  // [spacings] that a column keeps from walls

bool along_axis(Vec3d v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > (1 - 1e-9) * norm(v);
}

// Places over the face and the area of each.
struct Sites {
  std::vector<std::array<double, 2>> place;
  double area = 0;
};

// Evenly between the edges.
Sites rectangle_sites(const Case& c, const InletOutline& face) {
  const auto along = [&](double half) { return std::max(1L, std::lround(2 * half / c.spacing)); };
  const long na = c.dimensions == 2 ? 1 : along(face.half_a), nb = along(face.half_b);
  Sites sites;
  for (long j = 0; j < nb; ++j)
    for (long i = 0; i < na; ++i)
      sites.place.push_back(
          {(2 * (static_cast<double>(i) + 0.5) / static_cast<double>(na) - 1) *
               (c.dimensions == 2 ? 0 : face.half_a),
           (2 * (static_cast<double>(j) + 0.5) / static_cast<double>(nb) - 1) * face.half_b});
  sites.area = face.area / static_cast<double>(na * nb);
  return sites;
}

// A square grid with a point at (a, b).
std::vector<std::array<double, 2>> grid_sites(const InletOutline& face, double a, double b, double spacing) {
  std::vector<std::array<double, 2>> places;
  const auto first = [&](double at, double half) { return at - spacing * std::ceil((at + half) / spacing); };
  for (double y = first(b, face.half_b); y <= face.half_b + spacing; y += spacing)
    for (double x = first(a, face.half_a); x <= face.half_a + spacing; x += spacing)
      if (face.holds(x, y)) places.push_back({x, y});
  return places;
}

// On the lattice where the face lies along it; else so that the number comes nearest to the area.
Sites grid_sites(const Case& c, const InletOutline& face, const Lattice& lattice) {
  const double dx = c.spacing, wanted = face.area / (dx * dx);
  const Vec3d site = lattice.position({0, 0, 0});
  Sites sites;
  if (along_axis(face.frame.normal) && along_axis(face.frame.v)) {
    sites.place = grid_sites(face, face.frame.a(site), face.frame.b(site), dx);
  } else {
    double best = std::numeric_limits<double>::infinity();
    for (const double phase : {0.0, 0.5}) {
      auto places = grid_sites(face, phase * dx, phase * dx, dx);
      const double off = std::abs(static_cast<double>(places.size()) - wanted);
      if (off < best) best = off, sites.place = std::move(places);
    }
  }
  sites.area = sites.place.empty() ? 0 : face.area / static_cast<double>(sites.place.size());
  return sites;
}

constexpr double fastest_feed = 1e5;  // [m/s]

struct Feed {
  const char *key, *unit, *others;
};
constexpr std::array<Feed, 3> feeds{{{"velocity", "m/s", "m/min or mm/s"},
                                     {"volume_flow", "m^3/s", "l/s, l/min or m^3/h"},
                                     {"mass_flow", "kg/s", "kg/min, kg/h or t/h"}}};

double fastest_flow(const InletSpec& spec) {
  double most = spec.rows.empty() ? spec.value : 0;
  for (const auto& row : spec.rows) most = std::max(most, row[1]);
  return most;
}

// [m/s] that a unit of what is given makes over an area.
double speed_of_unit(const Case& c, const InletSpec& spec, double area) {
  const double density = c.fluids[static_cast<std::size_t>(spec.fluid)].density;
  switch (spec.feed) {
    case InletFeed::velocity:
      return 1;
    case InletFeed::volume_flow:
      return 1 / area;
    default:
      return 1 / (density * area);
  }
}

// Speed over its mean, of a place over the face.
std::function<double(double, double)> shares(const Case& c, const InletSpec& spec, const InletOutline& face,
                                             double mean) {
  if (spec.profile == InletProfile::plug || !(mean > 0)) return [](double, double) { return 1.0; };
  const Rheology law = c.fluids[static_cast<std::size_t>(spec.fluid)].law();
  if (spec.face == InletFace::rectangle) {
    const bool over_b = c.dimensions == 2 || face.half_b <= face.half_a;
    const SpeedShare share = developed_slot(law, 2 * (over_b ? face.half_b : face.half_a), mean);
    return [share, over_b](double a, double b) { return share(over_b ? b : a); };
  }
  const SpeedShare share = spec.face == InletFace::annulus
                               ? developed_annulus(law, spec.inner_radius, spec.radius, mean)
                               : developed_pipe(law, spec.radius, mean);
  return [share](double a, double b) { return share(std::sqrt(a * a + b * b)); };
}

double shorter_way(const Case& c, const InletSpec& spec, const InletOutline& face) {
  if (c.dimensions == 2) return 2 * face.half_b;
  if (spec.face == InletFace::annulus) return spec.radius - spec.inner_radius;
  return 2 * std::min(face.half_a, face.half_b);
}

bool in_domain(const Case& c, const Lattice& lattice, Vec3d p) {
  const Vec3d w = lattice.wrapped(p);
  for (int k = 0; k < 3; ++k)
    if (!(k == 1 && c.dimensions == 2) && !(w[k] >= c.domain.lower[k] && w[k] <= c.domain.upper[k]))
      return false;
  return true;
}

}  // namespace

namespace {

// Ways over the face in which the bundle ends at a column: none of its columns is a spacing further.
std::vector<Vec3d> ends(const Case& c, const FaceFrame& frame, const std::vector<Vec3d>& columns,
                        Vec3d here) {
  std::vector<Vec3d> open;
  for (const Vec3d& way : {frame.u, -frame.u, frame.v, -frame.v}) {
    if (c.dimensions == 2 && std::abs(way.y) > 0.5) continue;
    const auto beside = [&](const Vec3d& p) {
      const Vec3d d = p - here;
      return dot(d, way) > 0.5 * c.spacing && norm(d) < 1.5 * c.spacing &&
             norm(d - dot(d, way) * way) < 0.5 * c.spacing;
    };
    if (std::none_of(columns.begin(), columns.end(), beside)) open.push_back(way);
  }
  return open;
}

// Of a column the nearest end of the bundle beyond which, behind the face, no wall is.
std::vector<InletColumns::Side> sides_of(const Case& c, const FaceFrame& frame,
                                         const std::vector<Vec3d>& columns, double stride,
                                         const WallSolids& walls) {
  struct End {
    Vec3d place, way;
  };
  std::vector<End> all;
  for (const Vec3d& here : columns)
    for (const Vec3d& way : ends(c, frame, columns, here))
      if (walls.distance(here + c.spacing * way - 2 * stride * frame.normal) > 0) all.push_back({here, way});
  std::vector<InletColumns::Side> sides(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (const End& end : all) {
      const Vec3d d = end.place - columns[k];
      const double depth = dot(d, end.way) + 0.5 * c.spacing;
      if (depth <= 0 || norm(d - dot(d, end.way) * end.way) > 0.75 * c.spacing) continue;
      if (sides[k].depth == 0 || depth < sides[k].depth) sides[k] = {end.way, depth};
    }
  return sides;
}

// The sites of a face and its area for each; throws InputError where they do not make up its area.
Sites sites_of(const Case& c, std::size_t inlet, const InletOutline& face, const Lattice& lattice) {
  Sites sites =
      c.inlets[inlet].face == InletFace::rectangle ? rectangle_sites(c, face) : grid_sites(c, face, lattice);
  if (sites.place.empty())
    refuse_inlet(c, inlet, "",
                 "its face holds no particle: allowed: a larger face or a smaller resolution.spacing" +
                     face.unit_hint);
  const double ratio = std::pow(c.spacing, c.dimensions) / sites.area / c.spacing;
  if (!(ratio > 0.6 && ratio < 1.6))
    refuse_inlet(
        c, inlet, "",
        "its face of " + show(face.area) + (c.dimensions == 2 ? " m" : " m^2") + " holds " +
            std::to_string(sites.place.size()) +
            " particles, too few for its size: allowed: a larger face or a smaller resolution.spacing" +
            face.unit_hint);
  return sites;
}

// Leaves the sites before which no wall stands, and places their columns.
struct Surroundings {
  const Lattice& lattice;
  const WallSolids& walls;
};
void open_columns(const Case& c, std::size_t inlet, const InletOutline& face, const Surroundings& around,
                  Sites& sites, InletColumns& columns) {
  const Lattice& lattice = around.lattice;
  std::vector<std::array<double, 2>> open;
  for (const auto& [a, b] : sites.place) {
    const Vec3d origin = face.frame.at(a, b), first = origin + 0.5 * columns.stride * columns.normal;
    if (!in_domain(c, lattice, first))
      refuse_inlet(
          c, inlet, c.inlets[inlet].face == InletFace::stl ? "file" : "center",
          "fluid would come in outside the domain: allowed: a face in it or on its boundary, the normal "
          "inwards" +
              face.unit_hint);
    if (around.walls.distance(lattice.wrapped(first)) < nearest_wall * c.spacing) {
      ++columns.blocked;
      continue;
    }
    open.push_back({a, b}), columns.origin.push_back(origin);
  }
  if (open.empty())
    refuse_inlet(c, inlet, "",
                 "walls stand before all of its face: allowed: a face that looks into the open");
  sites.place = std::move(open);
}

// Speeds of columns over their mean.
std::vector<double> column_shares(const Case& c, std::size_t inlet, const InletOutline& face,
                                  const Sites& open, double area) {
  const InletSpec& spec = c.inlets[inlet];
  const double mean = fastest_flow(spec) * speed_of_unit(c, spec, area);
  if (!(mean > 0)) refuse_inlet(c, inlet, "", "feeds nothing: allowed: a flow above 0");
  if (mean > fastest_feed)
    refuse_inlet(c, inlet, feed_key(spec),
                 feed_text(c, spec, area) + ": allowed: up to " + show(fastest_feed) +
                     " m/s, a tenth of the largest numerics.sound_speed; is it meant in " +
                     feeds[static_cast<std::size_t>(spec.feed)].others + "?");
  const auto share = shares(c, spec, face, mean);
  std::vector<double> result;
  double sum = 0;
  for (const auto& [a, b] : open.place) {
    result.push_back(std::max(share(a, b), 0.0));
    sum += result.back();
  }
  if (!(sum > 0 && std::isfinite(sum)))
    refuse_inlet(c, inlet, "profile", "value \"developed\" cannot be computed for this fluid: allowed: plug");
  for (double& s : result) s *= static_cast<double>(result.size()) / sum;
  return result;
}

}  // namespace

InletColumns inlet_columns(const Case& c, std::size_t inlet, const Lattice& lattice,
                           const WallSolids& walls) {
  const InletOutline face = face_of(c, inlet);
  Sites sites = sites_of(c, inlet, face, lattice);
  InletColumns columns;
  columns.normal = face.frame.normal;
  columns.stride = std::pow(c.spacing, c.dimensions) / sites.area;
  columns.across = shorter_way(c, c.inlets[inlet], face);
  open_columns(c, inlet, face, {lattice, walls}, sites, columns);
  columns.area = sites.area * static_cast<double>(sites.place.size());
  columns.side = sides_of(c, face.frame, columns.origin, columns.stride, walls);
  columns.share = column_shares(c, inlet, face, sites, columns.area);
  return columns;
}

const char* feed_key(const InletSpec& spec) { return feeds[static_cast<std::size_t>(spec.feed)].key; }

std::string feed_text(const Case& c, const InletSpec& spec, double area) {
  const Feed& feed = feeds[static_cast<std::size_t>(spec.feed)];
  const double most = fastest_flow(spec);
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%s %s %.4g %s", feed.key, spec.rows.empty() ? "=" : "of up to",
                most, feed.unit);
  std::string all = text.data();
  if (spec.feed == InletFeed::velocity) return all;
  std::snprintf(text.data(), text.size(), " through %.4g %s is %.4g m/s", area,
                c.dimensions == 2 ? "m of height" : "m^2", most * speed_of_unit(c, spec, area));
  return all + text.data();
}

FeedRate feed_rate(const Case& c, const InletSpec& spec, double area) {
  const double unit_speed = speed_of_unit(c, spec, area);
  FeedRate rate;
  rate.start = spec.start, rate.stop = spec.stop;
  if (spec.rows.empty()) {
    rate.speed = {spec.value * unit_speed};
    return rate;
  }
  rate.time.clear(), rate.speed.clear();
  for (const auto& [time, value] : spec.rows)
    rate.time.push_back(time), rate.speed.push_back(value * unit_speed);
  return rate;
}

}  // namespace slagflow
