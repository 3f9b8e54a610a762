#include "host/case/case_sections.hpp"

#include <algorithm>
#include <cctype>

#include "host/case/suspension.hpp"

namespace slagflow {

const std::vector<std::string> kernel_names{"lucy"};
const std::vector<std::string> pressure_names{"hydrostatic", "zero"};
const std::vector<std::string> departure_names{"remove", "stop"};
const std::vector<std::string> solver_names{"multigrid", "conjugate_gradient", "sor", "jacobi"};
const std::vector<std::string> loop_names{"batch", "conditional"};
const std::vector<std::string> operator_names{"radial", "laplacian"};
const std::vector<std::string> stepping_names{"implicit", "explicit"};
const std::vector<std::string> yield_names{"regularised", "exact"};
const std::vector<std::string> explicit_names{"old_velocity", "predicted"};
const std::vector<std::string> scheme_names{"slagflow", "paper"};
const std::vector<std::string> measure_names{"front", "jet", "flow_rate", "volume", "profile", "force"};
const std::vector<std::string> direction_names{"-x", "+x", "-y", "+y", "-z", "+z"};
const std::vector<std::string> axis_names{"x", "y", "z"};

namespace {

constexpr std::size_t most_names = 255;  // particles keep the index of their fluid or wall in one byte

bool plain(unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; }

void read_exits(CaseTable& t, Case& c) {
  std::vector<std::string> exits;
  t.read("exits", exits);
  for (const std::string& face : exits) {
    const auto found = std::find(direction_names.begin(), direction_names.end(), face);
    if (found == direction_names.end())
      t.problem("exits", "value \"" + face + "\" is not a face: allowed: " + join(direction_names));
    else
      c.exits[static_cast<std::size_t>(found - direction_names.begin())] = true;
  }
}

void read_domain(CaseTable t, Case& c) {
  const bool low = t.read("min", c.domain.lower, any_number("m"), Need::required);
  const bool high = t.read("max", c.domain.upper, any_number("m"), Need::required);
  for (int k = 0; low && high && k < 3; ++k) {
    if (c.domain.lower[k] < c.domain.upper[k]) continue;
    t.problem("max", "value " + show(c.domain.upper[k]) + " along " +
                         axis_names[static_cast<std::size_t>(k)] + " is not above domain.min: allowed: > " +
                         show(c.domain.lower[k]) + " [m]");
    break;
  }
  std::vector<std::string> periodic;
  t.read("periodic", periodic);
  for (const std::string& axis : periodic) {
    const auto found = std::find(axis_names.begin(), axis_names.end(), axis);
    if (found == axis_names.end())
      t.problem("periodic", "value \"" + axis + "\" is not an axis: allowed: " + join(axis_names));
    else
      c.domain.periodic[static_cast<std::size_t>(found - axis_names.begin())] = true;
  }
  t.read_enum("departure", c.domain.departure, departure_names);
  read_exits(t, c);
  t.finish();
}

FluidSpec read_fluid(CaseTable& t, const std::string& name) {
  FluidSpec fluid;
  fluid.name = name;
  if (!is_plain_name(name) || name.find('.') != std::string::npos)
    t.problem("", "the name of a fluid: allowed: up to 100 of letters, digits, _ -");
  const bool suspended = is_suspension(t);
  SuspensionSpec suspension;
  if (suspended)
    suspension = read_suspension(t, fluid);
  else
    t.read("density", fluid.density, above(0, "kg/m^3"), Need::required);
  t.read("surface_tension", fluid.surface_tension, at_least(0, "N/m"));
  std::vector<std::string> names;
  for (const RheologyInfo& info : rheologies) names.push_back(info.name);
  if (!t.read_enum("rheology", fluid.rheology, names, Need::required)) return fluid;
  for (int k = 0; k < fluid.info().parameter_count; ++k) {
    const ParameterInfo& parameter = fluid.info().parameters[k];
    double& value = fluid.parameters[static_cast<std::size_t>(k)];
    value = parameter.fallback;
    if (suspended && parameter.role == ParameterRole::viscosity)
      read_raised(t, suspension, parameter, value);
    else if (suspended && parameter.role == ParameterRole::yield_stress)
      read_yield_stress(t, suspension, parameter, value);
    else
      t.read(parameter.key, value, range_of(parameter),
             parameter.fallback < 0 ? Need::required : Need::optional);
  }
  t.finish();
  return fluid;
}

void read_fluid_index(CaseTable& t, const Case& c, RegionSpec& region) {
  std::vector<std::string> names;
  for (const FluidSpec& fluid : c.fluids) names.push_back(fluid.name);
  if (!names.empty() || t.has("fluid"))
    t.read_choice("fluid", region.fluid, names, names.size() > 1 ? Need::required : Need::optional);
}

void read_pressure(CaseTable& t, RegionSpec& region) {
  if (!t.holds_number("pressure")) {
    t.read_enum("pressure", region.pressure, pressure_names);
  } else if (t.read("pressure", region.uniform_pressure, at_least(0, "Pa"))) {
    region.pressure = InitialPressure::uniform;
  }
}

void read_waves(CaseTable& region_table, RegionSpec& region) {
  for (CaseTable& t : region_table.tables("waves", Need::optional)) {
    WaveSpec wave;
    t.read("amplitude", wave.amplitude, any_number("m/s"), Need::required);
    t.read("wave_vector", wave.wave_vector, any_number("1/m"), Need::required);
    t.read("phase", wave.phase, any_number("rad"));
    t.finish();
    region.waves.push_back(wave);
  }
}

void read_fraction(CaseTable& t, MeasureSpec& measure) {
  Range fraction = between(0, 1, "");
  fraction.lower_bound = fraction.upper_bound = Bound::open;
  t.read("fraction", measure.fraction, fraction);
}

// The keys of a front and of a plane.
void read_plane(CaseTable& t, MeasureSpec& measure) {
  int direction = 0;
  if (t.read_choice("direction", direction, direction_names, Need::required))
    measure.direction = direction_of(direction);
  t.read("position", measure.position, any_number("m"), Need::required);
}

void read_jet(CaseTable& t, MeasureSpec& measure) {
  int outward = 0;
  read_fraction(t, measure);
  t.read("lip", measure.lip, any_number("m"), Need::required);
  if (t.read_choice("outward", outward, direction_names, Need::required))
    measure.outward = direction_of(outward);
  t.read("bottom", measure.bottom, any_number("m"), Need::required);
}

void read_profile(CaseTable& t, MeasureSpec& measure) {
  constexpr int most_points = 10000;
  t.read("start", measure.start, any_number("m"), Need::required);
  t.read("end", measure.end, any_number("m"), Need::required);
  t.read_integer("points", measure.points, 2, most_points);
}

void read_force(CaseTable& t, const Case& c, MeasureSpec& measure) {
  std::vector<std::string> names;
  for (const WallSpec& wall : c.walls) names.push_back(wall.name);
  t.read_choice("wall", measure.wall, names, Need::required);
  t.read("about", measure.about, any_number("m"));
}

void read_measure(CaseTable& t, const Case& c, MeasureSpec& measure) {
  switch (measure.type) {
    case MeasureType::front:
      read_fraction(t, measure);
      return read_plane(t, measure);
    case MeasureType::flow_rate:
      return read_plane(t, measure);
    case MeasureType::jet:
      return read_jet(t, measure);
    case MeasureType::volume:
      t.read("min", measure.min, any_number("m"), Need::required);
      t.read("max", measure.max, any_number("m"), Need::required);
      return;
    case MeasureType::profile:
      return read_profile(t, measure);
    case MeasureType::force:
      return read_force(t, c, measure);
  }
}

}  // namespace

void check_name(CaseTable& t, const std::string& name) {
  if (!is_plain_name(name))
    t.problem("name", "value \"" + name +
                          "\" is not a name: allowed: up to 100 of letters, digits, _ - . ; " +
                          "the first a letter, digit or _");
}

void check_count(CaseTable& top, const char* key, std::size_t count) {
  if (count > most_names)
    top.problem(key, std::to_string(count) + " entries: allowed: up to " + std::to_string(most_names));
}

Direction direction_of(int index) { return {index / 2, index % 2 == 0 ? -1 : 1}; }

int index_of(const Direction& direction) { return 2 * direction.axis + (direction.sign > 0 ? 1 : 0); }

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name[0] != '.' && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), plain);
}

