// The tables [[wall]] of a case file.
#include <algorithm>
#include <functional>

#include "host/case/case_sections.hpp"

namespace slagflow {

const std::vector<std::string> slip_names{"no_slip", "free_slip", "partial_slip"};
const std::vector<std::string> motion_names{"rest", "constant", "ramp", "table", "sine"};
const std::vector<std::string> interpolation_names{"linear", "smooth"};

namespace {

void read_slip(CaseTable& t, WallSpec& wall) {
  t.read_enum("slip", wall.slip, slip_names);
  if (wall.slip == WallSlip::partial_slip)
    t.read("slip_length", wall.slip_length, above(0, "m"), Need::required);
  else
    t.refuse("slip_length", "only slip = \"partial_slip\" has a slip length");
}

void read_surface(CaseTable& t, WallSpec& wall) {
  constexpr const char* keys[] = {"surface_velocity", "surface_angular_velocity", "surface_center"};
  if (wall.slip == WallSlip::free_slip) {
    for (const char* key : keys) t.refuse(key, "nothing of slip = \"free_slip\" drags the fluid along");
    return;
  }
  t.read(keys[0], wall.surface.velocity, any_number("m/s"));
  t.read(keys[1], wall.surface.angular_velocity, any_number("rad/s"));
  t.read(keys[2], wall.surface.center, any_number("m"));
}

void read_sine(CaseTable& t, WallMotion& m) {
  t.read("amplitude", m.amplitude, any_number("m"));
  t.read("angular_amplitude", m.angular_amplitude, any_number("rad"));
  t.read("frequency", m.frequency, above(0, "Hz"), Need::required);
  t.read("phase", m.phase, any_number("rad"));
}

const char* const times_allowed = "increasing times [s], at least two";

void check_times(CaseTable& t, const std::vector<double>& time) {
  const auto wrong = std::adjacent_find(time.begin(), time.end(), std::greater_equal<double>());
  const std::string allowed = std::string(": allowed: ") + times_allowed;
  if (wrong != time.end())
    t.problem("time", "value " + show(*(wrong + 1)) + " follows " + show(*wrong) + allowed);
  else if (time.size() < 2)
    t.problem("time", "has " + std::to_string(time.size()) + " entries" + allowed);
}

// As many as times; and the body is at its place in the first row, from where its particles are.
void check_rows(CaseTable& t, const WallMotion& m) {
  const std::string times =
      " entries for " + std::to_string(m.time.size()) + " times: allowed: as many as times";
  if (m.displacement.size() != m.time.size())
    t.problem("displacement", std::to_string(m.displacement.size()) + times);
  if (!m.angle.empty() && m.angle.size() != m.time.size())
    t.problem("angle", std::to_string(m.angle.size()) + times);
  if (!m.displacement.empty() && norm(m.displacement.front()) != 0)
    t.problem("displacement",
              "does not begin with [0, 0, 0]: allowed: displacements from the place at the start");
  if (!m.angle.empty() && m.angle.front() != 0)
    t.problem("angle", "does not begin with 0: allowed: angles from the place at the start");
}

void read_rows(CaseTable& t, WallMotion& m) {
  const bool timed = t.read("time", m.time, times_allowed);
  if (timed) check_times(t, m.time);
  if (!t.has("time")) t.problem("", std::string("lacks the key 'time': allowed: ") + times_allowed);
  t.read("displacement", m.displacement, "a list of [x, y, z] [m], one for each time");
  t.read("angle", m.angle, "a list of angles [rad], one for each time");
  if (m.displacement.empty()) m.displacement.resize(m.time.size());
  if (timed) check_rows(t, m);
  const bool turns = !m.angle.empty();
  if (t.read("axis", m.axis, any_number(""), turns ? Need::required : Need::optional) && norm(m.axis) == 0)
    t.problem("axis", "value [0, 0, 0] has no direction: allowed: any other");
  t.read_enum("interpolation", m.interpolation, interpolation_names);
}

void read_motion(CaseTable& wall, WallMotion& m) {
  wall.read("remove_at", m.remove_at, at_least(0, "s"));
  if (!wall.has("motion")) return;
  CaseTable t = wall.table("motion");
  if (!t.read_enum("type", m.kind, motion_names, Need::required)) return;
  if (m.kind == MotionKind::constant || m.kind == MotionKind::ramp) {
    t.read("velocity", m.velocity, any_number("m/s"));
    t.read("angular_velocity", m.angular_velocity, any_number("rad/s"));
  }
  if (m.kind == MotionKind::ramp) t.read("duration", m.ramp_time, above(0, "s"), Need::required);
  if (m.kind == MotionKind::sine) read_sine(t, m);
  if (m.kind == MotionKind::table) read_rows(t, m);
  if (m.kind != MotionKind::rest) {
    t.read("center", m.center, any_number("m"));
    t.read("start", m.start, at_least(0, "s"));
    t.read("stop", m.stop, above(m.start, "s, above start"));
  }
  t.finish();
}

}  // namespace

void read_walls(CaseTable& top, Case& c) {
  for (CaseTable& t : top.tables("wall", Need::optional)) {
    WallSpec wall;
    if (t.read("name", wall.name, Need::required)) check_name(t, wall.name);
    check_unique(t, c.walls, wall.name);
    read_slip(t, wall);
    t.read("contact_angle", wall.contact_angle, between(0, 180, "degrees"));
    if (!t.says("tension_limit", "auto"))
      t.read("tension_limit", wall.tension_limit, at_least(0, "Pa, or \"auto\""));
    read_surface(t, wall);
    read_motion(t, wall.motion);
    read_shapes(t, "shapes", Need::required, c.file, wall.shapes);
    read_shapes(t, "subtract", Need::optional, c.file, wall.subtract);
    t.finish();
    c.walls.push_back(wall);
  }
  check_count(top, "wall", c.walls.size());
}

}  // namespace slagflow
