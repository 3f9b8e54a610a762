#include "host/geometry/wall_filler.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "backend/host_loop.hpp"

namespace slagflow {
namespace {

constexpr double off_lattice = 0.05;             // [spacings] that a face may lie beside its place
constexpr std::size_t faces_told = 3;            // of a wall, that lie beside theirs; of more the number
constexpr std::size_t parts_at_once = 64;        // of rows, whose particles are kept before they are added
constexpr std::int64_t sites_of_part = 1 << 15;  // about

}  // namespace

WallFiller::WallFiller(const MarkedSites& sites, WallSurvey& survey)
    : sites_(sites),
      lattice_(sites.lattice),
      survey_(survey),
      faces_(sites.c, sites.lattice, sites.solids),
      open_(sites.lattice),
      steps_(steps_by_length()) {}

void WallFiller::place(const std::vector<bool>& company, const std::function<void()>& room,
                       WallParticles& out) {
  Company in{};
  for (std::size_t b = 0; b < company.size(); ++b) in[b + 1] = company[b];
  open_ = open_sites(in);
  const SiteBits sees = open_.widened(lattice_);
  const auto rows = static_cast<std::size_t>(std::max<std::int64_t>(1, sites_of_part / lattice_.count()[0]));
  for (std::size_t first = 0; first < sees.rows(); first += parts_at_once * rows) {
    const std::size_t last = std::min(sees.rows(), first + parts_at_once * rows);
    std::vector<std::vector<Placed>> parts((last - first + rows - 1) / rows);
    for_each_range(last - first, rows, [&](std::size_t from, std::size_t to) {
      for (std::size_t r = from; r < to; ++r)
        place_row({first + r, sees.row(first + r)}, in, parts[from / rows]);
    });
    for (const std::vector<Placed>& part : parts)
      for (const Placed& placed : part) {
        if (placed.face.depth > 0) room();
        add(placed, out);
      }
  }
}

// Sites of the domain without a wall of the company.
SiteBits WallFiller::open_sites(const Company& company) const {
  SiteBits open(lattice_);
  const SiteIndex &from = lattice_.inner_first(), &to = lattice_.inner_last();
  for_each_range(open.rows(), 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
      SiteIndex s = open.first_of(r);
      if (s[1] < from[1] || s[1] >= to[1] || s[2] < from[2] || s[2] >= to[2]) continue;
      const std::uint8_t* const body = sites_.body.data() + lattice_.linear(s);
      SiteBits::Word* const row = open.row(r);
      for (std::int64_t x = from[0]; x < to[0]; ++x)
        row[x / SiteBits::width] |= SiteBits::Word{!company[body[x]]} << (x % SiteBits::width);
    }
  });
  return open;
}

void WallFiller::place_row(const SeeingRow& row, const Company& company, std::vector<Placed>& out) const {
  SiteIndex s = open_.first_of(row.number);
  const std::uint8_t* const bodies = sites_.body.data() + lattice_.linear(s);
  for (std::size_t w = 0; w < open_.words(); ++w)
    for (SiteBits::Word left = row.bits[w]; left != 0; left &= left - 1) {
      s[0] = static_cast<std::int64_t>(w) * SiteBits::width + __builtin_ctzll(left);
      if (!company[bodies[s[0]]]) continue;
      const auto body = static_cast<std::uint8_t>(bodies[s[0]] - 1);
      const Vec3d p = lattice_.position(s);
      if (sites_.inlets.holds_wall(p)) continue;
      const WallFace face = faces_.of(p, body, nearest_open(s, p));
      out.push_back({p, body, face, {}, {}});
      if (face.depth == 0) continue;
      out.back().look = survey_.look(p, body, face);
      out.back().off = off_face(s, p, face);
    }
}

void WallFiller::add(const Placed& placed, WallParticles& out) {
  if (placed.face.depth == 0) return survey_.dropped(placed.position, placed.body);
  out.position.push_back(placed.position);
  out.normal.push_back(placed.face.normal);
  out.depth.push_back(placed.face.depth);
  out.back_normal.push_back(placed.face.back_normal);
  out.back_depth.push_back(placed.face.back_depth);
  out.body.push_back(placed.body);
  if (placed.off) tell(placed.body, *placed.off);
  survey_.placed(placed.body, placed.look);
}

