// [[inlet]] and [[outlet]]: where fluid comes in and goes out.
#include <algorithm>
#include <functional>
#include <iterator>

#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"
#include "host/case/keys_thermal.hpp"

namespace slagflow {
namespace {

const Words profile_names{"plug", "developed"};
const Words outlet_names{"box", "plane"};
const char* const rows_allowed =
    "rows [time [s], value], the times increasing, as in [[0, 0], [2, 0.5]], linear between them";

struct Feed {
  const char* name;
  const char* meaning;
  const char* unit;
};
const Feed feeds[]{{"velocity", "mean over the face", "m/s"},
                   {"volume_flow", "through the face; with two dimensions a metre of width", "m^3/s"},
                   {"mass_flow", "the same in mass", "kg/s"}};

std::string fault_of(const CaseVisitor::Rows& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto [time, value] = rows[k];
    if (!(time >= 0 && value >= 0 && time <= Range::largest && value <= Range::largest))
      return "row [" + show(time) + ", " + show(value) + "] is out of range: allowed: numbers >= 0";
    if (k > 0 && !(time > rows[k - 1][0]))
      return "time " + show(time) + " follows " + show(rows[k - 1][0]) + ": allowed: " + rows_allowed;
  }
  return "";
}

// One of three. A resolved case has the one that was given; one of --set takes the place of the file's.
void describe_feed(CaseVisitor& v, InletSpec& inlet) {
  const bool anew =
      std::any_of(std::begin(feeds), std::end(feeds), [&](const Feed& f) { return v.given_by_set(f.name); });
  int given = 0;
  for (int k = 0; k < 3; ++k) {
    if (!v.takes_defaults() && k != static_cast<int>(inlet.feed)) continue;
    const Feed& feed = feeds[k];
    CaseVisitor::Rows rows;
    if (!v.takes_defaults()) rows = inlet.rows;
    double value = inlet.value;
    const Key one =
        key(feed.name, std::string(feed.meaning) + ": one of velocity, volume_flow and mass_flow");
    const bool taken = !anew || v.given_by_set(feed.name);
    if (taken && v.given({feed.name})) ++given;
    if (!v.number_or_rows(Key(one).by_default("one of the three is required"), value, at_least(0, feed.unit),
                          rows, rows_allowed) ||
        !taken)
      continue;
    inlet.feed = static_cast<InletFeed>(k), inlet.value = value, inlet.rows = rows;
    const std::string fault = fault_of(rows);
    if (!fault.empty()) v.problem(feed.name, fault);
  }
  if (v.takes_defaults() && given != 1)
    v.problem("", given == 0 ? "has none of velocity, volume_flow and mass_flow: allowed: one of them"
                             : "has more than one of velocity, volume_flow and mass_flow: allowed: one");
}

void describe_rectangle(CaseVisitor& v, const Case& c, InletSpec& inlet) {
  Key width = key("width", "across up and normal").by_default("required with three dimensions");
  if (c.dimensions == 3) width.need = Need::required;
  const auto with = v.only(c.dimensions == 3, {"dimensions = 3"});
  if (with) {
    v.number(width, inlet.width, above(0, "m"));
    v.vector(key("up", "along the height, made square to normal; [0, 0, 0]: as much upwards as that allows"),
             inlet.up, any_number(""));
  }
}

void describe_face(CaseVisitor& v, const Case& c, InletSpec& inlet) {
  const InletFace face = inlet.face;
  if (const auto with = v.only(face != InletFace::stl, {"face", {"rectangle", "disc", "annulus"}}))
    v.vector(required("center", "of the face"), inlet.center, any_number("m"));
  if (const auto with = v.only(face == InletFace::rectangle, {"face", {"rectangle"}})) {
    v.number(required("height", "of the face"), inlet.height, above(0, "m"));
    describe_rectangle(v, c, inlet);
  }
  if (const auto with =
          v.only(face == InletFace::disc || face == InletFace::annulus, {"face", {"disc", "annulus"}}))
    v.number(required("radius", "of the face"), inlet.radius, above(0, "m"));
  if (const auto with = v.only(face == InletFace::annulus, {"face", {"annulus"}}))
    if (v.number(required("inner_radius", "of the ring, below radius"), inlet.inner_radius, above(0, "m")) &&
        !(inlet.inner_radius < inlet.radius))
      v.problem("inner_radius", "value " + show(inlet.inner_radius) + " is not below radius: allowed: < " +
                                    show(inlet.radius) + " [m]");
  if (const auto with = v.only(face == InletFace::stl, {"face", {"stl"}}))
    describe_stl(v, inlet.stl, c.file,
                 "a flat patch of triangles, its outline the face's; it need not be closed");
}

void describe_inlet(CaseVisitor& v, Case& c, InletSpec& inlet) {
  describe_own_name(v, required("name", "unique; letters, digits, _ - ."), c.inlets, inlet);
  describe_fluid_of(v, c, inlet.fluid);
  if (v.choice(required("face", "see Inlets and outlets"), inlet.face, face_names))
    describe_face(v, c, inlet);
  if (v.vector(required("normal", "the way the fluid goes, square to the face, of any length"), inlet.normal,
               any_number("")) &&
      !(norm(inlet.normal) > 0))
    v.problem("normal", "value [0, 0, 0] has no direction: allowed: a vector longer than 0");
  describe_feed(v, inlet);
  describe_start_temperature(v, c, required("temperature", "of what comes in"), inlet.temperature);
  v.number(key("start", "of the feed"), inlet.start, at_least(0, "s"));
  v.number(key("stop", "of the feed").by_default("never"), inlet.stop, above(inlet.start, "s, above start"));
  v.choice(key("profile",
               "of the speed over the face. developed: as far down a pipe, an annulus or, across the shorter "
               "side, a slot, of this fluid at the largest speed"),
           inlet.profile, profile_names);
  if (inlet.profile == InletProfile::developed && inlet.face == InletFace::stl)
    v.problem("profile", "value \"developed\" with face = \"stl\": allowed: plug");
}

void describe_outlet(CaseVisitor& v, Case& c, OutletSpec& outlet) {
  describe_own_name(v, required("name", "unique; letters, digits, _ - ."), c.outlets, outlet);
  if (!v.choice(required("shape", "of what takes fluid away, see Inlets and outlets"), outlet.shape,
                outlet_names))
    return;
  if (const auto with = v.only(outlet.shape == OutletShape::box, {"shape", {"box"}})) {
    v.vector(required("min", "lower corner"), outlet.min, any_number("m"));
    v.vector(required("max", "upper corner"), outlet.max, any_number("m"));
  }
  if (const auto with = v.only(outlet.shape == OutletShape::plane, {"shape", {"plane"}})) {
    int index = index_of(outlet.direction);
    if (v.choice(required("direction", "all beyond the plane this way is taken away"), index,
                 direction_names))
      outlet.direction = direction_of(index);
    v.number(required("position", "of the plane, along the axis of direction"), outlet.position,
             any_number("m"));
  }
}

}  // namespace

