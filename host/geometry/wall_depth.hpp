// How deep a place is inside the walls of a case.
#pragma once

#include "host/case/case.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {

// Decides by the shapes of the case, each wall where its motion has taken it, so that corners, edges, curves
// and thin plates are exact; walls that have vanished do not count. It starts at the time 0.
class WallDepth {
 public:
  // Throws InputError when an STL file cannot be read.
  explicit WallDepth(const Case& c);

  void move_to(double time);  // [s]

  // Distance from a place in the domain to the open, over the nearest face that borders it [m]: 0 in the
  // open, at most six spacings.
  double of(Vec3d p) const;

 private:
  struct Pose {
    bool there = true;
    Rotation turn, back;   // from the start to now, and back
    Vec3d center, target;  // [m] of rotation, at the start and now
  };

  Vec3d at_start(Vec3d p, std::size_t wall) const;
  Vec3d wrapped(Vec3d p) const;
  bool in_wall(Vec3d p) const;
  bool borders_open(Vec3d p) const;
  std::vector<Foot> feet(Vec3d p) const;
  double over_faces(Vec3d p) const;
  double to_the_open(Vec3d p) const;

  WallSolids solids_;
  std::vector<WallMotion> motion_;
  std::vector<Pose> pose_;  // of each wall
  DomainSetup domain_;
  double spacing_;
  bool flat_;
};

}  // namespace slagflow
