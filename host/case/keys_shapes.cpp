// Shapes of regions and walls.
#include <filesystem>

#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"

namespace slagflow {
namespace {

const Words shape_names{"box", "plane", "cylinder", "sphere", "stl"};  // in the order of ShapeSpec::form

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
  describe_stl(v, stl, case_file, "a closed triangle surface");
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

void describe_shape(CaseVisitor& v, ShapeSpec& shape, const std::string& case_file) {
  int kind = static_cast<int>(shape.form.index());
  if (!v.choice(required("shape", "see Shapes"), kind, shape_names)) return;
  describe_form<BoxSpec>(v, shape, kind, case_file);
  describe_form<PlaneSpec>(v, shape, kind, case_file);
  describe_form<CylinderSpec>(v, shape, kind, case_file);
  describe_form<SphereSpec>(v, shape, kind, case_file);
  describe_form<StlSpec>(v, shape, kind, case_file);
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
