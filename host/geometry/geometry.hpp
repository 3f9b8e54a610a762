// Fills regions and walls with the sites of one cubic lattice.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fluid/setup.hpp"
#include "host/case/case.hpp"
#include "host/geometry/shapes.hpp"

namespace slagflow {

// Sites on a face are decided by a nudge this way: along no plane of the lattice, so that a tilted plane
// through sites takes all of them or none, and rounding none.
constexpr Vec3d tie_direction{1, 0.61, 0.37};

using SiteIndex = std::array<std::int64_t, 3>;

// The lattice sites of the domain, and of a margin around it along axes that are not periodic. With two
// dimensions there is one layer, at y = 0.
class Lattice {
 public:
  // Throws InputError when its flags would not fit into memory.
  explicit Lattice(const Case& c);

  double spacing() const { return spacing_; }
  int layers() const { return static_cast<int>(layers_); }  // of wall particles, and width of the margin
  const SiteIndex& count() const { return count_; }
  std::size_t size() const { return static_cast<std::size_t>(count_[0] * count_[1] * count_[2]); }
  std::size_t linear(const SiteIndex& s) const {
    return static_cast<std::size_t>(s[0] + count_[0] * (s[1] + count_[1] * s[2]));
  }
  Vec3d position(const SiteIndex& s) const;  // [m]
  bool in_domain(const SiteIndex& s) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (s[k] < inner_first_[k] || s[k] >= inner_last_[k]) return false;
    return true;
  }
  bool in_domain(Vec3d p) const;  // between the faces; along y always with two dimensions
  Vec3d wrapped(Vec3d p) const {  // brought back into the domain along periodic axes [m]
    for (int k = 0; k < 3; ++k) {
      if (!periodic(k)) continue;
      const double extent = upper_[k] - lower_[k];
      p[k] -= extent * std::floor((p[k] - lower_[k]) / extent);
    }
    return p;
  }
  bool periodic(int axis) const { return periodic_[static_cast<std::size_t>(axis)]; }
  std::optional<SiteIndex> at(Vec3d place) const;  // the site that a place is in; nothing beyond the lattice
  // Moves along an axis, round a periodic one. Returns false when that leaves the lattice.
  bool move(SiteIndex& s, int axis, std::int64_t steps) const {
    const auto k = static_cast<std::size_t>(axis);
    s[k] += steps;
    if (s[k] >= 0 && s[k] < count_[k]) return true;
    if (periodic_[k]) s[k] = ((s[k] % count_[k]) + count_[k]) % count_[k];
    return periodic_[k];
  }
  // Sites of the domain, without the margin: from, and up to but not including.
  const SiteIndex& inner_first() const { return inner_first_; }
  const SiteIndex& inner_last() const { return inner_last_; }

  using Distance = std::function<double(Vec3d)>;
  using Visit = std::function<void(const SiteIndex&, Vec3d)>;
  using VisitRow = std::function<void(const SiteIndex& first, std::int64_t count)>;
  // Visits all sites where a signed distance is negative. Ties, sites on a face, go to the body on the
  // side of the larger coordinate. Blocks of sites that are clearly in or out are settled at once.
  void visit_inside(const Distance& distance, const Visit& visit) const;
  // The same part by part, which threads may share: a part is a row of blocks, and no two have a site in
  // common. Visits sites that follow each other along x.
  std::size_t parts() const;
  void visit_part(std::size_t part, const Distance& distance, const VisitRow& visit) const;

 private:
  void visit_block(const SiteIndex& first, const Distance& distance, const VisitRow& visit) const;

  double spacing_;
  Vec3d origin_;
  std::int64_t layers_;
  bool flat_;
  std::array<bool, 3> periodic_;
  Vec3d lower_, upper_;                                         // [m] of the domain
  Vec3d corner_;                                                // [m] the first site
  SiteIndex first_{}, count_{}, inner_first_{}, inner_last_{};  // inner: relative to first_, last excluded
};

