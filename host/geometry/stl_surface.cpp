#include "host/geometry/stl_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/error.hpp"
#include "host/geometry/stl_plate.hpp"

namespace slagflow {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;

// Nearest point of a triangle (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
Vec3d nearest_in(const Triangle& t, Vec3d p) {
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0];
  const Vec3d ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + (d1 / (d1 - d3)) * ab;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return t[1] + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]);
  const double inverse = 1 / (va + vb + vc);
  return t[0] + (vb * inverse) * ab + (vc * inverse) * ac;
}

// +1 where a ray leaves through the triangle, -1 where it enters, 0 where it misses (Moeller and Trumbore).
int crossing(const Triangle& t, Vec3d p, Vec3d direction) {
  const Vec3d e1 = t[1] - t[0], e2 = t[2] - t[0];
  const Vec3d h = cross(direction, e2);
  const double det = dot(e1, h);
  if (det == 0) return 0;
  const Vec3d s = p - t[0];
  const double u = dot(s, h) / det;
  if (u < 0 || u > 1) return 0;
  const Vec3d q = cross(s, e1);
  const double v = dot(direction, q) / det;
  if (v < 0 || u + v > 1 || dot(e2, q) / det <= 0) return 0;
  return det < 0 ? 1 : -1;
}

// Solid angle of a triangle seen from p (Van Oosterom and Strackee 1983).
double solid_angle(const Triangle& t, Vec3d p) {
  const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

struct Bounds : Extents {
  double squared_distance(Vec3d p) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += square(std::max({lower[k] - p[k], p[k] - upper[k], 0.0}));
    return sum;
  }
  bool met_by(Vec3d p, Vec3d inverse) const {
    double enter = 0, leave = infinity;
    for (int k = 0; k < 3; ++k) {
      const double a = (lower[k] - p[k]) * inverse[k], b = (upper[k] - p[k]) * inverse[k];
      enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave * (1 + 1e-12);
  }
};

// A binary tree of boxes over the triangles.
class Surface final : public Form {
 public:
  explicit Surface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
    nodes_.reserve(triangles_.size());
    split(0, triangles_.size());
    const Bounds& all = nodes_.front().bounds;
    far_ = 0.01 * norm(all.upper - all.lower);
  }

  double distance(Vec3d p) const override {
    const double from_box = std::sqrt(nodes_.front().bounds.squared_distance(p));
    if (from_box > far_) return from_box;  // less than the distance, and enough to know that p is far
    const double d = std::sqrt(squared_distance(p));
    return inside(p) ? -d : d;
  }
  Extents extents() const override { return nodes_.front().bounds; }
  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override { add_feet(p, 1, feet); }
  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override { add_feet(p, -1, feet); }

  // The nearest face may border no open space, as where a body ends at the domain or touches another; and a
  // plate has an opposite face.
  void further_feet(Vec3d p, double side, double reach, std::vector<Foot>& feet) const override {
    walk(
        0, [&](const Bounds& b) { return b.squared_distance(p) <= reach * reach; },
        [&](const Triangle& t) {
          const Vec3d area = cross(t[1] - t[0], t[2] - t[0]);
          if (!(norm(area) > 0)) return;
          const Vec3d normal = area * (side / norm(area));
          const double depth = dot(t[0] - p, normal);
          if (depth < 0 || depth > reach) return;
          const Vec3d foot = p + depth * normal;
          if (norm(nearest_in(t, p) - foot) < 1e-5 * far_) feet.push_back({foot, normal});
        });
  }

 private:
  static constexpr std::size_t leaf_size = 4;
  struct Node {
    Bounds bounds;
    std::size_t first, last;  // triangles
    std::size_t right;        // second child, 0 in a leaf; the first child follows its parent
  };

  std::size_t split(std::size_t first, std::size_t last) {
    const std::size_t index = nodes_.size();
    Bounds bounds, centers;
    for (std::size_t t = first; t < last; ++t) {
      for (const Vec3d& corner : triangles_[t]) bounds.add(corner);
      centers.add(triangles_[t][0] + triangles_[t][1] + triangles_[t][2]);
    }
    nodes_.push_back({bounds, first, last, 0});
    if (last - first <= leaf_size) return index;
    const Vec3d extent = centers.upper - centers.lower;
    const int xy = extent.y > extent.x ? 1 : 0;
    const int axis = extent.z > extent[xy] ? 2 : xy;
    const std::size_t middle = first + (last - first) / 2;
    const auto before = [axis](const Triangle& a, const Triangle& b) {
      return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
    };
    const auto at = [&](std::size_t t) { return triangles_.begin() + static_cast<std::ptrdiff_t>(t); };
    std::nth_element(at(first), at(middle), at(last), before);
    split(first, middle);
    const std::size_t right = split(middle, last);
    nodes_[index].right = right;
    return index;
  }

  // Calls visit for each triangle of the leaves whose box, and whose boxes above, are wanted.
  template <class Wanted, class Visit>
  void walk(std::size_t node, const Wanted& wanted, const Visit& visit) const {
    const Node& n = nodes_[node];
    if (!wanted(n.bounds)) return;
    if (n.right == 0) {
      for (std::size_t t = n.first; t < n.last; ++t) visit(triangles_[t]);
    } else {
      walk(node + 1, wanted, visit);
      walk(n.right, wanted, visit);
    }
  }

  void shrink_to_nearest(std::size_t node, Vec3d p, double& best) const {
    const Node& n = nodes_[node];
    if (n.right == 0) {
      for (std::size_t t = n.first; t < n.last; ++t) {
        const Vec3d gap = nearest_in(triangles_[t], p) - p;
        best = std::min(best, dot(gap, gap));
      }
      return;
    }
    std::size_t near = node + 1, far = n.right;
    double to_near = nodes_[near].bounds.squared_distance(p), to_far = nodes_[far].bounds.squared_distance(p);
    if (to_far < to_near) std::swap(near, far), std::swap(to_near, to_far);
    if (to_near < best) shrink_to_nearest(near, p, best);
    if (to_far < best) shrink_to_nearest(far, p, best);
  }

  double squared_distance(Vec3d p) const {
    double best = infinity;
    shrink_to_nearest(0, p, best);
    return best;
  }

  int winding(Vec3d p, Vec3d direction) const {
    const Vec3d inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
    int sum = 0;
    walk(
        0, [&](const Bounds& b) { return b.met_by(p, inverse); },
        [&](const Triangle& t) { sum += crossing(t, p, direction); });
    return sum;
  }

  // Two rays in general directions must agree on the winding number; where one grazes an edge, the solid
  // angle of the whole surface decides.
  bool inside(Vec3d p) const {
    if (nodes_.front().bounds.squared_distance(p) > 0) return false;
    const int first = winding(p, {0.5377, 0.7313, 0.4196}), second = winding(p, {-0.6139, 0.3491, -0.7081});
    if (first == second) return first != 0;
    double angle = 0;
    for (const Triangle& t : triangles_) angle += solid_angle(t, p);
    return std::abs(angle) > 2 * pi;
  }

  // Planes of all triangles that are nearest: at an edge or corner there are several, and the plane that
  // continues a face is what a wall particle behind it needs. Where p is beyond all these planes, as it may
  // be behind a corner at which the surface is a saddle, the way to the nearest point stands for them.
  // side: +1 from inside, -1 from outside.
  void add_feet(Vec3d p, double side, std::vector<Foot>& feet) const {
    const double nearest = squared_distance(p);
    const double limit = nearest * (1 + 1e-6) + 1e-20 * far_ * far_;
    const std::size_t first = feet.size();
    Foot straight;
    walk(
        0, [&](const Bounds& b) { return b.squared_distance(p) <= limit; },
        [&](const Triangle& t) {
          const Vec3d gap = nearest_in(t, p) - p;
          const Vec3d area = cross(t[1] - t[0], t[2] - t[0]);
          if (dot(gap, gap) > limit || !(norm(area) > 0)) return;
          const Vec3d normal = area * (side / norm(area));
          straight = {p + gap, norm(gap) > 0 ? gap * (1 / norm(gap)) : normal};
          const double depth = dot(t[0] - p, normal);
          const auto same = [&](const Foot& f) { return dot(f.normal, normal) > 1 - 1e-9; };
          const bool known = std::any_of(feet.begin() + static_cast<std::ptrdiff_t>(first), feet.end(), same);
          if (depth >= 0 && !known) feet.push_back({p + depth * normal, normal});
        });
    if (feet.size() == first && norm(straight.normal) > 0) feet.push_back(straight);
  }

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double far_ = 0;
};

}  // namespace

std::shared_ptr<const Form> make_surface_form(std::vector<Triangle> triangles) {
  return std::make_shared<Surface>(std::move(triangles));
}

std::shared_ptr<const Form> make_stl_form(const StlSpec& spec) {
  const bool open = spec.thickness > 0;
  std::vector<Triangle> triangles = read_stl(spec.file);
  if (!open) triangles = closed_surface(triangles, spec.file);
  for (Triangle& t : triangles)
    for (Vec3d& corner : t) {
      corner = spec.scale * corner + spec.translate;
      if (!(std::abs(corner.x) + std::abs(corner.y) + std::abs(corner.z) < 1e30))
        throw InputError(spec.file + ": a corner is beyond 1e30 m after scaling");
    }
  if (open) triangles = closed_surface(plate(triangles, spec.thickness, spec.side, spec.file), spec.file);
  return make_surface_form(std::move(triangles));
}

}  // namespace slagflow
