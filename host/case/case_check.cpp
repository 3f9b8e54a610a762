// What concerns several tables of a case at once.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "fluid/constants.hpp"
#include "host/case/case_rules.hpp"

namespace slagflow {

const std::vector<std::string> axis_names{"x", "y", "z"};
const std::vector<std::string> face_names{"rectangle", "disc", "annulus", "stl"};
const std::vector<std::string> direction_names{"-x", "+x", "-y", "+y", "-z", "+z"};

namespace {

bool plain(unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; }

std::string axis_name(int axis) { return axis_names[static_cast<std::size_t>(axis)]; }

// A periodic axis must carry whole lattice cells, and a particle must not meet its own image.
void check_periodic(const Case& c, CaseProblems& problems) {
  if (!problems.fine({"domain.min", "domain.max", "domain.periodic", "resolution.spacing"})) return;
  const double support = c.support_ratio * c.spacing;
  for (int k = 0; k < 3; ++k) {
    if (!c.domain.periodic[static_cast<std::size_t>(k)]) continue;
    const double extent = c.domain.upper[k] - c.domain.lower[k];
    const double cells = extent / c.spacing;
    const std::string what = "the extent " + show(extent) + " m along the periodic axis " + axis_name(k);
    if (std::abs(cells - std::round(cells)) > 1e-6 * cells)
      problems.add("domain.periodic", what + " is " + show(cells) +
                                          " spacings: allowed: a whole number of spacings of " +
                                          show(c.spacing) + " m");
    else if (extent < 3 * support * (1 - 1e-9))
      problems.add("domain.periodic",
                   what + " is too short: allowed: >= 3 support radii = " + show(3 * support) + " m");
  }
}

// Nothing leaves through the faces of a periodic axis, nor along y with two dimensions.
void check_exits(const Case& c, CaseProblems& problems) {
  std::string allowed;
  for (std::size_t face = 0; face < c.exits.size(); ++face)
    if (!c.domain.periodic[face / 2] && !(c.dimensions == 2 && face / 2 == 1))
      allowed += (allowed.empty() ? "" : ", ") + direction_names[face];
  if (allowed.empty()) allowed = "none";
  for (std::size_t face = 0; face < c.exits.size(); ++face) {
    if (!c.exits[face]) continue;
    const std::string value = "value \"" + direction_names[face] + "\"";
    if (c.domain.periodic[face / 2])
      problems.add("domain.exits", value + " is a face of the periodic axis " +
                                       axis_name(static_cast<int>(face / 2)) + ": allowed: " + allowed);
    else if (c.dimensions == 2 && face / 2 == 1)
      problems.add("domain.exits", value + " with two dimensions: allowed: " + allowed);
    else if (c.domain.departure == Departure::stop)
      return problems.add("domain.exits", value +
                                              " with domain.departure = \"stop\", which ends the run "
                                              "when a particle leaves: allowed: departure = \"remove\"");
  }
}

std::string measure_key(std::size_t index) { return "measure." + std::to_string(index); }

// The line of a front, which a periodic axis does not have, or the plane of a flow rate.
void check_plane(const Case& c, std::size_t index, CaseProblems& problems) {
  const MeasureSpec& measure = c.measures[index];
  const std::string key = measure_key(index);
  const int axis = measure.direction.axis;
  if (measure.type == MeasureType::front && c.domain.periodic[static_cast<std::size_t>(axis)])
    problems.add(key + ".direction", "runs along the periodic axis " + axis_name(axis) +
                                         ": allowed: an axis that is not periodic");
  else if (measure.position < c.domain.lower[axis] || measure.position > c.domain.upper[axis])
    problems.add(key + ".position", "value " + show(measure.position) +
                                        " is outside the domain: allowed: " + show(c.domain.lower[axis]) +
                                        " to " + show(c.domain.upper[axis]) + " [m]");
}

void check_jet(const Case& c, std::size_t index, CaseProblems& problems) {
  const MeasureSpec& measure = c.measures[index];
  const std::string key = measure_key(index);
  const auto [axis, sign] = down(c);
  if (c.gravity[axis] == 0)
    problems.add(key + ".type", "a jet needs gravity: allowed: gravity.acceleration other than 0");
  else if (measure.outward.axis == axis)
    problems.add(key + ".outward", "runs along gravity: allowed: a horizontal direction");
  else if ((measure.bottom - measure.lip[axis]) * sign <= 0)
    problems.add(key + ".bottom", "value " + show(measure.bottom) + " is not below the lip: allowed: " +
                                      (sign < 0 ? "< " : "> ") + show(measure.lip[axis]) + " [m]");
}

std::string text_of(const Vec3d& v) { return "[" + show(v.x) + ", " + show(v.y) + ", " + show(v.z) + "]"; }

bool in_domain(const Case& c, const Vec3d& point) {
  for (int k = 0; k < 3; ++k)
    if (!(k == 1 && c.dimensions == 2) && (point[k] < c.domain.lower[k] || point[k] > c.domain.upper[k]))
      return false;
  return true;
}

void check_box(const Case& c, const std::string& key, const Vec3d& min, const Vec3d& max,
               CaseProblems& problems) {
  for (int k = 0; k < 3; ++k) {
    const std::string along = "value " + show(max[k]) + " along " + axis_name(k);
    if (!(min[k] < max[k]))
      return problems.add(key + ".max", along + " is not above min: allowed: > " + show(min[k]) + " [m]");
    if (max[k] < c.domain.lower[k] || min[k] > c.domain.upper[k])
      return problems.add(key + ".max",
                          along + " makes a box outside of the domain: allowed: a box that meets " +
                              text_of(c.domain.lower) + " to " + text_of(c.domain.upper) + " [m]");
  }
}

void check_profile(const Case& c, std::size_t index, CaseProblems& problems) {
  const MeasureSpec& measure = c.measures[index];
  for (const auto& [name, point] : {std::pair{"start", measure.start}, std::pair{"end", measure.end}})
    if (!in_domain(c, point))
      problems.add(measure_key(index) + "." + name,
                   "value " + text_of(point) + " is outside the domain: allowed: " + text_of(c.domain.lower) +
                       " to " + text_of(c.domain.upper) + " [m]");
  if (measure.start == measure.end)
    problems.add(measure_key(index) + ".end", "is the start: allowed: another point");
}

// The lines of a surface go across gravity, as its columns go along it.
void check_surface(const Case& c, std::size_t index, CaseProblems& problems) {
  const MeasureSpec& measure = c.measures[index];
  const std::string key = measure_key(index);
  const int axis = down(c).axis;
  if (c.gravity[axis] == 0)
    return problems.add(key + ".type", "a surface needs gravity: allowed: gravity.acceleration other than 0");
  check_profile(c, index, problems);
  if (!in_domain(c, measure.start + measure.across) || !in_domain(c, measure.end + measure.across))
    problems.add(key + ".across", "value " + text_of(measure.across) +
                                      " leads out of the domain: allowed: lines from " +
                                      text_of(c.domain.lower) + " to " + text_of(c.domain.upper) + " [m]");
  Vec3d along = measure.end - measure.start;
  along[axis] = 0;
  if (norm(along) == 0 && !(measure.start == measure.end))
    problems.add(key + ".end", "value " + text_of(measure.end) +
                                   " is straight above or below the start: allowed: a line across gravity; "
                                   "along it type = \"level\" measures");
}

void check_flux(const Case& c, std::size_t index, CaseProblems& problems) {
  const MeasureSpec& measure = c.measures[index];
  const std::string key = measure_key(index);
  if (!in_domain(c, measure.center))
    problems.add(key + ".center", "value " + text_of(measure.center) + " is outside the domain: allowed: " +
                                      text_of(c.domain.lower) + " to " + text_of(c.domain.upper) + " [m]");
  if (c.dimensions == 2 && measure.normal.y != 0)
    problems.add(key + ".normal", "y component " + show(measure.normal.y) +
                                      " with two dimensions: allowed: 0, the plane is x-z");
}

void check_measure(const Case& c, std::size_t index, CaseProblems& problems) {
  switch (c.measures[index].type) {
    case MeasureType::front:
    case MeasureType::flow_rate:
      return check_plane(c, index, problems);
    case MeasureType::jet:
      return check_jet(c, index, problems);
    case MeasureType::volume:
    case MeasureType::mixing:
    case MeasureType::solid:
      return check_box(c, measure_key(index), c.measures[index].min, c.measures[index].max, problems);
    case MeasureType::profile:
    case MeasureType::level:
      return check_profile(c, index, problems);
    case MeasureType::flux:
      return check_flux(c, index, problems);
    case MeasureType::surface:
      return check_surface(c, index, problems);
    case MeasureType::force:
    case MeasureType::contact:
    case MeasureType::residence:
    case MeasureType::heat:
      return;
  }
}

void check_measures(const Case& c, CaseProblems& problems) {
  for (std::size_t m = 0; m < c.measures.size(); ++m) {
    const std::string key = measure_key(m);
    if (!problems.fine({key + ".type", key + ".direction", key + ".position", key + ".lip", key + ".outward",
                        key + ".bottom", key + ".min", key + ".max", key + ".start", key + ".end",
                        key + ".center", key + ".normal", key + ".across", "domain.min", "domain.max",
                        "gravity.acceleration"}))
      continue;
    check_measure(c, m, problems);
  }
}

void check_stop(const Case& c, CaseProblems& problems) {
  if (c.output.stop_after.empty()) return;
  std::string arriving;
  for (const MeasureSpec& m : c.measures) {
    if (m.type != MeasureType::front && m.type != MeasureType::jet) continue;
    if (m.name == c.output.stop_after) return;
    arriving += (arriving.empty() ? "" : ", ") + m.name;
  }
  problems.add("output.stop_after", "value " + in_quotes(c.output.stop_after) +
                                        " is no measure that arrives: allowed: a front or jet: " +
                                        (arriving.empty() ? "the case has none" : arriving));
}

void check_flat_inlets(const Case& c, CaseProblems& problems) {
  if (c.dimensions != 2) return;
  for (std::size_t k = 0; k < c.inlets.size(); ++k) {
    const std::string key = "inlet." + std::to_string(k);
    if (c.inlets[k].face != InletFace::rectangle)
      problems.add(key + ".face", "value " +
                                      in_quotes(face_names[static_cast<std::size_t>(c.inlets[k].face)]) +
                                      " with two dimensions: allowed: rectangle");
    const double y = c.inlets[k].normal.y;
    if (y != 0)
      problems.add(key + ".normal",
                   "y component " + show(y) + " with two dimensions: allowed: 0, the plane is x-z");
  }
}

void check_two_dimensions(const Case& c, CaseProblems& problems) {
  if (c.dimensions != 2) return;
  const auto no_y = [&](const std::string& key, double y) {
    if (y != 0)
      problems.add(key, "y component " + show(y) + " with two dimensions: allowed: 0, the plane is x-z");
  };
  no_y("gravity.acceleration", c.gravity.y);
  no_y("body_force.acceleration", c.body_force.y);
  if (c.domain.periodic[1]) problems.add("domain.periodic", "value \"y\" with two dimensions: allowed: x, z");
  const auto about_y = [&](const std::string& key, Vec3d spin) {
    if (spin.x != 0 || spin.z != 0)
      problems.add(key, "turns out of the x-z plane with two dimensions: allowed: about y alone");
  };
  for (std::size_t r = 0; r < c.regions.size(); ++r) {
    const std::string key = "region." + std::to_string(r);
    no_y(key + ".velocity", c.regions[r].velocity.y);
    about_y(key + ".angular_velocity", c.regions[r].angular_velocity);
    for (std::size_t w = 0; w < c.regions[r].waves.size(); ++w) {
      const std::string wave = key + ".waves." + std::to_string(w);
      no_y(wave + ".amplitude", c.regions[r].waves[w].amplitude.y);
      no_y(wave + ".wave_vector", c.regions[r].waves[w].wave_vector.y);
    }
  }
  for (std::size_t w = 0; w < c.walls.size(); ++w) {
    const std::string key = "wall." + std::to_string(w);
    no_y(key + ".surface_velocity", c.walls[w].surface.velocity.y);
    about_y(key + ".surface_angular_velocity", c.walls[w].surface.angular_velocity);
    const WallMotion& motion = c.walls[w].motion;
    no_y(key + ".motion.velocity", motion.velocity.y);
    no_y(key + ".motion.amplitude", motion.amplitude.y);
    for (const Vec3d& shift : motion.displacement) no_y(key + ".motion.displacement", shift.y);
    about_y(key + ".motion.angular_velocity", motion.angular_velocity);
    about_y(key + ".motion.angular_amplitude", motion.angular_amplitude);
    about_y(key + ".motion.axis", motion.axis);
  }
}

// An inlet's particles are those of a wall of its name.
void check_inlet_names(const Case& c, CaseProblems& problems) {
  for (std::size_t k = 0; k < c.inlets.size(); ++k)
    for (const WallSpec& wall : c.walls)
      if (!wall.name.empty() && wall.name == c.inlets[k].name)
        problems.add("inlet." + std::to_string(k) + ".name",
                     "value " + in_quotes(wall.name) + " is the name of a wall: allowed: a name of its own");
}

// Whether any of it is in the domain.
void check_outlets(const Case& c, CaseProblems& problems) {
  if (!problems.fine({"domain.min", "domain.max"})) return;
  for (std::size_t k = 0; k < c.outlets.size(); ++k) {
    const OutletSpec& out = c.outlets[k];
    const std::string key = "outlet." + std::to_string(k);
    if (!problems.fine({key + ".min", key + ".max", key + ".shape", key + ".position"})) continue;
    if (out.shape == OutletShape::box) {
      check_box(c, key, out.min, out.max, problems);
      continue;
    }
    const int axis = out.direction.axis;
    const bool up = out.direction.sign > 0;
    const double end = up ? c.domain.upper[axis] : c.domain.lower[axis];
    if (up ? out.position >= end : out.position <= end)
      problems.add(key + ".position", "value " + show(out.position) +
                                          " leaves nothing of the domain beyond: allowed: " +
                                          (up ? "< " : "> ") + show(end) + " [m]");
  }
}

void check_tension_limits(const Case& c, CaseProblems& problems) {
  for (std::size_t i = 0; i < c.walls.size(); ++i) {
    const std::string conflict = tension_conflict(c.walls[i].tension_limit, c.numerics);
    if (!conflict.empty()) problems.add("wall." + std::to_string(i) + ".tension_limit", conflict);
  }
}

void check_numerics(const Case& c, CaseProblems& problems) {
  for (const Conflict& conflict : conflicts(c.numerics)) problems.add(conflict.key, conflict.what);
  if (c.numerics.yield != YieldModel::exact) return;
  for (const FluidSpec& fluid : c.fluids)
    if (!allows_exact_yield(fluid.rheology))
      problems.add("fluid." + fluid.name + ".rheology",
                   "value \"" + std::string(fluid.info().name) +
                       "\" with numerics.yield = \"exact\": allowed: \"newtonian\", \"bingham\", "
                       "\"herschel-bulkley\", \"carreau-yasuda\"");
}

// Single precision holds neither the powers of smaller lengths nor those of larger ones.
void check_scale(const Case& c, CaseProblems& problems) {
  if (!problems.fine({"resolution.spacing", "numerics.yield"})) return;
  const bool exact = c.numerics.yield == YieldModel::exact;
  const double smallest = exact ? 5e-6 : 2e-6, largest = exact ? 1e3 : 1e4;
  if (c.spacing >= smallest && c.spacing <= largest) return;
  problems.add("resolution.spacing",
               "value " + show(c.spacing) + " with numerics.yield = \"" + (exact ? "exact" : "regularised") +
                   "\" is beyond what single precision holds the powers of: allowed: " + show(smallest) +
                   " to " + show(largest) + " [m]");
}

}  // namespace

Direction direction_of(int index) { return {index / 2, index % 2 == 0 ? -1 : 1}; }

int index_of(const Direction& direction) { return 2 * direction.axis + (direction.sign > 0 ? 1 : 0); }

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name[0] != '.' && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), plain);
}

void check_across_tables(const Case& c, CaseProblems& problems) {
  check_two_dimensions(c, problems);
  check_flat_inlets(c, problems);
  check_periodic(c, problems);
  check_exits(c, problems);
  check_inlet_names(c, problems);
  check_outlets(c, problems);
  check_measures(c, problems);
  check_stop(c, problems);
  check_tension_limits(c, problems);
  check_numerics(c, problems);
  check_scale(c, problems);
  check_fluids(c, problems);
}

}  // namespace slagflow
