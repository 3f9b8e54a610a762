#include <array>
#include <cmath>
#include <map>

#include "heat/wall_sites.hpp"

namespace slagflow {

namespace {

using Cell = std::array<std::int64_t, 3>;

class Sites {
 public:
  explicit Sites(const SimulationSetup& s) : s_(s), of_wall_(s.walls.position.size(), -1) {}

  WallSites all() {
    for (std::size_t w = 0; w < of_wall_.size(); ++w)
      if (is_site(w)) {
        at_[cell_of(s_.walls.position[w])].push_back(w);
        of_wall_[w] = static_cast<Index>(result_.body.size());
        result_.body.push_back(s_.walls.body[w]);
        result_.area.push_back(area(w));
      }
    for (std::size_t w = 0; w < of_wall_.size(); ++w)
      if (passes_heat(w) && of_wall_[w] < 0) of_wall_[w] = nearest(w);
    group();
    result_.of_wall = std::move(of_wall_);
    return std::move(result_);
  }

 private:
  bool passes_heat(std::size_t w) const {
    return s_.bodies[s_.walls.body[w]].thermal.kind != WallHeat::adiabatic;
  }
  double area(std::size_t w) const {
    return s_.site_area.empty() ? std::pow(s_.spacing, s_.dimensions - 1) : s_.site_area[w];
  }
  bool is_site(std::size_t w) const {
    return passes_heat(w) && s_.walls.depth[w] < s_.spacing && area(w) > 0;
  }
  Cell cell_of(Vec3d x) const {
    const auto cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / (2 * s_.spacing))); };
    return {cell(x.x), cell(x.y), cell(x.z)};
  }

  // The site of the same wall that is nearest to the particle's foot on the surface, within reach.
  Index nearest(std::size_t w) const {
    const Vec3d foot = s_.walls.position[w] + s_.walls.depth[w] * s_.walls.normal[w];
    const Cell centre = cell_of(foot);
    double least = 1e300;
    Index best = -1;
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = at_.find({centre[0] + x, centre[1] + y, centre[2] + z});
          if (found == at_.end()) continue;
          for (const std::size_t site : found->second) {
            const double off = norm(s_.walls.position[site] - foot);
            if (s_.walls.body[site] == s_.walls.body[w] && off < least) least = off, best = of_wall_[site];
          }
        }
    return best;
  }

  // Members by their site, in the order of ids.
  void group() {
    std::vector<std::vector<Index>> members(result_.body.size());
    for (std::size_t w = 0; w < of_wall_.size(); ++w)
      if (of_wall_[w] >= 0) members[static_cast<std::size_t>(of_wall_[w])].push_back(static_cast<Index>(w));
    for (const auto& of_site : members) {
      result_.member.insert(result_.member.end(), of_site.begin(), of_site.end());
      result_.first.push_back(static_cast<Index>(result_.member.size()));
    }
  }

  const SimulationSetup& s_;
  std::vector<Index> of_wall_;
  std::map<Cell, std::vector<std::size_t>> at_;
  WallSites result_;
};

}  // namespace

WallSites wall_sites(const SimulationSetup& s) { return Sites(s).all(); }

}  // namespace slagflow