void read_frame(CaseTable& top, Case& c) {
  CaseTable about = top.table("case");
  if (about.read("name", c.name, Need::required)) check_name(about, c.name);
  about.read("description", c.description);
  about.finish();

  CaseTable resolution = top.table("resolution");
  resolution.read("spacing", c.spacing, above(0, "m"), Need::required);
  resolution.read("support_ratio", c.support_ratio, between(1.5, 4, ""));
  resolution.read_integer("dimensions", c.dimensions, 2, 3);
  resolution.read("origin", c.origin, any_number("m"));
  resolution.finish();

  for (auto [key, target] : {std::pair{"gravity", &c.gravity}, std::pair{"body_force", &c.body_force}}) {
    CaseTable t = top.table(key);
    t.read("acceleration", *target, any_number("m/s^2"));
    t.finish();
  }
  read_domain(top.table("domain"), c);
}

void read_fluids(CaseTable& top, Case& c) {
  for (auto& [name, t] : top.named_tables("fluid", Need::required)) c.fluids.push_back(read_fluid(t, name));
  check_count(top, "fluid", c.fluids.size());
}

void read_regions(CaseTable& top, Case& c) {
  for (CaseTable& t : top.tables("region", Need::required)) {
    RegionSpec region;
    read_fluid_index(t, c, region);
    read_shapes(t, "shapes", Need::required, c.file, region.shapes);
    read_shapes(t, "subtract", Need::optional, c.file, region.subtract);
    t.read("velocity", region.velocity, any_number("m/s"));
    t.read("angular_velocity", region.angular_velocity, any_number("rad/s"));
    t.read("center", region.center, any_number("m"));
    read_waves(t, region);
    read_pressure(t, region);
    t.read("jitter", region.jitter, between(0, 0.5, "spacings"));
    t.finish();
    c.regions.push_back(region);
  }
}

