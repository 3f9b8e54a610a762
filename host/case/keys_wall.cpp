// [[wall]]: solid bodies, and how they move.
#include <algorithm>
#include <filesystem>
#include <functional>

#include "host/case/case_keys.hpp"
#include "host/case/keys_thermal.hpp"
#include "host/case/motion_file.hpp"

namespace slagflow {
namespace {

const Words slip_names{"no_slip", "free_slip", "partial_slip"};
const Words motion_names{"rest", "constant", "ramp", "table", "sine"};
const Words interpolation_names{"linear", "smooth"};

void describe_slip(CaseVisitor& v, WallSpec& wall) {
  v.choice(key("slip", "of the fluid along the wall"), wall.slip, slip_names);
  if (const auto with = v.only(wall.slip == WallSlip::partial_slip, {"slip", {"partial_slip"}},
                               "only slip = \"partial_slip\" has a slip length"))
    v.number(required("slip_length", "slip length b in (14)"), wall.slip_length, above(0, "m"));
}

void describe_surface(CaseVisitor& v, WallSpec& wall) {
  const auto with = v.only(wall.slip != WallSlip::free_slip, {"slip", {"no_slip", "partial_slip"}},
                           "nothing of slip = \"free_slip\" drags the fluid along");
  if (!with) return;
  v.vector(key("surface_velocity",
               "of the wall's material while its shape stays: plates, belts, rolls. The part along "
               "the surface counts"),
           wall.surface.velocity, any_number("m/s"));
  v.vector(key("surface_angular_velocity", "turning about surface_center, added to surface_velocity"),
           wall.surface.angular_velocity, any_number("rad/s"));
  v.vector(key("surface_center", "of surface_angular_velocity"), wall.surface.center, any_number("m"));
}

const char* const times_allowed = "increasing times [s], at least two";

void check_times(CaseVisitor& v, const std::vector<double>& time) {
  const auto wrong = std::adjacent_find(time.begin(), time.end(), std::greater_equal<double>());
  const std::string allowed = std::string(": allowed: ") + times_allowed;
  if (wrong != time.end())
    v.problem("time", "value " + show(*(wrong + 1)) + " follows " + show(*wrong) + allowed);
  else if (time.size() < 2)
    v.problem("time", "has " + std::to_string(time.size()) + " entries" + allowed);
}

// As many as times; and the body is at its place in the first row, from where its particles are.
void check_rows(CaseVisitor& v, const WallMotion& m) {
  const std::string times =
      " entries for " + std::to_string(m.time.size()) + " times: allowed: as many as times";
  if (m.displacement.size() != m.time.size())
    v.problem("displacement", std::to_string(m.displacement.size()) + times);
  if (!m.angle.empty() && m.angle.size() != m.time.size())
    v.problem("angle", std::to_string(m.angle.size()) + times);
  if (!m.displacement.empty() && norm(m.displacement.front()) != 0)
    v.problem("displacement",
              "does not begin with [0, 0, 0]: allowed: displacements from the place at the start");
  if (!m.angle.empty() && m.angle.front() != 0)
    v.problem("angle", "does not begin with 0: allowed: angles from the place at the start");
}

// A motion without any is none.
void require_one(CaseVisitor& v, std::initializer_list<const char*> keys) {
  if (!v.takes_defaults() || v.given(keys)) return;
  std::string names;
  for (const char* const name : keys) names += (names.empty() ? "" : " or ") + std::string(name);
  v.problem("", "without " + names + " it moves nothing: allowed: one of them, or both");
}

// Rows from a file stand in a resolved case as they were read. Whether they are there, rightly.
bool describe_motion_file(CaseVisitor& v, WallMotion& m, const std::string& case_file) {
  std::string name;
  if (!v.text(key("file",
                  "a CSV file in place of time, displacement and angle, its path relative to the case file: "
                  "columns as time_s, x_m, y_m, z_m, angle_rad or angle_deg; it counts from its first row")
                  .by_default("none")
                  .shorthand(),
              name))
    return false;
  const std::filesystem::path folder = std::filesystem::absolute(case_file).parent_path();
  const std::string fault = read_motion_file((folder / name).lexically_normal().string(), m);
  if (!fault.empty()) v.problem("file", "value " + in_quotes(name) + ": " + fault);
  for (const char* const other : {"time", "displacement", "angle"})
    if (v.given({other})) v.problem(other, "stands beside file: allowed: one of them");
  if (fault.empty()) check_times(v, m.time);
  return fault.empty();
}

// Whether times are known.
bool describe_row_keys(CaseVisitor& v, WallMotion& m) {
  Key time = key("time", "of the rows; the first row is zero").by_default("required without file");
  if (!v.given({"file"})) time.need = Need::required;
  const bool timed = v.numbers(time, m.time, times_allowed);
  if (timed) check_times(v, m.time);
  v.vectors(key("displacement", "one for each time"), m.displacement,
            "a list of [x, y, z] [m], one for each time");
  v.numbers(key("angle", "about axis, one for each time"), m.angle,
            "a list of angles [rad], one for each time");
  if (!v.given({"file"})) require_one(v, {"displacement", "angle"});
  return timed;
}

void describe_rows(CaseVisitor& v, WallMotion& m, const std::string& case_file) {
  const bool from_file = describe_motion_file(v, m, case_file);
  const std::vector<Vec3d> displacement = m.displacement;
  const std::vector<double> time = m.time, angle = m.angle;
  bool timed = describe_row_keys(v, m);
  if (from_file) m.time = time, m.displacement = displacement, m.angle = angle, timed = true;
  if (m.displacement.empty()) m.displacement.resize(m.time.size());
  if (timed) check_rows(v, m);
  const bool turns = !m.angle.empty();
  Key axis = key("axis", "of the angle, of any length").by_default("required with angle");
  if (turns) axis.need = Need::required;
  if ((turns || v.takes_defaults()) && v.vector(axis, m.axis, any_number("")) && norm(m.axis) == 0)
    v.problem("axis", "value [0, 0, 0] has no direction: allowed: any other");
  v.choice(key("interpolation", "smooth: a monotone cubic that starts and ends at rest"), m.interpolation,
           interpolation_names);
}

void describe_steady(CaseVisitor& v, WallMotion& m) {
  if (const auto with = v.only(m.kind == MotionKind::constant || m.kind == MotionKind::ramp,
                               {"type", {"constant", "ramp"}})) {
    require_one(v, {"velocity", "angular_velocity"});
    v.vector(key("velocity", "v, of the shift"), m.velocity, any_number("m/s"));
    v.vector(key("angular_velocity", "ω, about center"), m.angular_velocity, any_number("rad/s"));
  }
  if (const auto with = v.only(m.kind == MotionKind::ramp, {"type", {"ramp"}}))
    v.number(required("duration", "T, in which the velocity grows evenly"), m.ramp_time, above(0, "s"));
}

void describe_sine(CaseVisitor& v, WallMotion& m) {
  require_one(v, {"amplitude", "angular_amplitude"});
  v.vector(key("amplitude", "A, of the shift"), m.amplitude, any_number("m"));
  v.vector(key("angular_amplitude", "B, of the turn about center"), m.angular_amplitude, any_number("rad"));
  v.number(required("frequency", "f, of the sine"), m.frequency, above(0, "Hz"));
  v.number(key("phase", "φ, of the sine"), m.phase, any_number("rad"));
}

void describe_wall(CaseVisitor& v, Case& c, WallSpec& wall) {
  describe_own_name(v, required("name", "unique; letters, digits, _ - ."), c.walls, wall);
  describe_slip(v, wall);
  v.number(key("contact_angle", "θ in (20), of fluids with surface tension"), wall.contact_angle,
           between(0, 180, "degrees"));
  v.number(
      key("tension_limit",
          "adhesion: p_t of the wall's pairs with fluid in (11) and (12), up to "
          "numerics.tension_limit; auto: none, so that air gets between, and with numerics.tension = "
          "\"limit\" the fluid's. Where a wall holds better than the fluid itself, the fluid parts beside it")
          .or_word("auto", -1),
      wall.tension_limit, at_least(0, "Pa"));
  describe_wall_heat(v, c, wall);
  describe_surface(v, wall);
  v.number(key("remove_at", "the wall vanishes: a gate that is gone at once").by_default("never"),
           wall.motion.remove_at, at_least(0, "s"));
  v.inline_table(key("motion", "the wall moves as a rigid body, see Motion of walls").by_default("at rest"),
                 [&] { describe(v, wall.motion, c.file); });
  describe_shapes(v, required("shapes", "as of a region"), wall.shapes, c.file);
  describe_shapes(v, key("subtract", "as of a region"), wall.subtract, c.file);
}

}  // namespace

void describe(CaseVisitor& v, WallMotion& m, const std::string& case_file) {
  if (!v.choice(required("type", "see Motion of walls"), m.kind, motion_names)) return;
  describe_steady(v, m);
  if (const auto with = v.only(m.kind == MotionKind::sine, {"type", {"sine"}})) describe_sine(v, m);
  if (const auto with = v.only(m.kind == MotionKind::table, {"type", {"table"}}))
    describe_rows(v, m, case_file);
  if (const auto with = v.only(m.kind != MotionKind::rest, {"type", {"constant", "ramp", "table", "sine"}})) {
    v.vector(key("center", "of rotation, at the start; it moves along"), m.center, any_number("m"));
    v.number(key("start", "when the motion begins"), m.start, at_least(0, "s"));
    v.number(key("stop", "when it ends").by_default("never"), m.stop, above(m.start, "s, above start"));
  }
}

void describe_walls(CaseVisitor& v, Case& c) {
  v.list(key("wall", "none or more: solid bodies"), c.walls,
         [&](WallSpec& wall) { describe_wall(v, c, wall); });
  check_count(v, "wall", c.walls.size());
}

}  // namespace slagflow
