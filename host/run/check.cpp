#include "host/run/check.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "backend/error.hpp"
#include "fluid/constants.hpp"
#include "heat/heat.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/geometry.hpp"
#include "host/geometry/inlet_face.hpp"
#include "host/geometry/inlets.hpp"
#include "host/measures/losses.hpp"
#include "host/run/advice.hpp"

namespace slagflow {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

// Extent of the fluid along a unit vector, half a spacing at either end included.
double extent(const SimulationSetup& setup, Vec3d along) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3d& p : setup.particles.position) {
    low = std::min(low, dot(p, along));
    high = std::max(high, dot(p, along));
  }
  return high - low + setup.spacing;
}

// [m^2] that its columns fill; with two dimensions a height [m].
double columns_area(const SimulationSetup& setup, const InletSetup& in) {
  return std::pow(setup.spacing, setup.dimensions) / in.stride * static_cast<double>(in.share.size());
}

// The side of a square as large as the largest inlet.
double face_width(const SimulationSetup& setup) {
  double most = 0;
  for (const InletSetup& in : setup.inlets) {
    const double area = columns_area(setup, in);
    most = std::max(most, setup.dimensions == 2 ? area : std::sqrt(area));
  }
  return most;
}

// Depth along gravity and the smaller width across it; of the inlets where there is no fluid yet.
void add_lengths(CaseCheck& check, const SimulationSetup& setup) {
  if (setup.particles.position.empty()) {
    check.width = check.depth = face_width(setup);
    return;
  }
  const double g = norm(setup.gravity);
  check.width = std::numeric_limits<double>::infinity();
  int down = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (g > 0 && (down < 0 || std::abs(setup.gravity[axis]) > std::abs(setup.gravity[down]))) down = axis;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == down || (axis == 1 && setup.dimensions == 2)) continue;
    Vec3d along;
    along[axis] = 1;
    check.width = std::min(check.width, extent(setup, along));
  }
  check.depth = g > 0 ? extent(setup, setup.gravity * (1 / g)) : check.width;
}

// The fall through the deepest body of fluid, where it is known, and not from one to another.
void add_speed(CaseCheck& check, const BuiltCase& built) {
  double fastest = 0;
  for (const Vec3d& v : built.setup.particles.velocity) fastest = std::max(fastest, norm(v));
  for (const InletSetup& in : built.setup.inlets)
    fastest = std::max(fastest, in.rate.fastest() * *std::max_element(in.share.begin(), in.share.end()));
  const double fall = built.sound_speed_terms.empty() ? std::sqrt(2 * norm(built.setup.gravity) * check.depth)
                                                      : built.sound_speed_terms.front().speed;
  check.speed = std::max(fall, fastest);
  check.speed_source = fall >= fastest ? "sqrt(2 g H)" : "largest speed at the start and from inlets";
}

// The parameter that plays a role; 0 where there is none.
double parameter_of(const Rheology& rheology, ParameterRole role) {
  const RheologyInfo& info = rheology.info();
  for (int k = 0; k < info.parameter_count; ++k) {
    if (info.parameters[k].role == role) return rheology.parameters[k];
  }
  return 0;
}

void add_numbers(CaseCheck& check, const SimulationSetup& setup) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const FluidSetup& fluid : setup.fluids) {
    const double eta = parameter_of(fluid.rheology, ParameterRole::viscosity);
    const double yield_stress = parameter_of(fluid.rheology, ParameterRole::yield_stress);
    const double g = norm(setup.gravity);
    FluidNumbers numbers;
    numbers.name = fluid.name, numbers.capillary = unknown;
    numbers.reynolds = check.speed > 0 ? fluid.rest_density * check.speed * check.width / eta : unknown;
    numbers.bingham = check.speed > 0 ? yield_stress * check.width / (eta * check.speed) : unknown;
    if (fluid.surface_tension > 0) numbers.capillary = eta * check.speed / fluid.surface_tension;
    numbers.dam = g > 0 ? fluid.rest_density * check.width * std::sqrt(g * check.depth) / eta : unknown;
    check.fluids.push_back(numbers);
  }
  check.froude =
      norm(setup.gravity) > 0 ? check.speed / std::sqrt(norm(setup.gravity) * check.depth) : unknown;
}

struct TimeStep {
  double length = 0;  // [s]
  std::string reason;

  void limit(double to, const char* why) {
    if (to < length) length = to, reason = why;
  }
};

