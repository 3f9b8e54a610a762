#include "host/geometry/start_sites.hpp"

#include <utility>

namespace slagflow {

StartSites::StartSites(Lattice lattice, std::vector<std::uint8_t> bodies, std::vector<std::size_t> particles)
    : lattice_(lattice),
      body_(std::move(bodies)),
      particle_(lattice.size(), none),
      site_(std::move(particles)) {
  for (std::size_t i = 0; i < site_.size(); ++i) particle_.set(site_[i], static_cast<std::int32_t>(i));
}

std::optional<std::size_t> StartSites::at(Vec3d place) const {
  const std::optional<SiteIndex> s = lattice_.at(place);
  if (!s) return {};
  return lattice_.linear(*s);
}

}  // namespace slagflow
