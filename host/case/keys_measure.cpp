// [[measure]]: what is measured of a flow.
#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"

namespace slagflow {
namespace {

const Words measure_names{"front", "jet",     "flow_rate", "volume",    "profile", "force", "level",
                          "flux",  "surface", "contact",   "residence", "mixing",  "solid", "heat"};

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

// A line, or lines side by side.
void describe_points(CaseVisitor& v, MeasureSpec& m) {
  const bool surface = m.type == MeasureType::surface;
  if (const auto with = v.only(m.type == MeasureType::profile || surface, {"type", {"profile", "surface"}}))
    v.integer(key("points", "on the line, both ends included"), m.points, {2, 10000});
  if (const auto with = v.only(surface, {"type", {"surface"}})) {
    v.integer(key("rows",
                  "lines side by side, the first and the last included: a grid; points times rows "
                  "up to 100000"),
              m.rows, {1, 10000});
    v.vector(key("across", "from the first line to the last, where there are more than one"), m.across,
             any_number("m"));
    if (m.rows > 1 && norm(m.across) == 0)
      v.problem("across", "is [0, 0, 0] with " + std::to_string(m.rows) +
                              " rows: allowed: another vector, from the first line to the last");
    if (m.points * m.rows > 100000)
      v.problem("rows", "value " + std::to_string(m.rows) + " makes " + std::to_string(m.points * m.rows) +
                            " columns: allowed: points times rows up to 100000");
  }
}

void describe_wall_of(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  const bool force = m.type == MeasureType::force;
  if (const auto with = v.only(force || m.type == MeasureType::contact || m.type == MeasureType::heat,
                               {"type", {"force", "contact", "heat"}})) {
    Words names;
    for (const WallSpec& wall : c.walls) names.push_back(wall.name);
    v.reference(required("wall", "name of the wall"), m.wall, names, "a wall");
  }
  if (const auto with = v.only(force, {"type", {"force"}}))
    v.vector(key("about", "point of the torque"), m.about, any_number("m"));
}

// As the rectangle of an inlet.
void describe_flux(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  v.vector(required("center", "of the rectangle"), m.center, any_number("m"));
  if (v.vector(required("normal", "square to the rectangle, of any length: the way that counts as forward"),
               m.normal, any_number("")) &&
      norm(m.normal) == 0)
    v.problem("normal", "value [0, 0, 0]: allowed: a vector of any length above 0");
  v.number(required("height", "of the rectangle"), m.height, above(0, "m"));
  if (const auto with = v.only(c.dimensions == 3, {"dimensions = 3"})) {
    Key width = key("width", "across up and normal").by_default("required with three dimensions");
    if (c.dimensions == 3) width.need = Need::required;
    v.number(width, m.width, above(0, "m"));
    v.vector(key("up", "along the height, made square to normal; [0, 0, 0]: as much upwards as that allows"),
             m.up, any_number(""));
  }
}

// A case with one fluid has nothing that mixes.
void describe_mixing(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  Words names;
  for (const FluidSpec& fluid : c.fluids) names.push_back(fluid.name);
  v.reference(required("fluid", "name of the fluid whose share is looked at"), m.fluid, names, "a fluid");
  v.number(key("cell", "side of the cells").by_default("five spacings"), m.cell, at_least(0, "m"));
  if (c.fluids.size() == 1)
    v.problem(
        "type",
        "value \"mixing\" with one fluid: allowed: two or more, which may be alike: they tell what comes "
        "from where");
}

void describe_residence(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  Words names;
  for (const OutletSpec& outlet : c.outlets) names.push_back(outlet.name);
  v.reference(required("outlet", "name of the outlet that the fluid leaves through"), m.outlet, names,
              "an outlet");
}

void describe_measure(CaseVisitor& v, const Case& c, MeasureSpec& m) {
  describe_own_name(v, required("name", "unique; letters, digits, _ - ."), c.measures, m);
  if (!v.choice(required("type", "see Measures"), m.type, measure_names)) return;
  describe_passing(v, m);
  const bool box = m.type == MeasureType::volume || m.type == MeasureType::mixing;
  if (const auto with = v.only(box || m.type == MeasureType::solid, {"type", {"volume", "mixing", "solid"}}))
    describe_volume(v, m);
  if (const auto with = v.only(m.type == MeasureType::solid, {"type", {"solid"}}))
    v.number(key("solid_fraction", "the least with which fluid counts"), m.solid_fraction,
             above_to(0, 1, ""));
  const bool of_heat = m.type == MeasureType::solid || m.type == MeasureType::heat;
  if (of_heat && !c.thermal.on)
    v.problem("type", "needs heat, which is off: allowed: with a table [thermal], or another type");
  const auto is = [&](MeasureType type) { return m.type == type; };
  if (const auto with = v.only(is(MeasureType::profile) || is(MeasureType::level) || is(MeasureType::surface),
                               {"type", {"profile", "level", "surface"}}))
    describe_line(v, m);
  describe_points(v, m);
  describe_wall_of(v, c, m);
  if (const auto with = v.only(is(MeasureType::flux), {"type", {"flux"}})) describe_flux(v, c, m);
  if (const auto with = v.only(is(MeasureType::mixing), {"type", {"mixing"}})) describe_mixing(v, c, m);
  if (const auto with = v.only(is(MeasureType::residence), {"type", {"residence"}}))
    describe_residence(v, c, m);
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
