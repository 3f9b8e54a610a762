// Who has each site of the lattice at the start, for what depends on the neighbourhood: pressure, falls.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/geometry/geometry.hpp"

namespace slagflow {

class StartSites {
 public:
  static constexpr std::int32_t none = -1;

  // bodies: for each site 0, or the index of its wall + 1; particles: for each fluid particle its site.
  StartSites(Lattice lattice, std::vector<std::uint8_t> bodies, std::vector<std::size_t> particles);

  const Lattice& lattice() const { return lattice_; }
  std::size_t particles() const { return site_.size(); }
  const std::vector<std::size_t>& taken() const { return site_; }  // the site of each particle
  std::size_t site_of(std::int32_t particle) const { return site_[static_cast<std::size_t>(particle)]; }
  SiteIndex index(std::size_t site) const;
  Vec3d position(std::size_t site) const { return lattice_.position(index(site)); }  // [m]

  std::int32_t fluid(std::size_t site) const { return particle_[site]; }  // index of the particle, or none
  std::int32_t wall(std::size_t site) const { return body_[site] - 1; }   // index of the body, or none
  bool in_domain(std::size_t site) const { return lattice_.in_domain(index(site)); }

  // The site beside it along an axis, round a periodic one; nothing beyond the lattice.
  std::optional<std::size_t> beside(std::size_t site, int axis, std::int64_t steps) const;
  // The site that a place is in; nothing beyond the lattice.
  std::optional<std::size_t> at(Vec3d place) const;

 private:
  Lattice lattice_;
  std::vector<std::uint8_t> body_;
  std::vector<std::int32_t> particle_;  // of each site
  std::vector<std::size_t> site_;       // of each particle
};

}  // namespace slagflow