void describe_fluid_of(CaseVisitor& v, const Case& c, int& fluid) {
  Words names;
  for (const FluidSpec& f : c.fluids) names.push_back(f.name);
  Key k = key("fluid", "NAME of a fluid").by_default("the only one");
  if (names.size() > 1) k.need = Need::required;
  v.reference(k, fluid, names, "a fluid");
}

void describe_openings(CaseVisitor& v, Case& c) {
  v.list(key("inlet", "none or more: faces that fluid comes through"), c.inlets,
         [&](InletSpec& inlet) { describe_inlet(v, c, inlet); });
  check_count(v, "inlet", c.inlets.size() + c.walls.size(), " of [[inlet]] and [[wall]]");
  v.list(key("outlet", "none or more: where fluid is taken away and counted"), c.outlets,
         [&](OutletSpec& outlet) { describe_outlet(v, c, outlet); });
  constexpr std::size_t most = 240;  // particles keep the index of their exit in one byte
  if (c.outlets.size() > most)
    v.problem("outlet",
              std::to_string(c.outlets.size()) + " entries: allowed: up to " + std::to_string(most));
  if (v.takes_defaults() && c.regions.empty() && c.inlets.empty() && !v.given({"region"}) &&
      !v.given({"inlet"}))
    v.problem("region", "missing: required: at least one [[region]] or [[inlet]]");
}

}  // namespace slagflow