TimeStep time_step(const SimulationSetup& setup, double sound_speed) {
  const NumericsSetup& numerics = setup.numerics;
  TimeStep step{numerics.courant * (setup.support_ratio * setup.spacing / 2) / sound_speed,
                "courant (h/2) / sound speed"};
  if (numerics.density_diffusion > 0)
    step.limit(diffusion_time_step(setup) * numerics.sound_speed / sound_speed,
               "numerics.density_diffusion, which is stable up to about 0.28/courant without shorter steps");
  step.limit(capillary_time_step(setup), "courant sqrt(rho spacing^3 / (2 pi surface tension))");
  if (setup.end_time > 0) step.limit(0.5 * setup.end_time, "half of output.end_time");
  step.limit(conduction_time_step(setup), "conduction of heat, a quarter of rho c spacing^2 / k");
  if (numerics.max_time_step > 0) step.limit(numerics.max_time_step, "numerics.max_time_step");
  if (numerics.viscous_step == ViscousStepping::explicit_step)
    for (const FluidSetup& fluid : setup.fluids)
      step.limit(numerics.diffusion_number * fluid.rest_density * setup.spacing * setup.spacing /
                     static_cast<double>(viscosity(fluid.rheology, 0)),
                 "diffusion_number rho spacing^2 / viscosity at rest");
  return step;
}

// Of heat alone for so long [s].
double cooling_steps(const SimulationSetup& setup, double duration) {
  const double longest = conduction_time_step(setup), given = setup.numerics.max_time_step;
  const double most = given > 0 ? std::min(given, longest) : longest;
  double steps = 0, elapsed = 0, step = 0;
  while (elapsed < duration && (step = std::min(most, cooling_time_step(longest, elapsed))) < most)
    elapsed += step, ++steps;
  return steps + std::ceil(std::max(0.0, duration - elapsed) / most);
}

void add_time_step(CaseCheck& check, const BuiltCase& built) {
  const TimeStep step = time_step(built.setup, built.setup.numerics.sound_speed);
  check.time_step = step.length, check.time_step_reason = step.reason;
  const double last = built.resolved.output.last_time(), flows = built.resolved.flow_end();
  check.steps = std::ceil(flows / check.time_step) + cooling_steps(built.setup, last - flows);
}

// What each speed asks for and costs.
void add_sound_speeds(CaseCheck& check, const BuiltCase& built) {
  if (built.sound_speed_terms.empty()) return;
  const SoundSpeedTerm& first = built.sound_speed_terms.front();
  const std::string& rules = ruling(built.sound_speed_terms).name;
  for (const SoundSpeedTerm& term : built.sound_speed_terms) {
    const double c0 = term.sound_speed();
    if (!(c0 > 0)) continue;
    const TimeStep step = time_step(built.setup, c0);
    std::string line = format("by %-9s %.4g m/s = %g x %.4g m/s, %s: time step %.3g s, %.0f steps",
                              term.name.c_str(), c0, term.factor, term.speed, term.what.c_str(), step.length,
                              std::ceil(built.resolved.output.last_time() / step.length));
    if (&term != &first && first.sound_speed() > 0)
      line += format(", %.3g times those by %s",
                     time_step(built.setup, first.sound_speed()).length / step.length, first.name.c_str());
    check.sound_speeds.push_back(line + (term.name == rules ? "; auto takes it" : ""));
  }
}

// Of the grid over the domain, beyond the few for each particle that its memory is reckoned with.
double empty_cells(const SimulationSetup& setup) {
  constexpr double a_particle = 8, usual_most = 1 << 24;
  const double width = setup.support_ratio * setup.spacing * (1 + setup.numerics.skin);
  const auto particles = static_cast<double>(setup.particles.position.size() + setup.walls.position.size());
  double cells = 1;
  for (int k = 0; k < 3; ++k)
    cells *= std::max(1.0, std::floor((setup.domain.upper[k] - setup.domain.lower[k]) / width));
  return std::max(0.0,
                  std::min(cells, std::max(usual_most, a_particle * particles)) - a_particle * particles);
}

void warn_of_empty_cells(const SimulationSetup& setup, std::int64_t fed, std::vector<std::string>& warnings) {
  constexpr double few = 100, many = 1e6;  // for each particle, and in all
  const double empty = empty_cells(setup), particles = static_cast<double>(setup.particles.position.size()) +
                                                       static_cast<double>(setup.walls.position.size()) +
                                                       static_cast<double>(fed);
  if (empty > few * particles && empty > many)
    warnings.push_back(
        format("the domain has %.2g cells without a particle, which take more time in each step than the "
               "%.0f particles do: a smaller domain is faster",
               empty, particles));
}

