#include "host/geometry/setup_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "host/case/toml_reader.hpp"
#include "host/geometry/stl.hpp"

namespace slagflow {
namespace {

// Fast walls compress the fluid in front of them.
void warn_of_fast_walls(const std::vector<double>& speeds, const SimulationSetup& setup,
                        std::vector<std::string>& warnings) {
  constexpr double fast = 0.2;  // of the sound speed
  for (std::size_t b = 0; b < speeds.size(); ++b)
    if (speeds[b] > fast * setup.numerics.sound_speed)
      warnings.push_back("wall '" + setup.bodies[b].name + "' moves at up to " + std::to_string(speeds[b]) +
                         " m/s: numerics.sound_speed, " + std::to_string(setup.numerics.sound_speed) +
                         " m/s, should be ten times that");
}

void warn_of_unused_fluids(const Case& c, std::vector<std::string>& warnings) {
  for (std::size_t f = 0; f < c.fluids.size(); ++f) {
    const auto has_it = [&](const RegionSpec& r) { return static_cast<std::size_t>(r.fluid) == f; };
    const auto feeds_it = [&](const InletSpec& in) { return static_cast<std::size_t>(in.fluid) == f; };
    if (std::none_of(c.regions.begin(), c.regions.end(), has_it) &&
        std::none_of(c.inlets.begin(), c.inlets.end(), feeds_it))
      warnings.push_back("fluid '" + c.fluids[f].name +
                         "' is in no region and no inlet: the case does not use it");
  }
}

// Slags, metals and oils are heavier than that.
void warn_of_light_fluids(const Case& c, std::vector<std::string>& warnings) {
  constexpr double light = 100, heaviest = 23, pound_per_cubic_foot = 16.01846;  // [kg/m^3], [g/cm^3]
  for (const FluidSpec& fluid : c.fluids)
    if (fluid.density < light)
      warnings.push_back(
          "fluid '" + fluid.name + "': a density of " + show(fluid.density) +
          " kg/m^3, less than that of melts and oils; is it meant in " +
          (fluid.density <= heaviest
               ? "g/cm^3? Then density = " + show(1000 * fluid.density)
               : "lb/ft^3? Then density = " + show(std::round(pound_per_cubic_foot * fluid.density))));
}

// Values of another unit: of melts tungsten has most tension, 2.5 N/m; and angular velocities in rpm.
void warn_of_other_units(const BuiltCase& built, std::vector<std::string>& warnings) {
  constexpr double most_tension = 5, fast = 50, largest_spacing = 1;  // [N/m], [m/s], [m]
  constexpr double turn = 2 * 3.14159265358979323846;                 // [rad]
  for (const FluidSpec& fluid : built.resolved.fluids)
    if (fluid.surface_tension > most_tension)
      warnings.push_back("fluid '" + fluid.name + "': a surface_tension of " + show(fluid.surface_tension) +
                         " N/m, more than any melt has; is it meant in mN/m? Then surface_tension = " +
                         show(fluid.surface_tension / 1000));
  if (built.resolved.spacing > largest_spacing)
    warnings.push_back("resolution.spacing = " + show(built.resolved.spacing) +
                       " m: lengths are in metres; if the case is drawn in mm, all of them are a thousandth");
  for (const SoundSpeedTerm& term : built.sound_speed_terms)
    if (term.name == "walls" && term.speed > fast) {
      std::array<char, 200> text{};
      std::snprintf(
          text.data(), text.size(),
          "the fastest wall moves at %.3g m/s; angular velocities are in rad/s: 60 rpm are %.3g, 60 "
          "degrees/s %.3g",
          term.speed, turn, turn / 6);
      warnings.emplace_back(text.data());
    }
}

// Two layers at rest, measured: 30 to 1 stay, 100 to 1 with a shorter time step, 1000 to 1 do not.
void warn_of_density_ratio(const Case& c, std::vector<std::string>& warnings) {
  constexpr double stable = 30, most = 100, careful = 0.3;
  const auto lighter = [](const FluidSpec& a, const FluidSpec& b) { return a.density < b.density; };
  const auto [light, heavy] = std::minmax_element(c.fluids.begin(), c.fluids.end(), lighter);
  const double ratio = heavy->density / light->density;
  if (ratio <= stable || (ratio <= most && c.numerics.courant <= careful)) return;
  std::array<char, 400> text{};
  std::snprintf(
      text.data(), text.size(),
      "' is %.3g times as dense as '%s': where they meet, layers at rest stay at rest up to %g to 1; "
      "%s",
      ratio, light->name.c_str(), stable,
      ratio > most ? "beyond 100 to 1 they do not, up to that with numerics.courant = 0.3"
                   : "numerics.courant = 0.3 keeps them up to 100 to 1");
  warnings.push_back("fluid '" + heavy->name + text.data());
}

// A drop at rest is stirred by the pull between its unevenly spaced particles: at this number of 0.3, 0.1,
// 0.03 and 0.01 at 0.02, 0.06, 0.2 and 0.4 times the speed of capillary waves of the spacing (measured on
// cases/verification/drop.toml; in 3-D and on walls less).
void warn_of_currents(const Case& c, std::vector<std::string>& warnings) {
  constexpr double enough = 0.1;
  for (const FluidSpec& fluid : c.fluids) {
    if (!(fluid.surface_tension > 0)) continue;
    const double speed = std::sqrt(fluid.surface_tension / (fluid.density * c.spacing));
    const auto eta = static_cast<double>(viscosity(fluid.law(), static_cast<Real>(speed / c.spacing)));
    const double number = eta / std::sqrt(fluid.density * fluid.surface_tension * c.spacing);
    if (number >= enough) continue;
    std::array<char, 300> text{};
    std::snprintf(
        text.data(), text.size(),
        "fluid '%s': surface tension is strong against viscosity at this spacing, eta/sqrt(rho sigma "
        "spacing) = %.2g: below %g false currents of up to about %.2g m/s stir its surface",
        fluid.name.c_str(), number, enough, 0.4 * speed);
    warnings.emplace_back(text.data());
  }
}

// All flows were tried at 2.6.
void warn_of_support(const Case& c, std::vector<std::string>& warnings) {
  constexpr double lower = 2.4, upper = 3;
  if (c.support_ratio >= lower && c.support_ratio <= upper) return;
  warnings.push_back("resolution.support_ratio = " + show(c.support_ratio) + " is outside of " + show(lower) +
                     " to " + show(upper) + ", beyond what was tested: flows were tried at 2.6; " +
                     (c.support_ratio < lower ? "with less the lattice of the particles resists flow"
                                              : "with more each step takes longer"));
}

// [Pa] of the fluid without its yield stress: the weight of the deepest body, its start pressure, and
// viscosity at the fastest speed over a spacing.
double stress_beside_yield(const BuiltCase& built, std::size_t f, FluidSpec fluid, std::size_t yield) {
  fluid.parameters[yield] = 0;
  double fastest = 0, stress = larger(0.0, built.resolved.numerics.background_pressure);
  for (const SoundSpeedTerm& term : built.sound_speed_terms) {
    fastest = larger(fastest, term.speed);
    if (term.name == "depth") stress = larger(stress, 0.5 * fluid.density * square(term.speed));
  }
  for (const RegionSpec& region : built.resolved.regions)
    if (static_cast<std::size_t>(region.fluid) == f) stress = larger(stress, region.uniform_pressure);
  const double rate = fastest / built.resolved.spacing;
  return larger(stress, rate * static_cast<double>(viscosity(fluid.law(), static_cast<Real>(rate))));
}

void warn_of_lost_yield_stress(const BuiltCase& built, std::size_t f, std::vector<std::string>& warnings) {
  constexpr double digits = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 2;
  const FluidSpec& fluid = built.resolved.fluids[f];
  const RheologyInfo& info = fluid.info();
  for (int k = 0; k < info.parameter_count; ++k) {
    if (info.parameters[k].role != ParameterRole::yield_stress) continue;
    const auto index = static_cast<std::size_t>(k);
    const double yield = fluid.parameters[index], stress = stress_beside_yield(built, f, fluid, index);
    const bool small = yield < digits * stress;
    if (!(yield > 0 && stress > 0) || (!small && yield * digits <= stress)) continue;
    std::array<char, 400> text{};
    std::snprintf(
        text.data(), text.size(),
        "fluid '%s': of a yield_stress of %.3g Pa beside %.3g Pa of weight and viscosity the numbers of the "
        "computation hold nothing: %s",
        fluid.name.c_str(), yield, stress,
        small ? "0 gives the same" : "nothing can make it flow; is it meant in Pa? A solid is a wall");
    warnings.emplace_back(text.data());
  }
}

// Particles of a lattice show a wave of less than two spacings as a longer one.
void warn_of_short_waves(const Case& c, std::vector<std::string>& warnings) {
  constexpr double carried = 8;  // spacings a wave
  for (std::size_t r = 0; r < c.regions.size(); ++r)
    for (std::size_t w = 0; w < c.regions[r].waves.size(); ++w) {
      const double length = 1 / norm(c.regions[r].waves[w].wave_vector);  // [m]
      if (length >= carried * c.spacing) continue;
      std::array<char, 300> text{};
      std::snprintf(
          text.data(), text.size(),
          "region.%zu.waves.%zu is %.3g m long, %.2g spacings: %s; wave_vector is one over the "
          "length, without 2 pi, and a resolution.spacing of %.2g m carries it",
          r, w, length, length / c.spacing,
          length > 2 * c.spacing ? "too few to carry it" : "its particles start as in another, longer wave",
          length / carried);
      warnings.emplace_back(text.data());
    }
}

// Binary STL files hold seven digits of a coordinate: map coordinates in them are steps. Files of more digits
// have some that single precision does not hold.
void warn_of_coarse_file(const Case& c, const StlSpec& stl, std::vector<std::string>& warnings) {
  constexpr double digits = 0x1p-24, harmless = 0.05;  // [spacings]
  if (norm(stl.translate) + norm(c.domain.lower) + norm(c.domain.upper) < harmless * c.spacing / digits)
    return;
  double farthest = 0;
  for (const Triangle& triangle : read_stl(stl.file))
    for (const Vec3d& corner : triangle)
      for (int k = 0; k < 3; ++k) {
        if (static_cast<double>(static_cast<float>(corner[k])) != corner[k]) return;
        farthest = std::max(farthest, std::abs(corner[k]));
      }
  const double error = digits * farthest * stl.scale;  // [m]
  if (error < harmless * c.spacing) return;
  std::array<char, 300> text{};
  std::snprintf(
      text.data(), text.size(),
      "' has coordinates up to %.4g, which single precision holds to %.2g m, %.2g spacings: export it "
      "around an origin that is near, and give that as translate",
      farthest, error, error / c.spacing);
  warnings.push_back("'" + std::filesystem::path(stl.file).filename().string() + text.data());
}

void warn_of_coarse_files(const Case& c, std::vector<std::string>& warnings) {
  const auto look = [&](const std::vector<ShapeSpec>& shapes) {
    for (const ShapeSpec& shape : shapes)
      if (const auto* const stl = std::get_if<StlSpec>(&shape.form)) warn_of_coarse_file(c, *stl, warnings);
  };
  for (const RegionSpec& region : c.regions) look(region.shapes), look(region.subtract);
  for (const WallSpec& wall : c.walls) look(wall.shapes), look(wall.subtract);
}

}  // namespace

void warn_of_setup(BuiltCase& built, const std::vector<double>& wall_speeds) {
  const Case& c = built.resolved;
  warn_of_unused_fluids(c, built.warnings);
  warn_of_light_fluids(c, built.warnings);
  warn_of_other_units(built, built.warnings);
  warn_of_density_ratio(c, built.warnings);
  warn_of_currents(c, built.warnings);
  warn_of_fast_walls(wall_speeds, built.setup, built.warnings);
  warn_of_support(c, built.warnings);
  warn_of_short_waves(c, built.warnings);
  warn_of_coarse_files(c, built.warnings);
  for (std::size_t f = 0; f < c.fluids.size(); ++f) warn_of_lost_yield_stress(built, f, built.warnings);
}

}  // namespace slagflow
