#include "host/geometry/inlets.hpp"

#include <algorithm>
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

}  // namespace

InletColumns inlet_columns(const Case& c, std::size_t inlet, const Lattice& lattice,
                           const WallSolids& walls) {
  const InletSpec& spec = c.inlets[inlet];
  const InletOutline face = face_of(c, inlet);
  const Sites sites =
      spec.face == InletFace::rectangle ? rectangle_sites(c, face) : grid_sites(c, face, lattice);
  if (sites.place.empty())
    refuse_inlet(c, inlet, "",
                 "its face holds no particle: allowed: a larger face or a smaller resolution.spacing");
  InletColumns columns;
  columns.normal = face.frame.normal;
  columns.stride = std::pow(c.spacing, c.dimensions) / sites.area;
  columns.across = shorter_way(c, spec, face);
  const double ratio = columns.stride / c.spacing;
  if (!(ratio > 0.6 && ratio < 1.6))
    refuse_inlet(
        c, inlet, "",
        "its face of " + show(face.area) + (c.dimensions == 2 ? " m" : " m^2") + " holds " +
            std::to_string(sites.place.size()) +
            " particles, too few for its size: allowed: a larger face or a smaller resolution.spacing");
  std::vector<std::array<double, 2>> open;
  for (const auto& [a, b] : sites.place) {
    const Vec3d origin = face.frame.at(a, b), first = origin + 0.5 * columns.stride * columns.normal;
    if (!in_domain(c, lattice, first))
      refuse_inlet(
          c, inlet, spec.face == InletFace::stl ? "file" : "center",
          "fluid would come in outside the domain: allowed: a face in it or on its boundary, the normal "
          "inwards");
    if (walls.distance(lattice.wrapped(first)) < nearest_wall * c.spacing) {
      ++columns.blocked;
      continue;
    }
    open.push_back({a, b}), columns.origin.push_back(origin);
  }
  if (open.empty())
    refuse_inlet(c, inlet, "",
                 "walls stand before all of its face: allowed: a face that looks into the open");
  columns.area = sites.area * static_cast<double>(open.size());
  columns.side = sides_of(c, face.frame, columns.origin, columns.stride, walls);
  const double mean = fastest_flow(spec) * speed_of_unit(c, spec, columns.area);
  if (!(mean > 0)) refuse_inlet(c, inlet, "", "feeds nothing: allowed: a flow above 0");
  const auto share = shares(c, spec, face, mean);
  double sum = 0;
  for (const auto& [a, b] : open) {
    columns.share.push_back(std::max(share(a, b), 0.0));
    sum += columns.share.back();
  }
  if (!(sum > 0 && std::isfinite(sum)))
    refuse_inlet(c, inlet, "profile", "value \"developed\" cannot be computed for this fluid: allowed: plug");
  for (double& s : columns.share) s *= static_cast<double>(open.size()) / sum;
  return columns;
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

InletSpace::InletSpace(const Case& c, std::vector<InletColumns> inlets)
    : spacing_(c.spacing), layers_(std::ceil(c.support_ratio)), inlets_(std::move(inlets)) {
  for (const InletColumns& in : inlets_) {
    const Vec3d around = (2 * layers_ * in.stride + c.spacing) * Vec3d{1, 1, 1};
    Box box{in.origin[0], in.origin[0]};
    for (const Vec3d& p : in.origin)
      for (int k = 0; k < 3; ++k)
        box.lower[k] = std::min(box.lower[k], p[k]), box.upper[k] = std::max(box.upper[k], p[k]);
    boxes_.push_back({box.lower - around, box.upper + around});
  }
}

bool InletSpace::Box::holds(Vec3d p) const {
  for (int k = 0; k < 3; ++k)
    if (!(p[k] >= lower[k] && p[k] <= upper[k])) return false;
  return true;
}

bool InletSpace::holds(const InletColumns& in, Vec3d p, double around) const {
  return std::any_of(in.origin.begin(), in.origin.end(), [&](const Vec3d& origin) {
    const Vec3d d = p - origin;
    const double behind = -dot(d, in.normal);
    return behind > 0 && behind < 2 * layers_ * in.stride + 0.5 * spacing_ &&
           norm(d + behind * in.normal) < around * spacing_;
  });
}

bool InletSpace::holds(Vec3d p, double around) const {
  for (std::size_t k = 0; k < inlets_.size(); ++k)
    if (boxes_[k].holds(p) && holds(inlets_[k], p, around)) return true;
  return false;
}

void add_openings(const Case& c, const std::vector<InletColumns>& inlets, SimulationSetup& setup) {
  const int rows = inlet_rows(setup), moving = inlet_moving_rows(setup);
  for (std::size_t k = 0; k < inlets.size(); ++k) {
    const InletColumns& in = inlets[k];
    InletSetup inlet;
    inlet.name = c.inlets[k].name;
    inlet.body = setup.bodies.size();
    inlet.fluid = static_cast<std::uint8_t>(c.inlets[k].fluid);
    inlet.normal = in.normal, inlet.stride = in.stride;
    inlet.origin = in.origin, inlet.share = in.share;
    inlet.rate = feed_rate(c, c.inlets[k], in.area);
    WallBody body;
    body.name = inlet.name;
    setup.bodies.push_back(body);
    WallParticles& w = setup.walls;
    w.back_normal.resize(w.position.size()), w.back_depth.resize(w.position.size());
    for (std::size_t column = 0; column < in.origin.size(); ++column)
      for (int row = 0; row < rows; ++row) {
        const double behind = inlet_row_place(row, moving) * in.stride, end = (rows - 2) * in.stride;
        // Those that stay look backwards, and those nearest to a side that fluid comes to look there.
        Vec3d normal = row < moving ? in.normal : -in.normal;
        double depth = row < moving ? behind : end - behind;
        if (in.side[column].depth > 0 && in.side[column].depth < depth)
          normal = in.side[column].normal, depth = in.side[column].depth;
        w.position.push_back(in.origin[column] - behind * in.normal);
        w.normal.push_back(normal), w.depth.push_back(depth);
        w.body.push_back(static_cast<std::uint8_t>(inlet.body));
        w.back_normal.emplace_back(), w.back_depth.push_back(0);
      }
    setup.inlets.push_back(inlet);
  }
  for (const OutletSpec& spec : c.outlets) {
    constexpr double far = 1e30;
    OutletSetup outlet{spec.name, spec.min, spec.max};
    if (spec.shape == OutletShape::plane) {
      outlet.lower = {-far, -far, -far}, outlet.upper = {far, far, far};
      const int axis = spec.direction.axis;
      (spec.direction.sign > 0 ? outlet.lower : outlet.upper)[axis] = spec.position;
    }
    if (c.dimensions == 2) outlet.lower.y = -far, outlet.upper.y = far;
    setup.outlets.push_back(outlet);
  }
}

std::int64_t fed_particles(const SimulationSetup& setup, double time) {
  constexpr double most = 1e12;  // of a column
  std::int64_t count = 0;
  for (const InletSetup& in : setup.inlets)
    for (const double share : in.share)
      count += static_cast<std::int64_t>(std::min(share * in.rate.travelled(time) / in.stride + 0.5, most));
  return count;
}

namespace {

// Whether two columns come out of the same place.
bool meet(const Case& c, const InletColumns& a, const InletColumns& b) {
  if (dot(a.normal, b.normal) < 0.5) return false;
  for (const Vec3d& p : a.origin)
    for (const Vec3d& q : b.origin)
      if (norm(p - q) < 0.7 * c.spacing) return true;
  return false;
}

bool held_by(const Case& c, const OutletSpec& out, Vec3d p) {
  if (out.shape == OutletShape::plane) return out.direction.sign * (p[out.direction.axis] - out.position) > 0;
  for (int k = 0; k < 3; ++k)
    if (!(k == 1 && c.dimensions == 2) && !(p[k] >= out.min[k] && p[k] <= out.max[k])) return false;
  return true;
}

void warn_of_outlet(const Case& c, const OutletSpec& out, const std::vector<InletColumns>& inlets,
                    const std::vector<Vec3d>& fluid, std::vector<std::string>& warnings) {
  constexpr double thin = 4;  // [spacings]
  const std::string name = "outlet '" + out.name + "'";
  const auto taken = std::count_if(fluid.begin(), fluid.end(), [&](Vec3d p) { return held_by(c, out, p); });
  if (taken > 0)
    warnings.push_back(name + " takes " + std::to_string(taken) + " of " + std::to_string(fluid.size()) +
                       " particles at the start: they are inside of it");
  for (std::size_t k = 0; k < inlets.size(); ++k)
    if (held_by(c, out, inlets[k].origin[0] + 0.5 * inlets[k].stride * inlets[k].normal))
      warnings.push_back(name + " takes what inlet '" + c.inlets[k].name + "' feeds: it covers its face");
  if (out.shape == OutletShape::plane) return;
  for (int k = 0; k < 3; ++k)
    if (!(k == 1 && c.dimensions == 2) && out.max[k] - out.min[k] < thin * c.spacing)
      return warnings.push_back(name + " is thinner than " + show(thin) +
                                " spacings: fluid that is fast may pass it between two looks; a plane, or a "
                                "box that reaches on behind, takes all");
}

}  // namespace

void require_apart(const Case& c, const std::vector<InletColumns>& inlets) {
  for (std::size_t a = 0; a < inlets.size(); ++a)
    for (std::size_t b = a + 1; b < inlets.size(); ++b) {
      const bool together = c.inlets[a].start < c.inlets[b].stop && c.inlets[b].start < c.inlets[a].stop;
      if (together && meet(c, inlets[a], inlets[b]))
        refuse_inlet(c, b, "",
                     "feeds where inlet '" + c.inlets[a].name +
                         "' does: allowed: faces that do not meet, or times, start and stop, that do not");
    }
}

void warn_of_openings(const Case& c, const std::vector<InletColumns>& inlets, const std::vector<Vec3d>& fluid,
                      std::vector<std::string>& warnings) {
  for (const OutletSpec& out : c.outlets) warn_of_outlet(c, out, inlets, fluid, warnings);
  constexpr double least = 5, few_rows = 10;  // particles over the face, and one behind the other
  char text[200];
  for (std::size_t k = 0; k < inlets.size(); ++k) {
    const InletColumns& in = inlets[k];
    const std::string name = "inlet '" + c.inlets[k].name + "'";
    if (in.blocked > 0)
      warnings.push_back(name + ": walls stand before " + std::to_string(in.blocked) + " of " +
                         std::to_string(in.blocked + in.origin.size()) +
                         " columns of its face: the flow goes through the others");
    if (in.across < least * c.spacing) {
      std::snprintf(text, sizeof text, " is %.2g spacings across at its narrowest: %g and more carry a flow",
                    in.across / c.spacing, least);
      warnings.push_back(name + text);
    }
    const double rows = feed_rate(c, c.inlets[k], in.area).travelled(c.output.last_time()) / in.stride;
    if (c.inlets[k].start >= c.output.last_time()) {
      warnings.push_back(name + " starts after the end of the run");
    } else if (rows < few_rows) {
      std::snprintf(
          text, sizeof text,
          " brings %.3g rows of particles by the end: it feeds in whole rows, half a row more or less", rows);
      warnings.push_back(name + text);
    }
  }
}

}  // namespace slagflow
