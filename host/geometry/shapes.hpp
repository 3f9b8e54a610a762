// Bodies that regions and walls are made of, as signed distances and nearest surface points.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "fluid/math.hpp"
#include "host/case/case.hpp"

namespace slagflow {

// A point of a surface, or of the plane that continues a face beyond its edge.
struct Foot {
  Vec3d point;   // [m]
  Vec3d normal;  // unit vector out of the body
};

// A box that holds a body; infinite where that has no end.
struct Extents {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3d lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};

  void add(Vec3d p) {
    for (int k = 0; k < 3; ++k) lower[k] = std::min(lower[k], p[k]), upper[k] = std::max(upper[k], p[k]);
  }
  void add(const Extents& e) { add(e.lower), add(e.upper); }
  static Extents endless() { return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}; }
};

// A closed form with a boundary.
class Form {
 public:
  virtual ~Form() = default;
  // Signed distance to the boundary [m], negative inside; its magnitude may be too small but not too large.
  virtual double distance(Vec3d p) const = 0;
  virtual Extents extents() const = 0;
  // For p inside: candidates for the nearest point of the boundary.
  virtual void inner_feet(Vec3d p, std::vector<Foot>& feet) const = 0;
  // For p outside, when all that is outside is solid: the faces that p is beyond, normals into the form.
  virtual void outer_feet(Vec3d p, std::vector<Foot>& feet) const = 0;
  // Of a form whose feet above are the nearest only: all points within `reach` [m] straight below p on faces
  // whose normals, times `side`, lead there.
  virtual void further_feet(Vec3d /*p*/, double /*side*/, double /*reach*/,
                            std::vector<Foot>& /*feet*/) const {}
};

// Makes the form of a shape. Throws InputError when an STL file is not usable.
std::shared_ptr<const Form> make_form(const ShapeSpec& spec);

// A form, or all that is outside of it.
class Shape {
 public:
  explicit Shape(const ShapeSpec& spec) : Shape(make_form(spec), spec.outside) {}

  double distance(Vec3d p) const { return sign_ * form_->distance(p); }
  // For p inside: candidates within `reach` [m], and perhaps others, with normals out of the shape.
  void feet(Vec3d p, double reach, std::vector<Foot>& feet) const;
  Extents extents() const { return sign_ > 0 ? form_->extents() : Extents::endless(); }
  Extents form_extents() const { return form_->extents(); }
  Shape complement() const { return Shape(form_, sign_ > 0); }

 private:
  Shape(std::shared_ptr<const Form> form, bool outside) : form_(std::move(form)), sign_(outside ? -1 : 1) {}

  std::shared_ptr<const Form> form_;
  double sign_;
};

// A union of shapes without the union of others.
class Solid {
 public:
  Solid(std::vector<Shape> shapes, const std::vector<Shape>& subtract);

  // As Form::distance.
  double distance(Vec3d p) const;
  bool contains(Vec3d p) const { return distance(p) < 0; }
  // Whether p is in what is taken away.
  bool subtracts(Vec3d p) const;
  // Of the union, whatever is taken away.
  Extents extents() const;
  // Of each form alone: those of the union, then those that are taken away.
  std::vector<Extents> form_extents() const;
  // For p inside: candidates from every surface that may be within `reach` [m].
  void feet(Vec3d p, double reach, std::vector<Foot>& feet) const;

 private:
  std::vector<Shape> shapes_;
  std::vector<Shape> limits_;  // complements of what is subtracted: the solid is inside all of them
};

}  // namespace slagflow
