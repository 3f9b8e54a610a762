#include "host/geometry/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/geometry/shapes_drawn.hpp"
#include "host/geometry/stl_surface.hpp"

namespace slagflow {
namespace {

Vec3d unit(int axis, double sign) {
  Vec3d v;
  v[axis] = sign;
  return v;
}

Vec3d projected(Vec3d p, int axis, double coordinate) {
  p[axis] = coordinate;
  return p;
}

class Box final : public Form {
 public:
  explicit Box(const BoxSpec& s) : min_(s.min), max_(s.max) {}

  double distance(Vec3d p) const override {
    double inside = -std::numeric_limits<double>::infinity(), outside = 0;
    for (int k = 0; k < 3; ++k) {
      const double beyond = std::max(min_[k] - p[k], p[k] - max_[k]);
      inside = std::max(inside, beyond);
      if (beyond > 0) outside += beyond * beyond;
    }
    return inside > 0 ? std::sqrt(outside) : inside;
  }

  Extents extents() const override { return {min_, max_}; }

  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    for (int k = 0; k < 3; ++k) {
      feet.push_back({projected(p, k, min_[k]), unit(k, -1)});
      feet.push_back({projected(p, k, max_[k]), unit(k, 1)});
    }
  }

  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    for (int k = 0; k < 3; ++k) {
      if (p[k] <= min_[k]) feet.push_back({projected(p, k, min_[k]), unit(k, 1)});
      if (p[k] >= max_[k]) feet.push_back({projected(p, k, max_[k]), unit(k, -1)});
    }
  }

 private:
  Vec3d min_, max_;
};

class HalfSpace final : public Form {
 public:
  explicit HalfSpace(const PlaneSpec& s) : point_(s.point), normal_(s.normal * (1 / norm(s.normal))) {}

  double distance(Vec3d p) const override { return dot(p - point_, normal_); }
  Extents extents() const override { return Extents::endless(); }
  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    feet.push_back({p - distance(p) * normal_, normal_});
  }
  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    feet.push_back({p - distance(p) * normal_, -normal_});
  }

 private:
  Vec3d point_, normal_;
};

class Cylinder final : public Form {
 public:
  explicit Cylinder(const CylinderSpec& s)
      : start_(s.start),
        length_(norm(s.end - s.start)),
        axis_((s.end - s.start) * (1 / length_)),
        radius_(s.radius) {}

  double distance(Vec3d p) const override {
    const AxisParts at = parts(p);
    const double side = at.radius - radius_;
    const double cap = std::max(-at.along, at.along - length_);
    if (side > 0 && cap > 0) return std::hypot(side, cap);
    return std::max(side, cap);
  }

  Extents extents() const override {
    Vec3d half;
    for (int k = 0; k < 3; ++k) half[k] = radius_ * std::sqrt(std::max(0.0, 1 - axis_[k] * axis_[k]));
    Extents all;
    for (const Vec3d& end : {start_, start_ + length_ * axis_}) all.add(end - half), all.add(end + half);
    return all;
  }

  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    const AxisParts at = parts(p);
    feet.push_back({start_ + at.along * axis_ + radius_ * at.radial, at.radial});
    feet.push_back({p - at.along * axis_, -axis_});
    feet.push_back({p + (length_ - at.along) * axis_, axis_});
  }

  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    const AxisParts at = parts(p);
    if (at.radius >= radius_) feet.push_back({start_ + at.along * axis_ + radius_ * at.radial, -at.radial});
    if (at.along <= 0) feet.push_back({p - at.along * axis_, axis_});
    if (at.along >= length_) feet.push_back({p + (length_ - at.along) * axis_, -axis_});
  }

 private:
  AxisParts parts(Vec3d p) const { return parts_about(start_, axis_, p, 1e-12 * radius_); }

  Vec3d start_;
  double length_;
  Vec3d axis_;
  double radius_;
};

class Sphere final : public Form {
 public:
  explicit Sphere(const SphereSpec& s) : center_(s.center), radius_(s.radius) {}

  double distance(Vec3d p) const override { return norm(p - center_) - radius_; }
  Extents extents() const override {
    const Vec3d half{radius_, radius_, radius_};
    return {center_ - half, center_ + half};
  }
  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    feet.push_back({center_ + radius_ * away(p), away(p)});
  }
  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    feet.push_back({center_ + radius_ * away(p), -away(p)});
  }

 private:
  Vec3d away(Vec3d p) const {
    const double r = norm(p - center_);
    return r > 1e-12 * radius_ ? (p - center_) * (1 / r) : Vec3d{0, 0, 1};
  }
  Vec3d center_;
  double radius_;
};

