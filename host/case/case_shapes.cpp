// Shapes of regions and walls.
#include <filesystem>

#include "host/case/case_sections.hpp"

namespace slagflow {
namespace {

void read_form(CaseTable& t, BoxSpec& box) {
  const bool low = t.read("min", box.min, any_number("m"), Need::required);
  const bool high = t.read("max", box.max, any_number("m"), Need::required);
  if (!low || !high) return;
  for (int k = 0; k < 3; ++k) {
    if (box.min[k] < box.max[k]) continue;
    t.problem("max", "value " + show(box.max[k]) + " along " + axis_names[static_cast<std::size_t>(k)] +
                         " is not above min: allowed: > " + show(box.min[k]) + " [m]");
    return;
  }
}

void read_form(CaseTable& t, PlaneSpec& plane) {
  t.read("point", plane.point, any_number("m"), Need::required);
  if (t.read("normal", plane.normal, any_number(""), Need::required) && !(norm(plane.normal) > 0))
    t.problem("normal", "value [0, 0, 0] has no direction: allowed: a vector longer than 0");
}

void read_form(CaseTable& t, CylinderSpec& cylinder) {
  const bool start = t.read("start", cylinder.start, any_number("m"), Need::required);
  const bool end = t.read("end", cylinder.end, any_number("m"), Need::required);
  if (start && end && !(norm(cylinder.end - cylinder.start) > 0))
    t.problem("end", "is the same point as start: allowed: another point");
  t.read("radius", cylinder.radius, above(0, "m"), Need::required);
}

void read_form(CaseTable& t, SphereSpec& sphere) {
  t.read("center", sphere.center, any_number("m"), Need::required);
  t.read("radius", sphere.radius, above(0, "m"), Need::required);
}

void read_stl(CaseTable& t, StlSpec& stl, const std::string& case_file) {
  namespace fs = std::filesystem;
  t.read("scale", stl.scale, above(0, "m"));
  t.read("translate", stl.translate, any_number("m"));
  if (!t.read("file", stl.file, Need::required)) return;
  std::error_code failure;
  const fs::path folder = fs::absolute(fs::path(case_file), failure).parent_path();
  const fs::path path = (folder / stl.file).lexically_normal();  // an absolute file replaces the folder
  if (!fs::is_regular_file(path, failure))
    t.problem("file", "value \"" + stl.file + "\" is not a file that can be read: allowed: an STL file, " +
                          "its path relative to the case file");
  stl.file = path.string();
}

ShapeSpec read_shape(CaseTable& t, const std::string& case_file) {
  ShapeSpec shape;
  int kind = 0;
  if (!t.read_choice("shape", kind, {"box", "plane", "cylinder", "sphere", "stl"}, Need::required))
    return shape;
  t.read("outside", shape.outside);
  switch (kind) {
    case 0:
      read_form(t, shape.form.emplace<BoxSpec>());
      break;
    case 1:
      read_form(t, shape.form.emplace<PlaneSpec>());
      break;
    case 2:
      read_form(t, shape.form.emplace<CylinderSpec>());
      break;
    case 3:
      read_form(t, shape.form.emplace<SphereSpec>());
      break;
    default:
      read_stl(t, shape.form.emplace<StlSpec>(), case_file);
  }
  t.finish();
  return shape;
}

}  // namespace

bool read_shapes(CaseTable& parent, const char* key, Need need, const std::string& case_file,
                 std::vector<ShapeSpec>& shapes) {
  for (CaseTable& t : parent.tables(key, need)) shapes.push_back(read_shape(t, case_file));
  return !shapes.empty();
}

}  // namespace slagflow
