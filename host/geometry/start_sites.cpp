#include "host/geometry/start_sites.hpp"

#include <cmath>
#include <utility>

namespace slagflow {

StartSites::StartSites(Lattice lattice, std::vector<std::uint8_t> bodies, std::vector<std::size_t> particles)
    : lattice_(lattice), body_(std::move(bodies)), site_(std::move(particles)) {
  particle_.assign(lattice_.size(), none);
  for (std::size_t i = 0; i < site_.size(); ++i) particle_[site_[i]] = static_cast<std::int32_t>(i);
}

SiteIndex StartSites::index(std::size_t site) const {
  const auto [nx, ny, nz] = lattice_.count();
  const auto s = static_cast<std::int64_t>(site);
  return {s % nx, s / nx % ny, s / (nx * ny)};
}

std::optional<std::size_t> StartSites::beside(std::size_t site, int axis, std::int64_t steps) const {
  SiteIndex s = index(site);
  if (!lattice_.move(s, axis, steps)) return {};
  return lattice_.linear(s);
}

std::optional<std::size_t> StartSites::at(Vec3d place) const {
  const std::optional<SiteIndex> s = lattice_.at(place);
  if (!s) return {};
  return lattice_.linear(*s);
}

}  // namespace slagflow