// One word for the viscous step as the paper has it; keys that are given go before it.
void read_scheme(CaseTable& t, NumericsSetup& n) {
  int scheme = 0;
  if (!t.read_choice("scheme", scheme, scheme_names) ||
      scheme_names[static_cast<std::size_t>(scheme)] != "paper")
    return;
  n.viscous_operator = ViscousOperator::laplacian;
  n.explicit_part = ExplicitPart::predicted;
  n.viscosity_correction = 1;
  n.theta = 0.5;
  n.solver = ViscousSolver::sor;
}

// Operator, time integration and yield stress.
void read_viscous_step(CaseTable& t, NumericsSetup& n) {
  read_scheme(t, n);
  t.read_enum("operator", n.viscous_operator, operator_names);
  t.read_enum("explicit_part", n.explicit_part, explicit_names);
  if (t.says("viscosity_correction", "auto"))
    n.viscosity_correction = 0;
  else
    t.read("viscosity_correction", n.viscosity_correction, between(0.5, 2, "or \"auto\""));
  t.read_enum("viscous_step", n.viscous_step, stepping_names);
  Range diffusion_number = between(0, 1, "");
  diffusion_number.lower_bound = Bound::open;
  t.read("diffusion_number", n.diffusion_number, diffusion_number);
  t.read("theta", n.theta, between(0.5, 1, ""));
  t.read_enum("yield", n.yield, yield_names);
  t.read_integer("yield_iterations", n.yield_iterations, 1, 100000);
  if (!t.says("yield_augmentation", "auto"))
    t.read("yield_augmentation", n.yield_augmentation, above(0, "or \"auto\""));
}

void read_numerics(CaseTable& top, Case& c) {
  CaseTable t = top.table("numerics");
  NumericsSetup& n = c.numerics;
  int kernel = 0;
  if (t.read_choice("kernel", kernel, kernel_names))
    c.kernel = kernel_names[static_cast<std::size_t>(kernel)];
  if (!t.says("sound_speed", "auto")) t.read("sound_speed", n.sound_speed, above(0, "m/s, or \"auto\""));
  Range courant = between(0, 1.2, "");
  courant.lower_bound = Bound::open;
  t.read("courant", n.courant, courant);
  t.read("max_time_step", n.max_time_step, at_least(0, "s"));
  // Diffusion of the density undermines the pressure that balances surface tension.
  constexpr double with_surface_tension = 0.01;
  for (const FluidSpec& fluid : c.fluids)
    if (fluid.surface_tension > 0) n.density_diffusion = with_surface_tension;
  t.read("density_diffusion", n.density_diffusion, between(0, 1, ""));
  t.read("tension_limit", n.tension_limit, at_least(0, "Pa"));
  t.read("anti_pairing", n.anti_pairing, between(0, 1, ""));
  t.read("shifting", n.shifting, between(0, 1, ""));
  read_viscous_step(t, n);
  t.read_enum("solver", n.solver, solver_names);
  t.read_enum("solver_loop", n.solver_loop, loop_names);
  t.read("tolerance", n.tolerance, above(0, ""));
  t.read_integer("max_iterations", n.max_iterations, 1, 100000);
  Range relaxation = between(0, 2, "");
  relaxation.lower_bound = relaxation.upper_bound = Bound::open;
  t.read("relaxation", n.relaxation, relaxation);
  t.read("skin", n.skin, between(0.02, 0.5, ""));
  t.finish();
}

void read_output(CaseTable& top, Case& c) {
  CaseTable t = top.table("output");
  const bool timed = t.read("end_time", c.output.end_time, above(0, "s"), Need::required);
  c.output.interval = c.output.end_time / 50;
  t.read("interval", c.output.interval,
         timed ? at_least(c.output.end_time / most_snapshots, "s") : above(0, "s"));
  c.output.history_interval = c.output.interval / 10;
  t.read("history_interval", c.output.history_interval,
         timed ? at_least(c.output.end_time / most_history_lines, "s") : above(0, "s"));
  Range until = above(0, "s, or \"end_time\"");
  if (timed) until.upper = longest_run(c.output);
  if (!t.says("until", "end_time")) t.read("until", c.output.until, until);
  t.read("walls", c.output.walls);
  t.read("checkpoint_interval", c.output.checkpoint_interval, at_least(0, "s"));
  t.read("stop_after", c.output.stop_after);
  t.finish();
}

void read_measures(CaseTable& top, Case& c) {
  for (CaseTable& t : top.tables("measure", Need::optional)) {
    MeasureSpec measure;
    if (t.read("name", measure.name, Need::required)) check_name(t, measure.name);
    check_unique(t, c.measures, measure.name);
    if (t.read_enum("type", measure.type, measure_names, Need::required)) {
      read_measure(t, c, measure);
      t.finish();
    }
    c.measures.push_back(measure);
  }
}

}  // namespace slagflow
