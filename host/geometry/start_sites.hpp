// Who has each site of the lattice at the start, for what depends on the neighbourhood: pressure, falls.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/geometry/geometry.hpp"
#include "host/geometry/paged.hpp"

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
  SiteIndex index(std::size_t site) const {
    const auto [nx, ny, nz] = lattice_.count();
    const auto s = static_cast<std::int64_t>(site), row = s / nx, layer = row / ny;
    return {s - row * nx, row - layer * ny, layer};
  }
  Vec3d position(std::size_t site) const { return lattice_.position(index(site)); }  // [m]

  std::int32_t fluid(std::size_t site) const { return particle_[site]; }  // index of the particle, or none
  std::int32_t wall(std::size_t site) const { return body_[site] - 1; }   // index of the body, or none
  bool in_domain(std::size_t site) const { return lattice_.in_domain(index(site)); }

  // The site beside it along an axis, round a periodic one; nothing beyond the lattice.
  std::optional<std::size_t> beside(std::size_t site, int axis, std::int64_t steps) const {
    return beside(index(site), axis, steps);
  }
  std::optional<std::size_t> beside(SiteIndex s, int axis, std::int64_t steps) const {
    if (!lattice_.move(s, axis, steps)) return {};
    return lattice_.linear(s);
  }
  // The site that a place is in; nothing beyond the lattice.
  std::optional<std::size_t> at(Vec3d place) const;

  // Calls visit(first, count) for each row of fluid along x, in the order of the lattice; one that a periodic
  // face cuts is two.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    const auto nx = static_cast<std::size_t>(lattice_.count()[0]);
    std::size_t first = 0, end = 0, row_end = 0;
    particle_.for_each([&](std::size_t site, std::int32_t) {
      if (site != end || site == row_end) {
        if (end > first) visit(first, end - first);
        first = site, row_end = (site / nx + 1) * nx;
      }
      end = site + 1;
    });
    if (end > first) visit(first, end - first);
  }

 private:
  Lattice lattice_;
  std::vector<std::uint8_t> body_;
  Paged<std::int32_t> particle_;   // of each site
  std::vector<std::size_t> site_;  // of each particle
};

}  // namespace slagflow
