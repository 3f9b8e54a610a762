// Places the particles of walls on the sites that see the open.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "host/geometry/geometry.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/site_bits.hpp"
#include "host/geometry/wall_survey.hpp"

namespace slagflow {

// What the sites of a lattice hold.
struct MarkedSites {
  const Case& c;
  const Lattice& lattice;
  const WallSolids& solids;
  const InletSpace& inlets;
  const std::vector<std::uint8_t>& body;  // per site: 0, or index of the wall + 1
  const SiteBits& fluid;
};

class WallFiller {
 public:
  WallFiller(const MarkedSites& sites, WallSurvey& survey);

  // Places the particles of a company, the walls at rest or one that moves, in the order of the lattice:
  // whether each wall is in it. Calls `room` before each.
  void place(const std::vector<bool>& company, const std::function<void()>& room, WallParticles& out);

  // Of faces that border the fluid but lie off the lattice.
  std::vector<std::string> warnings() const;

 private:
  using Company = std::array<bool, 256>;  // by the mark of a site: 0 is no wall
  // A planar face that borders the fluid but does not lie midway between two layers of sites.
  struct OffFace {
    int axis, sign;
    long rounded;       // where it lies, in thousandths of a spacing
    double coordinate;  // [m]
    double off;         // [spacings]
  };
  struct Placed {
    Vec3d position;
    std::uint8_t body;
    WallFace face;  // depth 0: none, and no particle
    WallSurvey::Look look;
    std::optional<OffFace> off;
  };

  struct SeeingRow {
    std::size_t number;
    const SiteBits::Word* bits;  // of sites that see the open
  };

  SiteBits open_sites(const Company& company) const;
  void place_row(const SeeingRow& row, const Company& company, std::vector<Placed>& out) const;
  void add(const Placed& placed, WallParticles& out);
  Vec3d nearest_open(const SiteIndex& site, Vec3d p) const;
  bool is_inside(const SiteIndex& s) const;
  std::optional<OffFace> off_face(const SiteIndex& s, Vec3d p, const WallFace& face) const;
  bool is_plane(Vec3d foot, int axis, std::size_t body) const;
  bool fluid_beyond(SiteIndex s, int axis, int sign) const;
  void tell(std::size_t body, const OffFace& face);

  // A step within the layers, and how far it leads in the bits of the sites.
  struct Step {
    SiteIndex by;
    std::int64_t bits;
  };
  std::vector<Step> steps_by_length() const;

  const MarkedSites sites_;
  const Lattice& lattice_;
  WallSurvey& survey_;
  WallFaces faces_;
  SiteBits open_;
  std::vector<Step> steps_;
  std::set<std::tuple<std::size_t, int, int, long>> told_;
  std::map<std::size_t, std::size_t> faces_off_;  // of each wall: off the lattice
  std::vector<std::string> warnings_;
};

}  // namespace slagflow
