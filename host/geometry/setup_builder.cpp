#include "host/geometry/setup_builder.hpp"

#include <algorithm>
#include <cmath>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/enclosed.hpp"
#include "host/geometry/geometry.hpp"
#include "host/geometry/inlets.hpp"
#include "host/geometry/measure_setup.hpp"
#include "host/geometry/settling.hpp"
#include "host/geometry/setup_warnings.hpp"
#include "host/geometry/slips.hpp"
#include "host/geometry/start_survey.hpp"

namespace slagflow {
namespace {

double automatic_sound_speed(const Case& c, const std::vector<SoundSpeedTerm>& terms) {
  const double speed = ruling(terms).sound_speed();
  if (!(speed > 0))
    throw InputError(
        c.place_of("numerics.sound_speed") +
        ": key 'numerics.sound_speed': value \"auto\" gives 0 without gravity or anything that moves at the "
        "start: allowed: a number > 0 [m/s], about ten times the largest speed");
  return speed;
}

FluidSetup fluid_setup(const FluidSpec& spec) {
  FluidSetup fluid;
  fluid.name = spec.name;
  fluid.rest_density = spec.density;
  fluid.surface_tension = spec.surface_tension;
  fluid.rheology = spec.law();
  fluid.material = spec.material;
  return fluid;
}

// The pressure of all fluid at the start compresses it.
void check_background(const BuiltCase& built) {
  const Case& c = built.resolved;
  double lightest = c.fluids.front().density;
  for (const FluidSpec& fluid : c.fluids) lightest = std::min(lightest, fluid.density);
  const double most = c.limits.max_compression * lightest * square(c.numerics.sound_speed);
  if (c.numerics.background_pressure <= most) return;
  const char* const key = "numerics.background_pressure";
  throw InputError(c.place_of(key) + ": key '" + key + "': value " + show(c.numerics.background_pressure) +
                   " compresses the fluid at the start by more than limits.max_compression: allowed: >= 0 "
                   "and <= " +
                   show(most) + " [Pa], max_compression rho sound_speed^2");
}

void add_background(BuiltCase& built, Filling& filling, bool closed) {
  double& background = built.resolved.numerics.background_pressure;
  if (background < 0)
    background = automatic_background(built.resolved, filling, closed);
  else
    check_background(built);
  for (double& pressure : filling.fluid.pressure) pressure += background;
}

// Fluid with a free surface does as well without, and surface tension holds its particles in order.
double automatic_shifting(const Case& c, bool closed) {
  return closed && !has_surface_tension(c) && c.numerics.kernel != SmoothingKind::lucy ? 1 : 0;
}

// Warns of what the case does not mean to start with.
void look_over(const Filling& filling, BuiltCase& built) {
  warn_of_settling(built.resolved, filling, built.warnings);
  warn_of_start(built.resolved, filling, built.warnings);
  warn_of_crushed_fluid(built.resolved, *filling.sites, built.warnings);
}

}  // namespace

BuiltCase build_setup(const Case& c, const Stage& stage) {
  Filling filling = fill(c, stage);
  BuiltCase built;
  built.resolved = c;
  built.warnings = std::move(filling.warnings);
  tell(stage, "looking where fluid falls");
  built.sound_speed_terms = sound_speed_terms(c, filling);
  if (!(c.numerics.sound_speed > 0))
    built.resolved.numerics.sound_speed = automatic_sound_speed(c, built.sound_speed_terms);
  const bool closed = c.inlets.empty() && c.outlets.empty() && !has_free_surface(c, filling);
  if (c.numerics.shifting < 0) built.resolved.numerics.shifting = automatic_shifting(c, closed);
  add_background(built, filling, closed);
  tell(stage, "looking over the start");
  look_over(filling, built);
  const std::vector<double> wall_speeds = motion_speeds(c, filling.walls);

  SimulationSetup& setup = built.setup;
  setup.dimensions = c.dimensions;
  setup.spacing = c.spacing;
  setup.support_ratio = c.support_ratio;
  setup.gravity = c.gravity;
  setup.body_acceleration = c.body_force;
  for (const FluidSpec& spec : c.fluids) setup.fluids.push_back(fluid_setup(spec));
  setup.particles = std::move(filling.fluid);
  setup.walls = std::move(filling.walls);
  for (const WallSpec& wall : c.walls)
    setup.bodies.push_back({wall.name, wall.slip, wall.slip_length, wall.contact_angle, wall.tension_limit,
                            wall.surface, wall.motion, wall.thermal});
  add_openings(c, filling.inlets, setup);
  setup.thermal = c.thermal;
  setup.domain = c.domain;
  setup.end_time = c.output.end_time;
  if (c.dimensions == 2) setup.domain.lower.y = -0.5 * c.spacing, setup.domain.upper.y = 0.5 * c.spacing;
  setup.numerics = built.resolved.numerics;
  if (!(c.limits.max_speed > 0)) built.resolved.limits.max_speed = runaway_mach * setup.numerics.sound_speed;
  setup.limits = built.resolved.limits;
  add_measures(c, setup);
  warn_of_setup(built, wall_speeds);
  warn_of_slips(c, setup, built.warnings);
  return built;
}

}  // namespace slagflow