// Gradient of a distance by central differences over `step` [m]; not divided by 2 step, since only its
// direction is asked for. With two dimensions nothing along y.
Vec3d away_from(const Lattice::Distance& distance, Vec3d p, double step, bool flat);

// The solid of a region or wall; `key` names it in messages. Throws InputError on a bad STL file.
Solid make_solid(const Case& c, const std::vector<ShapeSpec>& shapes, const std::vector<ShapeSpec>& subtract,
                 const std::string& key);

// The solids of a case's walls.
class WallSolids {
 public:
  explicit WallSolids(const Case& c);

  std::size_t count() const { return solids_.size(); }
  const Solid& operator[](std::size_t body) const { return solids_[body]; }
  // Signed distance to the nearest [m], negative inside.
  double distance(Vec3d p) const;

  // A wall that moves or vanishes uncovers its neighbours, and its neighbours it: what a wall's faces border
  // is decided as if there were only the walls that keep their place beside it, those of its company.
  bool in_company(std::size_t body, std::size_t other) const {
    return body == other || !(moves_[body] || moves_[other]);
  }
  double distance_to_company(Vec3d p, std::size_t body) const;
  bool moves(std::size_t body) const { return moves_[body]; }

 private:
  std::vector<Solid> solids_;
  std::vector<bool> moves_;
};

// Surface of the walls below a wall site.
struct WallFace {
  double depth = 0;       // [m] > 0
  Vec3d normal;           // unit vector into the open
  double back_depth = 0;  // [m] of the opposite face of a thin plate; 0: none
  Vec3d back_normal;
};

// Finds the face a wall site belongs to: the nearest that borders the open. Where the open is nearer than
// that, behind a concave corner, the nearest plane that continues a face on the way to it, or else one across
// that way. Of two faces
// equally near, as behind an edge, the one that carries more of the fluid's weight. A site in a plate thinner
// than its particle layers also gets the opposite face.
class WallFaces {
 public:
  WallFaces(const Case& c, const Lattice& lattice, const WallSolids& solids);
  // p: a site in the body; open: the nearest site in no wall. Returns a depth of 0 when there is no face.
  WallFace of(Vec3d p, std::size_t body, Vec3d open) const;

 private:
  Vec3d wrapped(Vec3d p) const;
  WallFace towards(Vec3d p, std::size_t body, Vec3d open) const;
  std::vector<Foot> feet_by_depth(Vec3d p, std::size_t body) const;
  void add_back(Vec3d p, std::size_t body, const std::vector<Foot>& feet, WallFace& face) const;
  bool borders_open(const Foot& foot, std::size_t body) const;

  const WallSolids& solids_;
  DomainSetup domain_;
  Vec3d gravity_;
  double spacing_, reach_;
};

class StartSites;

struct InletColumns;

struct FluidBodies {
  std::vector<std::int32_t> of;  // the body of each particle
  std::int32_t count = 0;        // in the order of their first particles
};

struct Filling {
  FluidParticles fluid;
  WallParticles walls;
  std::shared_ptr<const StartSites> sites;  // who has which site of the lattice
  FluidBodies touching, bodies;             // what fluid touches, and what hangs together
  std::vector<std::uint32_t> region;        // of each fluid particle
  std::vector<InletColumns> inlets;
  std::vector<std::string> warnings;

  Filling();
  ~Filling();
  Filling(Filling&&) noexcept;
  Filling& operator=(Filling&&) noexcept;
};

// Is told what is being done, at each step of a long work; may be empty.
using Stage = std::function<void(const char* what)>;
inline void tell(const Stage& stage, const char* what) {
  if (stage) stage(what);
}

// Places all particles of a case. Fluid sites are in a region, in no earlier region and in no wall, and moved
// to a fiftieth of a spacing off walls that are nearer; wall sites are in a wall and see fluid sites within
// their layers. Throws InputError: a region without a site, too many particles, lack of memory.
Filling fill(const Case& c, const Stage& stage = {});

// Memory that can be had without swapping [bytes].
double available_memory();
std::string gigabytes(double bytes);

}  // namespace slagflow
