#include "host/geometry/shapes_drawn.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slagflow {
namespace {

// Any unit vector across the given one.
Vec3d any_across(Vec3d axis) {
  const Vec3d helper = std::abs(axis.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d v = cross(axis, helper);
  return v * (1 / norm(v));
}

double cross_of(std::array<double, 2> a, std::array<double, 2> b) { return a[0] * b[1] - a[1] * b[0]; }

// Convex: the largest of the distances from its faces bounds that from it.
class Frustum final : public Form {
 public:
  explicit Frustum(const FrustumSpec& s)
      : start_(s.start),
        length_(norm(s.end - s.start)),
        axis_((s.end - s.start) * (1 / length_)),
        start_radius_(s.start_radius),
        end_radius_(s.end_radius) {
    const double rise = (start_radius_ - end_radius_) / length_, scale = 1 / std::hypot(1, rise);
    out_ = scale, along_ = rise * scale;
  }

  double distance(Vec3d p) const override {
    const AxisParts at = parts(p);
    return std::max({side(at), -at.along, at.along - length_});
  }

  Extents extents() const override {
    Extents all;
    for (const auto& [end, radius] :
         {std::pair{start_, start_radius_}, {start_ + length_ * axis_, end_radius_}}) {
      Vec3d half;
      for (int k = 0; k < 3; ++k) half[k] = radius * std::sqrt(std::max(0.0, 1 - axis_[k] * axis_[k]));
      all.add(end - half), all.add(end + half);
    }
    return all;
  }

  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    const AxisParts at = parts(p);
    feet.push_back({p - side(at) * normal(at), normal(at)});
    feet.push_back({p - at.along * axis_, -axis_});
    feet.push_back({p + (length_ - at.along) * axis_, axis_});
  }

  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    const AxisParts at = parts(p);
    if (side(at) >= 0) feet.push_back({p - side(at) * normal(at), -normal(at)});
    if (at.along <= 0) feet.push_back({p - at.along * axis_, axis_});
    if (at.along >= length_) feet.push_back({p + (length_ - at.along) * axis_, -axis_});
  }

 private:
  AxisParts parts(Vec3d p) const {
    return parts_about(start_, axis_, p, 1e-12 * (start_radius_ + end_radius_));
  }
  // Distance from the cone that the side lies on, and its normal.
  double side(const AxisParts& at) const { return out_ * (at.radius - start_radius_) + along_ * at.along; }
  Vec3d normal(const AxisParts& at) const { return out_ * at.radial + along_ * axis_; }

  Vec3d start_;
  double length_;
  Vec3d axis_;
  double start_radius_, end_radius_;
  double out_, along_;  // of the side's normal
};

class Prism final : public Form {
 public:
  explicit Prism(const PrismSpec& s) : axis_(s.axis), from_(s.from), to_(s.to), points_(s.points) {
    double area = 0;
    for (std::size_t k = 0; k < points_.size(); ++k) area += cross_of(points_[k], next(k));
    if (area < 0) std::reverse(points_.begin(), points_.end());  // the inside is to the left of an edge
  }

  double distance(Vec3d p) const override {
    const double flat = flat_distance(flattened(p)), cap = std::max(from_ - p[axis_], p[axis_] - to_);
    return flat > 0 && cap > 0 ? std::hypot(flat, cap) : std::max(flat, cap);
  }

  Extents extents() const override {
    Extents all;
    for (const auto& point : points_)
      for (const double along : {from_, to_}) all.add(placed(point, along));
    return all;
  }

  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    add_caps(p, 1, feet);
    add_edges(p, 1, feet);
  }
  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    if (p[axis_] <= from_ || p[axis_] >= to_) add_caps(p, -1, feet);
    add_edges(p, -1, feet);
  }

 private:
  using Point = std::array<double, 2>;

  const Point& next(std::size_t k) const { return points_[(k + 1) % points_.size()]; }
  int first() const { return axis_ == 0 ? 1 : 0; }
  int second() const { return axis_ == 2 ? 1 : 2; }
  Point flattened(Vec3d p) const { return {p[first()], p[second()]}; }
  Vec3d placed(const Point& q, double along) const {
    Vec3d p;
    p[axis_] = along, p[first()] = q[0], p[second()] = q[1];
    return p;
  }

  double flat_distance(const Point& q) const {
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Point &a = points_[k], &b = next(k);
      const Point way{b[0] - a[0], b[1] - a[1]}, from{q[0] - a[0], q[1] - a[1]};
      const double t =
          std::clamp((from[0] * way[0] + from[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]), 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(from[0] - t * way[0], from[1] - t * way[1]));
      if ((a[1] > q[1]) != (b[1] > q[1]) && q[0] < a[0] + way[0] * (q[1] - a[1]) / way[1]) inside = !inside;
    }
    return inside ? -nearest : nearest;
  }

  void add_caps(Vec3d p, double side, std::vector<Foot>& feet) const {
    Vec3d low, high;
    low[axis_] = -side, high[axis_] = side;
    Vec3d at = p;
    at[axis_] = from_;
    if (side > 0 || p[axis_] <= from_) feet.push_back({at, low});
    at[axis_] = to_;
    if (side > 0 || p[axis_] >= to_) feet.push_back({at, high});
  }

  // Of the edges that p is beyond by less than it is off their ends, as next to corners; further along it is
  // another face's.
  void add_edges(Vec3d p, double side, std::vector<Foot>& feet) const {
    const Point q = flattened(p);
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Point &a = points_[k], &b = next(k);
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      const Point way{(b[0] - a[0]) / length, (b[1] - a[1]) / length}, from{q[0] - a[0], q[1] - a[1]};
      const double along = from[0] * way[0] + from[1] * way[1], left = cross_of(way, from);
      if (side * left < 0) continue;
      const double beyond = std::max(-along, along - length);
      if (beyond > 1.5 * std::abs(left)) continue;
      const Vec3d normal = side * placed({way[1], -way[0]}, 0);
      feet.push_back({placed({a[0] + along * way[0], a[1] + along * way[1]}, p[axis_]), normal});
    }
  }

  int axis_;
  double from_, to_;
  std::vector<Point> points_;
};

}  // namespace

std::shared_ptr<const Form> make_frustum(const FrustumSpec& s) { return std::make_shared<Frustum>(s); }
std::shared_ptr<const Form> make_prism(const PrismSpec& s) { return std::make_shared<Prism>(s); }

AxisParts parts_about(Vec3d start, Vec3d axis, Vec3d p, double none) {
  const double along = dot(p - start, axis);
  const Vec3d away = p - start - along * axis;
  const double radius = norm(away);
  return {along, radius, radius > none ? away * (1 / radius) : any_across(axis)};
}

}  // namespace slagflow