constexpr double most_steps = 1e9;

void add_warnings(CaseCheck& check, const BuiltCase& built) {
  check.warnings = built.warnings;
  check.warnings.insert(check.warnings.end(), check.heat.warnings.begin(), check.heat.warnings.end());
  if (check.mach > 0.15)
    check.warnings.push_back(
        format("the Mach number %.2g exceeds 0.15: the fluid will be compressible; raise "
               "numerics.sound_speed to %.3g m/s",
               check.mach, 10 * check.speed));
  for (const SoundSpeedTerm& term : built.sound_speed_terms)
    if (term.name == "impact" && term.speed > 0.3 * check.sound_speed)
      check.warnings.push_back(
          format("fluid will meet walls or fluid at %.3g m/s: raise numerics.sound_speed to "
                 "%.3g m/s",
                 term.speed, term.sound_speed()));
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (check.memory > 0.9 * memory)
    check.warnings.push_back(format("the run needs about %.2g GB, this machine has %.2g GB of memory",
                                    check.memory / 1e9, memory / 1e9));
  if (check.steps > most_steps)
    check.warnings.push_back(format(
        "%.2g steps to output.end_time = %g s, more than 1e9: a run of years; an earlier end_time, a larger "
        "resolution.spacing or a lower numerics.sound_speed, which is %.4g m/s, makes it shorter",
        check.steps, built.resolved.output.last_time(), check.sound_speed));
  warn_of_empty_cells(built.setup, check.fed, check.warnings);
  if (check.depth < 4 * check.spacing || check.width < 4 * check.spacing)
    check.warnings.push_back("the fluid is less than 4 particles deep or wide: the resolution is too coarse");
}

std::string exits_text(const Case& c) {
  if (c.domain.departure == Departure::stop) return "none: the run ends with an error when a particle leaves";
  return exits_of(c) + ": what leaves through " +
         (c.exits == std::array<bool, 6>{} ? "a face" : "another face") +
         " of the domain is lost, beyond 0.1 % with a warning";
}

// What comes through an inlet.
std::string inlet_text(const SimulationSetup& setup, const InletSetup& in, double last) {
  const double area = columns_area(setup, in);
  const double fastest = in.rate.fastest(), flow = fastest * area;
  const bool flat = setup.dimensions == 2;
  return format("inlet %-10s %zu columns, %.4g %s; up to %.4g m/s, %.4g %s, %.4g kg/s%s; %.6g kg to the end",
                in.name.c_str(), in.share.size(), area, flat ? "m high" : "m^2", fastest, flow,
                flat ? "m^2/s" : "m^3/s", flow * setup.fluids[in.fluid].rest_density,
                flat ? " a metre of width" : "",
                area * setup.fluids[in.fluid].rest_density *
                    (in.rate.travelled(last) - in.rate.travelled(setup.start_time)));
}

void add_facts(CaseCheck& check, const BuiltCase& built) {
  const SimulationSetup& setup = built.setup;
  check.pieces = fluid_pieces(setup, built.resolved.origin);
  check.fluid_across = std::numeric_limits<double>::quiet_NaN();
  for (const FluidPiece& piece : check.pieces)
    if (!(piece.across >= check.fluid_across)) check.fluid_across = piece.across;
  check.walls = wall_thicknesses(built.resolved, setup);
  check.wall = thinnest_of(check.walls);
  const Vec3d &a = setup.domain.lower, &b = setup.domain.upper;
  check.extents = format("(%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g) m", a.x, a.y, a.z, b.x, b.y, b.z);
  check.files = stl_extents(built.resolved);
}

