// The sites along a parabola.
#pragma once

#include <vector>

#include "host/geometry/start_sites.hpp"

namespace slagflow {

// Grows as it is looked at, in steps of a quarter of a spacing, up to where it leaves the lattice or the
// domain.
class FlightPath {
 public:
  struct Point {
    std::size_t here, ahead;  // sites: of the point, and of half a spacing further on
    double off;               // [m] from the start
    double speed;             // [m/s]
    bool leaves;              // `ahead` is beyond the domain
  };

  FlightPath(const StartSites& sites, Vec3d acceleration) : sites_(sites), a_(acceleration) {}

  void begin(Vec3d start, Vec3d velocity);
  // The point after so many others; nothing beyond the end.
  const Point* at(std::size_t number) {
    if (number == points_.size() && !ended_) grow();
    return number < points_.size() ? &points_[number] : nullptr;
  }
  // Whether a flight from another start goes through the same sites but for their place along an axis.
  bool serves(Vec3d start, Vec3d velocity, int axis) const;
  Vec3d start() const { return start_; }

 private:
  void grow();  // by some points

  const StartSites& sites_;
  Vec3d a_, start_, velocity_, v_;
  double t_ = 0, way_ = 0;
  bool ended_ = true;
  std::vector<Point> points_;
};

}  // namespace slagflow
