// What inlets and outlets add to a setup, and what is told of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "fluid/constants.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/inlet_face.hpp"
#include "host/geometry/inlets.hpp"

namespace slagflow {

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

namespace {

// The wall particles of an inlet's columns.
void add_columns(const InletColumns& in, std::size_t body, SimulationSetup& setup) {
  const int rows = inlet_rows(setup), moving = inlet_moving_rows(setup);
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
      w.body.push_back(static_cast<std::uint8_t>(body));
      w.back_normal.emplace_back(), w.back_depth.push_back(0);
    }
}

OutletSetup outlet_setup(const Case& c, const OutletSpec& spec) {
  constexpr double far = 1e30;
  OutletSetup outlet{spec.name, spec.min, spec.max};
  if (spec.shape == OutletShape::plane) {
    outlet.lower = {-far, -far, -far}, outlet.upper = {far, far, far};
    (spec.direction.sign > 0 ? outlet.lower : outlet.upper)[spec.direction.axis] = spec.position;
  }
  if (c.dimensions == 2) outlet.lower.y = -far, outlet.upper.y = far;
  return outlet;
}

}  // namespace

void add_openings(const Case& c, const std::vector<InletColumns>& inlets, SimulationSetup& setup) {
  for (std::size_t k = 0; k < inlets.size(); ++k) {
    const InletColumns& in = inlets[k];
    InletSetup inlet;
    inlet.name = c.inlets[k].name;
    inlet.body = setup.bodies.size();
    inlet.fluid = static_cast<std::uint8_t>(c.inlets[k].fluid);
    inlet.normal = in.normal, inlet.stride = in.stride;
    inlet.origin = in.origin, inlet.share = in.share;
    inlet.rate = feed_rate(c, c.inlets[k], in.area);
    inlet.temperature = c.inlets[k].temperature;
    WallBody body;
    body.name = inlet.name;
    setup.bodies.push_back(body);
    add_columns(in, inlet.body, setup);
    setup.inlets.push_back(inlet);
  }
  for (const OutletSpec& spec : c.outlets) setup.outlets.push_back(outlet_setup(c, spec));
}

std::int64_t fed_particles(const SimulationSetup& setup, double time) {
  constexpr double most = 1e12;  // of a column
  std::int64_t count = 0;
  for (const InletSetup& in : setup.inlets)
    for (const double share : in.share)
      count += static_cast<std::int64_t>(
          std::min(std::floor(share * in.rate.travelled(time) / in.stride + 0.5), most));
  return count;
}

namespace {

// The places of an inlet's body, six spacings of it behind the face.
std::vector<Vec3d> body_of(const InletColumns& in) {
  constexpr int deep = 6;
  std::vector<Vec3d> places;
  for (const Vec3d& p : in.origin)
    for (int row = 0; row < deep; ++row) places.push_back(p - (row * in.stride) * in.normal);
  return places;
}

// The shifts by which a place comes again along periodic axes, none among them.
std::vector<Vec3d> images(const Case& c) {
  std::vector<Vec3d> shifts{{}};
  for (int axis = 0; axis < 3; ++axis) {
    if (!c.domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const double period = c.domain.upper[axis] - c.domain.lower[axis];
    const std::size_t before = shifts.size();
    for (std::size_t k = 0; k < before; ++k)
      for (const double way : {-period, period}) {
        Vec3d shift = shifts[k];
        shift[axis] = way;
        shifts.push_back(shift);
      }
  }
  return shifts;
}

// Whether the bodies of two inlets have a place in common, the second shifted.
bool meet(const Case& c, const InletColumns& a, const InletColumns& b, Vec3d shift) {
  const double near = 0.7 * c.spacing;
  const auto cell = [&](Vec3d p) {
    std::array<std::int64_t, 3> k{};
    for (int axis = 0; axis < 3; ++axis)
      k[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(p[axis] / c.spacing));
    return k;
  };
  std::multimap<std::array<std::int64_t, 3>, Vec3d> places;
  for (const Vec3d& p : body_of(a)) places.emplace(cell(p), p);
  for (Vec3d q : body_of(b)) {
    q += shift;
    for (std::int64_t n = 0; n < 27; ++n) {
      const auto at = cell(q);
      const auto [first, last] =
          places.equal_range({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      for (auto p = first; p != last; ++p)
        if (norm(p->second - q) < near) return true;
    }
  }
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

// Bodies are there as walls before an inlet starts and after it has stopped too.
void require_apart(const Case& c, const std::vector<InletColumns>& inlets) {
  for (const Vec3d& shift : images(c))
    for (std::size_t a = 0; a < inlets.size(); ++a) {
      if (norm(shift) > 0 && meet(c, inlets[a], inlets[a], shift))
        refuse_inlet(
            c, a, "",
            "its body, the six spacings behind its face, meets itself across a periodic face: allowed: a "
            "face no wider than the period");
      for (std::size_t b = a + 1; b < inlets.size(); ++b)
        if (meet(c, inlets[a], inlets[b], shift))
          refuse_inlet(c, b, "",
                       "its body, the six spacings behind its face, meets that of inlet '" +
                           c.inlets[a].name +
                           "', and both are there all the time: allowed: bodies that do not meet; one inlet "
                           "with a table over time feeds at one place");
    }
}

namespace {

constexpr double fast_feed = 100;  // [m/s] faster than what is poured or cast

// Rows of particles that come by the end.
void warn_of_feed(const Case& c, const InletSpec& spec, const InletColumns& in,
                  std::vector<std::string>& warnings) {
  constexpr double few_rows = 10;
  const std::string name = "inlet '" + spec.name + "'";
  if (spec.start >= c.flow_end())
    return warnings.push_back(name + " starts after the end of the " + c.what_ends_it() + " at " +
                              show(c.flow_end()) + " s: it feeds nothing");
  const FeedRate rate = feed_rate(c, spec, in.area);
  if (rate.fastest() > fast_feed)
    warnings.push_back(name + ": " + feed_text(c, spec, in.area) +
                       ", faster than anything is poured; is the unit right?");
  const double rows = rate.travelled(c.flow_end()) / in.stride;
  if (rows >= few_rows) return;
  std::array<char, 200> text{};
  std::snprintf(
      text.data(), text.size(), ", which brings %.3g rows of particles by the end: %s", rows,
      rows < 0.5 ? "nothing comes; is the unit right?" : "it feeds in whole rows, half a row more or less");
  warnings.push_back(name + ": " + feed_text(c, spec, in.area) + text.data());
}

}  // namespace

void warn_of_openings(const Case& c, const std::vector<InletColumns>& inlets, const std::vector<Vec3d>& fluid,
                      std::vector<std::string>& warnings) {
  for (const OutletSpec& out : c.outlets) warn_of_outlet(c, out, inlets, fluid, warnings);
  constexpr double least = 5;  // particles over the face
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
    warn_of_feed(c, c.inlets[k], in, warnings);
  }
}

}  // namespace slagflow