// Of what inlets bring half is there in the mean.
void add_costs(CaseCheck& check, const BuiltCase& built) {
  const OutputSpec& output = built.resolved.output;
  const double particles = static_cast<double>(check.fluid_particles) + 0.5 * static_cast<double>(check.fed);
  const double cost = check.exact_yield ? exact_yield_cost : 1;
  const double speed =
      check.machine.particle_steps > 0 ? check.machine.particle_steps : particle_steps_per_second;
  check.run_time = check.steps * particles / speed * cost;
  check.gpu_time = check.steps * modelled_gpu_step(particles) * cost;
  const double time = output.last_time() - built.setup.start_time;
  check.snapshots = output.interval > 0 ? std::floor(time / output.interval) + 1 : 0;
  bool moves = false;
  for (const WallSpec& wall : built.resolved.walls) moves = moves || wall.motion.moves();
  const double walls =
      built.resolved.output.walls ? bytes_per_snapshot_wall * static_cast<double>(check.wall_particles) : 0;
  check.output =
      check.snapshots * bytes_per_snapshot_particle * particles + (moves ? check.snapshots : 1) * walls;
}

// With all that inlets bring, of which nothing may have left.
double memory_of(const SimulationSetup& setup, double last_time) {
  const auto fed =
      static_cast<double>(fed_particles(setup, last_time) - fed_particles(setup, setup.start_time));
  return bytes_per_fluid_particle * (static_cast<double>(setup.particles.position.size()) + fed) +
         bytes_per_wall_particle * static_cast<double>(setup.walls.position.size()) +
         bytes_per_cell * empty_cells(setup);
}

// Where most of it is for what an inlet brings.
void refuse_feed(const BuiltCase& built, double needed, double available) {
  const SimulationSetup& setup = built.setup;
  const Case& c = built.resolved;
  const double last = c.flow_end();
  std::size_t most = 0;
  const auto volume = [&](std::size_t k) {
    return columns_area(setup, setup.inlets[k]) * setup.inlets[k].rate.travelled(last);
  };
  for (std::size_t k = 0; k < setup.inlets.size(); ++k)
    if (volume(k) > volume(most)) most = k;
  const std::int64_t fed = fed_particles(setup, last) - fed_particles(setup, setup.start_time);
  if (bytes_per_fluid_particle * static_cast<double>(fed) < 0.5 * needed) return;
  refuse_inlet(c, most, feed_key(c.inlets[most]),
               feed_text(c, c.inlets[most], columns_area(setup, setup.inlets[most])) + ", inlets bring " +
                   std::to_string(fed) + " particles by " + show(last) + " s, which need about " +
                   gigabytes(needed) + " of memory, " + gigabytes(available) +
                   " are available: allowed: less flow, an earlier output.end_time or a larger "
                   "resolution.spacing; is the unit right?");
}

}  // namespace

void require_memory(const BuiltCase& built, double available) {
  const SimulationSetup& setup = built.setup;
  const double needed = memory_of(setup, built.resolved.flow_end());
  if (needed <= available) return;
  refuse_feed(built, needed, available);
  const char* key = "resolution.spacing";
  throw InputError(built.resolved.place_of(key) + ": key '" + key + "': value " + show(setup.spacing) +
                   " gives " + std::to_string(setup.particles.position.size()) + " fluid and " +
                   std::to_string(setup.walls.position.size()) + " wall particles, which need about " +
                   gigabytes(needed) + " of memory, " + gigabytes(available) +
                   " are available: allowed: a larger spacing or smaller regions");
}

CaseCheck check_case(const BuiltCase& built, const MachineSpeed& machine) {
  const SimulationSetup& setup = built.setup;
  CaseCheck check;
  check.fluid_particles = static_cast<std::int64_t>(setup.particles.position.size());
  check.wall_particles = static_cast<std::int64_t>(setup.walls.position.size());
  check.spacing = setup.spacing;
  check.support_radius = setup.support_ratio * setup.spacing;
  check.sound_speed = setup.numerics.sound_speed;
  check.viscosity_correction = viscosity_correction(setup);
  add_time_step(check, built);
  add_sound_speeds(check, built);
  add_lengths(check, setup);
  add_speed(check, built);
  add_numbers(check, setup);
  check.mach = check.speed / check.sound_speed;
  check.exits = exits_text(built.resolved);
  const double last = built.resolved.flow_end();
  check.memory = memory_of(setup, last);
  check.fed = fed_particles(setup, last) - fed_particles(setup, setup.start_time);
  for (const InletSetup& in : setup.inlets) check.inlets.push_back(inlet_text(setup, in, last));
  check.exact_yield = setup.numerics.yield == YieldModel::exact;
  check.machine = machine;
  add_facts(check, built);
  add_costs(check, built);
  check.heat = check_heat(built, check.speed, check.depth, check.walls);
  add_warnings(check, built);
  check.advice = advice(check, built);
  return check;
}

}  // namespace slagflow
