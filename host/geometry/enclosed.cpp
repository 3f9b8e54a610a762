#include "host/geometry/enclosed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slagflow {
namespace {

constexpr double compressible = 0.02;  // of the fluid
constexpr int looks = 400;             // at the walls' places, until the end of the run

// Sites that hang together without a wall between.
struct Space {
  std::size_t fluid = 0, empty = 0;
  bool closed = true;
  std::vector<Vec3d> faces;  // [sites] of each wall: normals into the space, summed
};

class Spaces {
 public:
  Spaces(const Case& c, const StartSites& sites)
      : c_(c), sites_(sites), seen_(sites.lattice().size(), unseen) {}

  void warn(std::vector<std::string>& warnings) {
    for (const std::size_t site : sites_.taken()) {
      if (seen_[site] != unseen) continue;
      const Space space = explore(site);
      if (space.closed) warn_of(space, warnings);
    }
  }

 private:
  static constexpr std::uint8_t unseen = 0, seen = 1, has_way_out = 2;

  bool stays(std::int32_t wall) const {
    return wall != StartSites::none &&
           c_.walls[static_cast<std::size_t>(wall)].motion.remove_at > c_.output.last_time();
  }

  // A space that has a way out is not explored to its end: nothing else is asked of it.
  Space explore(std::size_t first) {
    Space space;
    space.faces.resize(c_.walls.size());
    std::vector<std::size_t> edge{first}, all{first};
    seen_.set(first, seen);
    while (!edge.empty() && space.closed) {
      const std::size_t site = edge.back();
      edge.pop_back();
      ++(sites_.fluid(site) != StartSites::none ? space.fluid : space.empty);
      const std::size_t before = edge.size();
      for (int axis = 0; axis < 3; ++axis)
        for (const int way : {-1, 1})
          if (!(axis == 1 && c_.dimensions == 2)) look(site, axis, way, space, edge);
      all.insert(all.end(), edge.begin() + static_cast<std::ptrdiff_t>(before), edge.end());
    }
    for (std::size_t k = 0; !space.closed && k < all.size(); ++k) seen_.set(all[k], has_way_out);
    return space;
  }

  void look(std::size_t site, int axis, int way, Space& space, std::vector<std::size_t>& edge) {
    const auto beside = sites_.beside(site, axis, way);
    if (beside && stays(sites_.wall(*beside))) {
      space.faces[static_cast<std::size_t>(sites_.wall(*beside))][axis] -= way;
    } else if (!beside || !sites_.in_domain(*beside) || seen_[*beside] == has_way_out) {
      space.closed = false;
    } else if (seen_[*beside] == unseen) {
      seen_.set(*beside, seen);
      edge.push_back(*beside);
    }
  }

  // [sites] that a wall has taken of the space.
  double taken(const Space& space, std::size_t wall, double time) const {
    return dot(space.faces[wall], c_.walls[wall].motion.pose(time).shift) / c_.spacing;
  }

  void warn_of(const Space& space, std::vector<std::string>& warnings) const {
    const double end = c_.output.last_time();
    const double room = static_cast<double>(space.empty) + compressible * static_cast<double>(space.fluid);
    for (int look = 1; look <= looks; ++look) {
      const double time = end * look / looks;
      double sum = 0, most = 0;
      std::size_t mover = 0;
      for (std::size_t w = 0; w < c_.walls.size(); ++w) {
        const double here = taken(space, w, time);
        sum += here;
        if (here > most) most = here, mover = w;
      }
      if (sum <= room) continue;
      warnings.push_back(text(space, mover, time));
      return;
    }
  }

  std::string text(const Space& space, std::size_t mover, double time) const {
    const double litres = 1000 * std::pow(c_.spacing, c_.dimensions);
    char numbers[200];
    std::snprintf(numbers, sizeof numbers,
                  "%.3g litres%s of fluid, with %.3g litres of air, have no way out of it, and by %.3g s it "
                  "has taken the air",
                  litres * static_cast<double>(space.fluid), c_.dimensions == 2 ? " per metre of width" : "",
                  litres * static_cast<double>(space.empty), time);
    return "wall '" + c_.walls[mover].name + "' crushes enclosed fluid: it moves into a space where " +
           numbers + "; give wall." + std::to_string(mover) +
           ".motion an earlier stop, or the fluid a gap or a free surface";
  }

  const Case& c_;
  const StartSites& sites_;
  Paged<std::uint8_t> seen_;  // of each site
};

}  // namespace

void warn_of_crushed_fluid(const Case& c, const StartSites& sites, std::vector<std::string>& warnings) {
  const auto shifts = [](const WallSpec& wall) { return wall.motion.kind != MotionKind::rest; };
  if (std::any_of(c.walls.begin(), c.walls.end(), shifts)) Spaces(c, sites).warn(warnings);
}

}  // namespace slagflow