// All steps within the layers, short ones first. With two dimensions those in the plane.
std::vector<WallFiller::Step> WallFiller::steps_by_length() const {
  const std::int64_t n = lattice_.layers(), across = sites_.c.dimensions == 2 ? 0 : n;
  std::vector<Step> steps;
  for (std::int64_t z = -n; z <= n; ++z)
    for (std::int64_t y = -across; y <= across; ++y)
      for (std::int64_t x = -n; x <= n; ++x) steps.push_back({{x, y, z}, open_.place({x, y, z})});
  const auto square_of = [](const Step& s) {
    return s.by[0] * s.by[0] + s.by[1] * s.by[1] + s.by[2] * s.by[2];
  };
  std::stable_sort(steps.begin(), steps.end(),
                   [&](const Step& a, const Step& b) { return square_of(a) < square_of(b); });
  return steps;
}

// Whether no step leads beyond the lattice, or round it.
bool WallFiller::is_inside(const SiteIndex& s) const {
  const std::int64_t n = lattice_.layers();
  for (std::size_t k = 0; k < 3; ++k)
    if (!(k == 1 && sites_.c.dimensions == 2) && (s[k] < n || s[k] >= lattice_.count()[k] - n)) return false;
  return true;
}

// Position of the nearest open site; a wall site that is placed has one within its layers.
Vec3d WallFiller::nearest_open(const SiteIndex& site, Vec3d p) const {
  const bool inside = is_inside(site);
  const std::int64_t place = open_.place(site);
  for (const Step& step : steps_) {
    SiteIndex s = site;
    bool is_open = inside && open_.at(place + step.bits);
    if (!inside) {
      bool there = true;
      for (int axis = 0; axis < 3; ++axis)
        there = lattice_.move(s, axis, step.by[static_cast<std::size_t>(axis)]) && there;
      is_open = there && open_.test(s);
    }
    if (is_open)
      return p + lattice_.spacing() * Vec3d{static_cast<double>(step.by[0]), static_cast<double>(step.by[1]),
                                            static_cast<double>(step.by[2])};
  }
  return p;
}

std::optional<WallFiller::OffFace> WallFiller::off_face(const SiteIndex& s, Vec3d p,
                                                        const WallFace& face) const {
  const double depth = face.depth / lattice_.spacing();
  if (depth > 1 || std::abs(depth - 0.5) <= off_lattice) return {};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(face.normal[axis]) < 1 - 1e-9) continue;
    const int sign = face.normal[axis] > 0 ? 1 : -1;
    const double coordinate = p[axis] + face.depth * face.normal[axis];
    if (!fluid_beyond(s, axis, sign)) return {};
    const std::size_t body = sites_.body[lattice_.linear(s)] - std::size_t{1};
    if (!is_plane(p + face.depth * face.normal, axis, body)) return {};
    const long rounded = std::lround(1000 * coordinate / lattice_.spacing());
    return OffFace{axis, sign, rounded, coordinate, std::abs(depth - 0.5)};
  }
  return {};
}

void WallFiller::tell(std::size_t body, const OffFace& face) {
  if (!told_.emplace(body, face.axis, face.sign, face.rounded).second || ++faces_off_[body] > faces_told)
    return;
  char text[160];
  std::snprintf(text, sizeof text, "the face %c = %.6g m lies %.2f spacings off the lattice",
                "xyz"[face.axis], face.coordinate, face.off);
  warnings_.push_back("wall '" + sites_.c.walls[body].name + "': " + text +
                      "; faces that border the fluid should be a whole number of spacings from "
                      "resolution.origin");
}

// Whether the walls have a face there, half a spacing wide and more, across an axis: not so at the pole of
// a sphere, nor where a wall particle counts as below the plane of a face that does not reach so far.
bool WallFiller::is_plane(Vec3d foot, int axis, std::size_t body) const {
  const auto on_face = [&](Vec3d q) {
    return std::abs(sites_.solids.distance_to_company(lattice_.wrapped(q), body)) < 1e-3 * lattice_.spacing();
  };
  if (!on_face(foot)) return false;
  for (int across = 0; across < 3; ++across) {
    if (across == axis || (across == 1 && sites_.c.dimensions == 2)) continue;
    Vec3d one = foot, other = foot;
    one[across] -= 0.5 * lattice_.spacing(), other[across] += 0.5 * lattice_.spacing();
    if (!on_face(one) && !on_face(other)) return false;
  }
  return true;
}

bool WallFiller::fluid_beyond(SiteIndex s, int axis, int sign) const {
  for (int step = 0; step < 2; ++step)
    if (lattice_.move(s, axis, sign) && sites_.fluid.test(s)) return true;
  return false;
}

std::vector<std::string> WallFiller::warnings() const {
  std::vector<std::string> all = warnings_;
  for (const auto& [body, faces] : faces_off_)
    if (faces > faces_told)
      all.push_back("wall '" + sites_.c.walls[body].name +
                    "': faces off the lattice besides these: " + std::to_string(faces - faces_told));
  return all;
}

}  // namespace slagflow
