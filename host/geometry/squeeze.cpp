#include "host/geometry/squeeze.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace slagflow {
namespace {

constexpr double two_pi = 6.283185307179586;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The gap before one wall that moves along an axis.
class Gap {
 public:
  Gap(const Case& c, const StartSites& sites, std::int32_t body, int axis, int way)
      : c_(c), sites_(sites), body_(body), axis_(axis), way_(way), inside_(sites.particles(), false) {
    for (const std::size_t site : sites.taken()) {
      const auto behind = sites.beside(site, axis, -way);
      if (behind && sites.wall(*behind) == body) add_column(site);
    }
  }

  Squeeze squeeze(const std::vector<std::uint8_t>& fluid) const {
    std::int64_t openings = 0, sites = 0;
    for (std::size_t i = 0; i < inside_.size(); ++i)
      if (inside_[i]) openings += openings_of(sites_.taken()[i]), ++sites;
    if (openings == 0) return {};
    Squeeze result{closing_ / static_cast<double>(openings), 0};
    const double gap = c_.spacing * static_cast<double>(sites) / static_cast<double>(columns_),
                 way = c_.spacing * static_cast<double>(sites) / static_cast<double>(openings);
    const double rate = 6 * result.speed / gap;
    for (std::size_t i = 0; i < inside_.size(); ++i) {
      if (!inside_[i]) continue;
      const FluidSpec& spec = c_.fluids[fluid[i]];
      const double stress = rate * static_cast<double>(viscosity(spec.law(), static_cast<Real>(rate)));
      result.film = std::max(result.film, std::sqrt(2 * (2 * stress * way / gap) / spec.density));
    }
    return result;
  }

 private:
  // Fluid from the wall on to the next thing, if that is another wall.
  void add_column(std::size_t site) {
    std::vector<std::int32_t> column;
    const auto longest = static_cast<std::size_t>(sites_.lattice().count()[static_cast<std::size_t>(axis_)]);
    for (std::optional<std::size_t> s = site; s && column.size() < longest;
         s = sites_.beside(*s, axis_, way_)) {
      const std::int32_t particle = sites_.fluid(*s), wall = sites_.wall(*s);
      if (particle != StartSites::none) {
        column.push_back(particle);
        continue;
      }
      if (wall == StartSites::none || wall == body_) return;
      closing_ += speed_along(c_.walls[at(body_)].motion, axis_, way_) +
                  speed_along(c_.walls[at(wall)].motion, axis_, -way_);
      ++columns_;
      for (const std::int32_t i : column) inside_[at(i)] = true;
      return;
    }
  }

  // Faces across the motion that lead neither into a wall nor into the gap itself.
  std::int64_t openings_of(std::size_t site) const {
    std::int64_t openings = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == axis_ || (axis == 1 && c_.dimensions == 2)) continue;
      for (const int step : {-1, 1}) {
        const auto beside = sites_.beside(site, axis, step);
        if (beside && sites_.wall(*beside) != StartSites::none) continue;
        const std::int32_t other = beside ? sites_.fluid(*beside) : StartSites::none;
        if (other == StartSites::none || !inside_[at(other)]) ++openings;
      }
    }
    return openings;
  }

  const Case& c_;
  const StartSites& sites_;
  std::int32_t body_;
  int axis_, way_;
  std::vector<bool> inside_;  // particles in the gap
  double closing_ = 0;        // [m/s], summed over the faces of the wall
  std::int64_t columns_ = 0;  // of fluid before them
};

}  // namespace

double speed_along(const WallMotion& motion, int axis, int way) {
  switch (motion.kind) {
    case MotionKind::constant:
    case MotionKind::ramp:
      return std::max(0.0, way * motion.velocity[axis]);
    case MotionKind::sine:
      return two_pi * motion.frequency * std::abs(motion.amplitude[axis]);
    case MotionKind::table: {
      const double peak =
          motion.interpolation == Interpolation::smooth ? 1.5 : 1;  // of a cubic over its mean
      double fastest = 0;
      for (std::size_t k = 1; k < motion.time.size() && k < motion.displacement.size(); ++k)
        fastest = std::max(fastest, way * peak * (motion.displacement[k] - motion.displacement[k - 1])[axis] /
                                        (motion.time[k] - motion.time[k - 1]));
      return fastest;
    }
    case MotionKind::rest:
      break;
  }
  return 0;
}

Squeeze squeeze(const Case& c, const StartSites& sites, const std::vector<std::uint8_t>& fluid) {
  Squeeze largest;
  for (std::size_t b = 0; b < c.walls.size(); ++b)
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1})
        if (speed_along(c.walls[b].motion, axis, way) > 0) {
          const Squeeze here = Gap(c, sites, static_cast<std::int32_t>(b), axis, way).squeeze(fluid);
          largest = {std::max(largest.speed, here.speed), std::max(largest.film, here.film)};
        }
  return largest;
}

}  // namespace slagflow
