// Finds places of walls that fluid may pass, or that it meets as something else than the shapes say.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/geometry.hpp"

namespace slagflow {

// Looks at the wall particles as they are placed.
class WallSurvey {
 public:
  WallSurvey(const Case& c, const Lattice& lattice, const WallSolids& solids);

  struct Look {
    Vec3d foot;            // [m] on the face
    double thickness = 0;  // [spacings] behind it; infinite from three on, and where the face borders nothing
    bool step = false;
  };
  // At a particle at `p` in a wall, whose face is in the domain. The wall is thin where it ends less than
  // three spacings behind that, along the normal, with a face that looks the other way: not at the corner of
  // two faces that meet at 60 degrees or more. The domain may cut it. It has a step where the wall rises on
  // one side and falls on the other within 1.8 spacings.
  Look look(Vec3d p, std::size_t body, const WallFace& face) const;
  void placed(std::size_t body, const Look& look);
  // A site in a wall of which no face is known; it gets no particle.
  void dropped(Vec3d p, std::size_t body) { dropped_[body].add(p); }

  // A site in a wall that moves, and in another at rest that keeps it: what comes out of there is missing.
  // A few places of the way are looked at.
  bool comes_out(Vec3d p, std::size_t body) const;
  void covered(Vec3d p, std::size_t body) { covered_[body].add(p); }

  // One line for each wall and kind.
  std::vector<std::string> warnings() const;

 private:
  struct Found {
    std::size_t count = 0;
    Vec3d first;
    void add(Vec3d p) {
      if (count++ == 0) first = p;
    }
  };
  struct Thin : Found {
    double thickness = 0;  // [spacings] the least
  };

  struct Pose {
    Vec3d shift;
    Rotation turned;
  };

  std::vector<Pose> poses(const WallMotion&) const;
  double thickness(Vec3d foot, Vec3d normal, std::size_t body) const;
  bool faces_back(Vec3d p, Vec3d normal, std::size_t body) const;
  bool has_step(Vec3d foot, Vec3d normal, std::size_t body) const;
  bool rises(Vec3d foot, Vec3d way, std::size_t body) const;
  bool even(Vec3d foot, Vec3d way, std::size_t body) const;
  bool open_at(Vec3d p, std::size_t body) const;
  bool open_beside(Vec3d p) const;
  double distance(Vec3d p, std::size_t body) const;

  const Case& c_;
  const Lattice& lattice_;
  const WallSolids& solids_;
  double spacing_;
  std::vector<std::size_t> particles_;  // of each wall
  std::vector<Thin> thin_;
  std::vector<Found> steps_, dropped_, covered_;
  std::vector<std::vector<Pose>> poses_;  // of walls that move, on their way
};

}  // namespace slagflow
