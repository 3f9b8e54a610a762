// [[measure]]: what is measured of a flow.
#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"

namespace slagflow {
namespace {

const Words measure_names{"front", "jet", "flow_rate", "volume", "profile", "force", "level"};

void describe_direction(CaseVisitor& v, const Key& k, Direction& direction) {
  int index = index_of(direction);
  if (v.choice(k, index, direction_names)) direction = direction_of(index);
}

void describe_passing(CaseVisitor& v, MeasureSpec& m) {
  const bool front = m.type == MeasureType::front, jet = m.type == MeasureType::jet;
  if (const auto with = v.only(front || jet, {"type", {"front", "jet"}}))
    v.number(key("fraction", "of all fluid particles that must have passed"), m.fraction, inside(0, 1, ""));
  if (const auto with = v.only(front || m.type == MeasureType::flow_rate, {"type", {"front", "flow_rate"}})) {
    describe_direction(v, required("direction", "the way a front goes; of a flow rate across its plane"),
                       m.direction);
    v.number(required("position", "of the line or plane, along the axis of direction"), m.position,
             any_number("m"));
  }
  if (const auto with = v.only(jet, {"type", {"jet"}})) {
    v.vector(required("lip", "the dam's"), m.lip, any_number("m"));
    describe_direction(v, required("outward", "the horizontal direction away from the wall"), m.outward);
    v.number(required("bottom", "height at which the leading edge has arrived"), m.bottom, any_number("m"));
  }
}

void describe_volume(CaseVisitor& v, MeasureSpec& m) {
  v.vector(required("min", "lower corner of the box"), m.min, any_number("m"));
  v.vector(required("max", "upper corner of the box"), m.max, any_number("m"));
}

void describe_line(CaseVisitor& v, MeasureSpec& m) {
  v.vector(required("start", "of the line"), m.start, any_number("m"));
  v.vector(required("end", "of the line"), m.end, any_number("m"));
}

void describe_profile(CaseVisitor& v, MeasureSpec& m) {
  v.integer(key("points", "on the line, both ends included"), m.points, {2, 10000});
}

void describe_force(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  Words names;
  for (const WallSpec& wall : c.walls) names.push_back(wall.name);
  v.reference(required("wall", "name of the wall"), m.wall, names, "a wall");
  v.vector(key("about", "point of the torque"), m.about, any_number("m"));
}

void describe_measure(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  describe_own_name(v, required("name", "unique; letters, digits, _ - ."), c.measures, m);
  if (!v.choice(required("type", "see Measures"), m.type, measure_names)) return;
  describe_passing(v, m);
  if (const auto with = v.only(m.type == MeasureType::volume, {"type", {"volume"}})) describe_volume(v, m);
  if (const auto with = v.only(m.type == MeasureType::profile || m.type == MeasureType::level,
                               {"type", {"profile", "level"}}))
    describe_line(v, m);
  if (const auto with = v.only(m.type == MeasureType::profile, {"type", {"profile"}})) describe_profile(v, m);
  if (const auto with = v.only(m.type == MeasureType::force, {"type", {"force"}})) describe_force(v, c, m);
}

}  // namespace

void describe_measures(CaseVisitor& v, Case& c) {
  v.list(key("measure", "none or more: what is measured, up to 255 of a type"), c.measures,
         [&](MeasureSpec& m) { describe_measure(v, c, m); });
  std::vector<std::size_t> count(measure_names.size(), 0);
  for (const MeasureSpec& m : c.measures) ++count[static_cast<std::size_t>(m.type)];
  for (std::size_t type = 0; type < count.size(); ++type)
    check_count(v, "measure", count[type], " of type \"" + measure_names[type] + "\"");
}

}  // namespace slagflow