// A form somewhere else: moved, then turned about a point.
class Moved final : public Form {
 public:
  Moved(std::shared_ptr<const Form> form, const ShapeSpec& s)
      : form_(std::move(form)),
        move_(s.move),
        center_(s.center),
        turn_(rotation(s.turn)),
        back_(rotation(-s.turn)) {}

  double distance(Vec3d p) const override { return form_->distance(at_home(p)); }

  Extents extents() const override {
    const Extents e = form_->extents();
    if (!std::isfinite(norm(e.lower)) || !std::isfinite(norm(e.upper))) return Extents::endless();
    Extents all;
    for (int corner = 0; corner < 8; ++corner)
      all.add(here({corner & 1 ? e.upper.x : e.lower.x, corner & 2 ? e.upper.y : e.lower.y,
                    corner & 4 ? e.upper.z : e.lower.z}));
    return all;
  }

  void inner_feet(Vec3d p, std::vector<Foot>& feet) const override {
    bring(feet, [&](std::vector<Foot>& home) { form_->inner_feet(at_home(p), home); });
  }
  void outer_feet(Vec3d p, std::vector<Foot>& feet) const override {
    bring(feet, [&](std::vector<Foot>& home) { form_->outer_feet(at_home(p), home); });
  }
  void further_feet(Vec3d p, double side, double reach, std::vector<Foot>& feet) const override {
    bring(feet, [&](std::vector<Foot>& home) { form_->further_feet(at_home(p), side, reach, home); });
  }

 private:
  Vec3d here(Vec3d q) const { return center_ + turn_ * (q + move_ - center_); }
  Vec3d at_home(Vec3d p) const { return center_ + back_ * (p - center_) - move_; }

  template <class Ask>
  void bring(std::vector<Foot>& feet, const Ask& ask) const {
    std::vector<Foot> home;
    ask(home);
    for (const Foot& foot : home) feet.push_back({here(foot.point), turn_ * foot.normal});
  }

  std::shared_ptr<const Form> form_;
  Vec3d move_, center_;
  Rotation turn_, back_;
};

struct MakeForm {
  std::shared_ptr<const Form> operator()(const BoxSpec& s) const { return std::make_shared<Box>(s); }
  std::shared_ptr<const Form> operator()(const PlaneSpec& s) const { return std::make_shared<HalfSpace>(s); }
  std::shared_ptr<const Form> operator()(const CylinderSpec& s) const {
    return std::make_shared<Cylinder>(s);
  }
  std::shared_ptr<const Form> operator()(const SphereSpec& s) const { return std::make_shared<Sphere>(s); }
  std::shared_ptr<const Form> operator()(const StlSpec& s) const { return make_stl_form(s); }
  std::shared_ptr<const Form> operator()(const FrustumSpec& s) const { return make_frustum(s); }
  std::shared_ptr<const Form> operator()(const PrismSpec& s) const { return make_prism(s); }
};

}  // namespace

std::shared_ptr<const Form> make_form(const ShapeSpec& spec) {
  auto form = std::visit(MakeForm{}, spec.form);
  if (norm(spec.move) == 0 && norm(spec.turn) == 0) return form;
  return std::make_shared<Moved>(std::move(form), spec);
}

void Shape::feet(Vec3d p, double reach, std::vector<Foot>& feet) const {
  sign_ > 0 ? form_->inner_feet(p, feet) : form_->outer_feet(p, feet);
  form_->further_feet(p, sign_, reach, feet);
}

Solid::Solid(std::vector<Shape> shapes, const std::vector<Shape>& subtract) : shapes_(std::move(shapes)) {
  for (const Shape& shape : subtract) limits_.push_back(shape.complement());
}

double Solid::distance(Vec3d p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Shape& shape : shapes_) nearest = std::min(nearest, shape.distance(p));
  for (const Shape& limit : limits_) nearest = std::max(nearest, limit.distance(p));
  return nearest;
}

bool Solid::subtracts(Vec3d p) const {
  return std::any_of(limits_.begin(), limits_.end(),
                     [&](const Shape& limit) { return limit.distance(p) > 0; });
}

Extents Solid::extents() const {
  Extents all;
  for (const Shape& shape : shapes_) all.add(shape.extents());
  return all;
}

std::vector<Extents> Solid::form_extents() const {
  std::vector<Extents> all;
  for (const Shape& shape : shapes_) all.push_back(shape.form_extents());
  for (const Shape& limit : limits_) all.push_back(limit.form_extents());
  return all;
}

void Solid::feet(Vec3d p, double reach, std::vector<Foot>& feet) const {
  const auto near = [&](double distance) { return distance <= 0 && distance >= -reach; };
  for (const Shape& shape : shapes_)
    if (near(shape.distance(p))) shape.feet(p, reach, feet);
  for (const Shape& limit : limits_)
    if (near(limit.distance(p))) limit.feet(p, reach, feet);
}

}  // namespace slagflow
