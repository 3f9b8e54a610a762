// Shapes of regions and walls.
#include <filesystem>

#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"

namespace slagflow {
namespace {

const Words shape_names{"box", "plane",   "cylinder", "sphere",
                        "stl", "frustum", "prism"};  // in the order of ShapeSpec::form

void describe(CaseVisitor& v, BoxSpec& box, const std::string&) {
  const bool low = v.vector(required("min", "lower corner"), box.min, any_number("m"));
  const bool high = v.vector(required("max", "upper corner"), box.max, any_number("m"));
  if (!low || !high) return;
  for (int k = 0; k < 3; ++k) {
    if (box.min[k] < box.max[k]) continue;
    v.problem("max", "value " + show(box.max[k]) + " along " + axis_names[static_cast<std::size_t>(k)] +
                         " is not above min: allowed: > " + show(box.min[k]) + " [m]");
    return;
  }
}

void describe(CaseVisitor& v, PlaneSpec& plane, const std::string&) {
  v.vector(required("point", "any on the plane"), plane.point, any_number("m"));
  if (v.vector(required("normal", "of any length; the half-space is on the other side"), plane.normal,
               any_number("")) &&
      !(norm(plane.normal) > 0))
    v.problem("normal", "value [0, 0, 0] has no direction: allowed: a vector longer than 0");
}

void describe(CaseVisitor& v, CylinderSpec& cylinder, const std::string&) {
  const bool start = v.vector(required("start", "of the axis"), cylinder.start, any_number("m"));
  const bool end = v.vector(required("end", "of the axis"), cylinder.end, any_number("m"));
  if (start && end && !(norm(cylinder.end - cylinder.start) > 0))
    v.problem("end", "is the same point as start: allowed: another point");
  v.number(required("radius", "of a round shape"), cylinder.radius, above(0, "m"));
}

void describe(CaseVisitor& v, SphereSpec& sphere, const std::string&) {
  v.vector(required("center", "of the sphere"), sphere.center, any_number("m"));
  v.number(required("radius", "of a round shape"), sphere.radius, above(0, "m"));
}

void describe(CaseVisitor& v, StlSpec& stl, const std::string& case_file) {
  describe_stl(v, stl, case_file, "a closed triangle surface, or with thickness an open one");
  v.number(key("thickness", "makes a plate of a surface without a volume; 0: the surface is closed"),
           stl.thickness, at_least(0, "m"));
  if (const auto with = v.only(stl.thickness > 0, {"a thickness"}))
    v.choice(key("side",
                 "of the surface where the plate lies: back is where the normals do not look, middle half on "
                 "each side"),
             stl.side, {"back", "front", "middle"});
}

void describe(CaseVisitor& v, FrustumSpec& frustum, const std::string&) {
  const bool start = v.vector(required("start", "of the axis"), frustum.start, any_number("m"));
  const bool end = v.vector(required("end", "of the axis"), frustum.end, any_number("m"));
  if (start && end && !(norm(frustum.end - frustum.start) > 0))
    v.problem("end", "is the same point as start: allowed: another point");
  const bool one =
      v.number(required("start_radius", "at start; 0: a tip"), frustum.start_radius, at_least(0, "m"));
  const bool other =
      v.number(required("end_radius", "at end; 0: a tip"), frustum.end_radius, at_least(0, "m"));
  if (one && other && !(frustum.start_radius + frustum.end_radius > 0))
    v.problem("end_radius", "value 0 with start_radius 0: allowed: one of them above 0");
}

// Whether two edges of a polygon cross, neighbours aside.
bool crosses_itself(const std::vector<std::array<double, 2>>& p) {
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) - (p[b][1] - p[a][1]) * (p[c][0] - p[a][0]);
  };
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k == n - 1) continue;
      const std::size_t a = i, b = (i + 1) % n, c = k, d = (k + 1) % n;
      if (side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0) return true;
    }
  return false;
}

