#include "host/geometry/settling.hpp"

#include <array>
#include <cstdio>

#include "host/geometry/start_sites.hpp"

namespace slagflow {
namespace {

// Whether a site has neither fluid nor wall beside it along some axis.
bool at_surface(const Case& c, const StartSites& sites, std::size_t site) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == 1 && c.dimensions == 2) continue;
    for (const int step : {-1, 1}) {
      const auto beside = sites.beside(site, axis, step);
      if (!beside || (sites.fluid(*beside) == StartSites::none && sites.wall(*beside) == StartSites::none))
        return true;
    }
  }
  return false;
}

// Mean start pressure of each region; 0 where a part of it hangs together with a free surface.
std::vector<double> closed_pressure(const Case& c, const Filling& filling) {
  const StartSites& sites = *filling.sites;
  const FluidBodies& bodies = filling.bodies;
  std::vector<bool> open(static_cast<std::size_t>(bodies.count), false);
  const auto body = [&](std::size_t i) { return static_cast<std::size_t>(bodies.of[i]); };
  for (std::size_t i = 0; i < sites.particles(); ++i)
    if (!open[body(i)] && at_surface(c, sites, sites.taken()[i])) open[body(i)] = true;
  std::vector<double> sum(c.regions.size(), 0), count(c.regions.size(), 0);
  std::vector<bool> closed(c.regions.size(), true);
  for (std::size_t i = 0; i < sites.particles(); ++i) {
    const std::size_t r = filling.region[i];
    if (open[body(i)]) closed[r] = false;
    sum[r] += filling.fluid.pressure[i], count[r] += 1;
  }
  for (std::size_t r = 0; r < sum.size(); ++r) sum[r] = closed[r] ? sum[r] / count[r] : -1;
  return sum;
}

}  // namespace

bool has_free_surface(const Case& c, const Filling& filling) {
  const StartSites& sites = *filling.sites;
  for (const auto site : sites.taken())
    if (at_surface(c, sites, site)) return true;
  return false;
}

double automatic_background(const Case& resolved, const Filling& filling, bool closed) {
  constexpr double compression = 0.01;  // suction takes 0.005 at a tenth of c0
  if (!closed) return 0;
  for (const double pressure : filling.fluid.pressure)
    if (pressure != 0) return 0;
  if (resolved.numerics.tension == TensionModel::limit || resolved.numerics.kernel == SmoothingKind::lucy)
    return 0;
  double background = 0;
  for (const RegionSpec& region : resolved.regions) {
    const double density = resolved.fluids[static_cast<std::size_t>(region.fluid)].density;
    const double share = compression + settling_loss(resolved.numerics, region.jitter);
    background = larger(background, share * density * square(resolved.numerics.sound_speed));
  }
  return background;
}

double settling_loss(const NumericsSetup& numerics, double jitter) {
  const double shifted = 1 - 0.6 * smaller(1.0, 2.5 * larger(numerics.shifting, 0.0));
  if (numerics.kernel == SmoothingKind::lucy) return 0.4 * jitter * jitter * shifted;
  return smaller(0.6 * jitter * jitter * shifted, 0.12 * jitter);
}

void warn_of_settling(const Case& resolved, const Filling& filling, std::vector<std::string>& warnings) {
  constexpr double tolerated = 0.1;
  bool any = false;
  for (const RegionSpec& region : resolved.regions) any = any || region.jitter > 0;
  if (!any) return;
  const std::vector<double> pressure = closed_pressure(resolved, filling);
  const double c0 = resolved.numerics.sound_speed;
  const bool limit = resolved.numerics.tension == TensionModel::limit;
  const double borne = limit ? resolved.numerics.tension_limit : 0;
  for (std::size_t r = 0; r < pressure.size(); ++r) {
    const RegionSpec& region = resolved.regions[r];
    const double density = resolved.fluids[static_cast<std::size_t>(region.fluid)].density;
    const double loss = settling_loss(resolved.numerics, region.jitter) * density * c0 * c0;
    if (pressure[r] < 0 || loss <= tolerated * (pressure[r] + borne)) continue;
    std::array<char, 300> text{};
    std::snprintf(
        text.data(), text.size(),
        "region %zu fills a closed space, and loses about %.2g Pa as its particles settle from a "
        "jitter of %.3g, of the %.3g Pa that it starts with: give it pressure = %.3g, or less jitter",
        r, loss, region.jitter, pressure[r], pressure[r] + loss);
    warnings.emplace_back(text.data());
  }
}

}  // namespace slagflow