void describe(CaseVisitor& v, PrismSpec& prism, const std::string&) {
  v.choice(required("along", "the axis that the polygon is drawn out along"), prism.axis, axis_names);
  const std::string allowed =
      "at least three corners [m], [x, z] along y, [x, y] along z, [y, z] along x, in their order";
  if (v.pairs(required("points",
                       "corners of the polygon, which may have dents, in their order: [x, z] along y, [x, y] "
                       "along z, [y, z] along x"),
              prism.points, allowed)) {
    constexpr std::size_t most = 2000;
    if (prism.points.size() > most)
      v.problem("points", "has " + std::to_string(prism.points.size()) + " corners: allowed: up to " +
                              std::to_string(most) + "; finer surfaces are STL files");
    else if (prism.points.size() < 3)
      v.problem("points", "has " + std::to_string(prism.points.size()) + " corners: allowed: " + allowed);
    else if (crosses_itself(prism.points))
      v.problem("points",
                "makes edges that cross or touch: allowed: corners in their order around the polygon");
  }
  const bool from = v.number(required("from", "where it begins along the axis"), prism.from, any_number("m"));
  const bool to = v.number(required("to", "where it ends along the axis"), prism.to, any_number("m"));
  if (from && to && !(prism.from < prism.to))
    v.problem("to",
              "value " + show(prism.to) + " is not above from: allowed: > " + show(prism.from) + " [m]");
}

template <class Form>
void describe_form(CaseVisitor& v, ShapeSpec& shape, int kind, const std::string& case_file) {
  const ShapeSpec::Form form = Form();
  if (const auto with =
          v.only(kind == static_cast<int>(form.index()), {"shape", {shape_names[form.index()]}})) {
    if (shape.form.index() != form.index()) shape.form = form;
    describe(v, std::get<Form>(shape.form), case_file);
  }
}

// An STL file has a translate of its own, which comes first as well.
void describe_place(CaseVisitor& v, ShapeSpec& shape) {
  const bool stl = std::holds_alternative<StlSpec>(shape.form);
  if (const auto with = v.only(!stl, {"shape", {"box", "plane", "cylinder", "sphere", "frustum", "prism"}}))
    v.vector(key("translate", "moves the shape, before it is turned"), shape.move, any_number("m"));
  constexpr double turn = 6.283185307179586;
  if (v.vector(key("rotate", "turns the shape: the axis, as long as the angle, right-handed, up to a turn"),
               shape.turn, any_number("rad")) &&
      norm(shape.turn) > turn * (1 + 1e-6))
    v.problem("rotate", "is " + show(norm(shape.turn)) +
                            " rad long, more than a turn: allowed: up to 2 pi [rad]; 30 degrees are 0.5236");
  v.vector(key("rotate_about", "a point that the axis of rotate goes through"), shape.center,
           any_number("m"));
}

void describe_shape(CaseVisitor& v, ShapeSpec& shape, const std::string& case_file) {
  int kind = static_cast<int>(shape.form.index());
  if (!v.choice(required("shape", "see Shapes"), kind, shape_names)) return;
  describe_form<BoxSpec>(v, shape, kind, case_file);
  describe_form<PlaneSpec>(v, shape, kind, case_file);
  describe_form<CylinderSpec>(v, shape, kind, case_file);
  describe_form<SphereSpec>(v, shape, kind, case_file);
  describe_form<StlSpec>(v, shape, kind, case_file);
  describe_form<FrustumSpec>(v, shape, kind, case_file);
  describe_form<PrismSpec>(v, shape, kind, case_file);
  describe_place(v, shape);
  v.flag(key("outside", "everything outside of it: a container"), shape.outside);
}

}  // namespace

void describe_stl(CaseVisitor& v, StlSpec& stl, const std::string& case_file, const std::string& what) {
  namespace fs = std::filesystem;
  const bool given =
      v.text(required("file", what + ", binary or ASCII; the path is relative to the case file"), stl.file);
  v.number(key("scale", "length of the file's unit"), stl.scale, above(0, "m"));
  v.vector(key("translate", "added after scaling"), stl.translate, any_number("m"));
  if (!given) return;
  std::error_code failure;
  const fs::path folder = fs::absolute(fs::path(case_file), failure).parent_path();
  const fs::path path = (folder / stl.file).lexically_normal();  // an absolute file replaces the folder
  if (!fs::is_regular_file(path, failure))
    v.problem("file", "value " + in_quotes(stl.file) +
                          " is not a file that can be read: allowed: an STL file, " +
                          "its path relative to the case file");
  stl.file = path.string();
}

void describe_shapes(CaseVisitor& v, const Key& k, std::vector<ShapeSpec>& shapes,
                     const std::string& case_file) {
  v.list(
      k, shapes, [&](ShapeSpec& shape) { describe_shape(v, shape, case_file); }, "shape");
}

}  // namespace slagflow
