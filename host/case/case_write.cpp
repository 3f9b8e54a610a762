// A case as a TOML file with every key.
#include <cstdio>
#include <sstream>

#include "host/case/case_sections.hpp"

namespace slagflow {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < ' ' || c == 127) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04X", static_cast<unsigned>(c));
      result += escaped;
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string text_of(const Vec3d& v) { return "[" + show(v.x) + ", " + show(v.y) + ", " + show(v.z) + "]"; }
std::string text_of(bool value) { return value ? "true" : "false"; }

template <class E>
std::string name_of(const std::vector<std::string>& names, E value) {
  return quoted(names[static_cast<std::size_t>(value)]);
}

std::string form_text(const BoxSpec& s) {
  return "shape = \"box\", min = " + text_of(s.min) + ", max = " + text_of(s.max);
}
std::string form_text(const PlaneSpec& s) {
  return "shape = \"plane\", point = " + text_of(s.point) + ", normal = " + text_of(s.normal);
}
std::string form_text(const CylinderSpec& s) {
  return "shape = \"cylinder\", start = " + text_of(s.start) + ", end = " + text_of(s.end) +
         ", radius = " + show(s.radius);
}
std::string form_text(const SphereSpec& s) {
  return "shape = \"sphere\", center = " + text_of(s.center) + ", radius = " + show(s.radius);
}
std::string form_text(const StlSpec& s) {
  return "shape = \"stl\", file = " + quoted(s.file) + ", scale = " + show(s.scale) +
         ", translate = " + text_of(s.translate);
}

std::string text_of(const std::vector<ShapeSpec>& shapes) {
  std::string text = "[";
  for (const ShapeSpec& shape : shapes)
    text += "\n  {" + std::visit([](const auto& form) { return form_text(form); }, shape.form) +
            ", outside = " + text_of(shape.outside) + "},";
  return text + (shapes.empty() ? "]" : "\n]");
}

std::string text_of(const std::vector<WaveSpec>& waves) {
  std::string text = "[";
  for (const WaveSpec& wave : waves)
    text += "\n  {amplitude = " + text_of(wave.amplitude) + ", wave_vector = " + text_of(wave.wave_vector) +
            ", phase = " + show(wave.phase) + "},";
  return text + (waves.empty() ? "]" : "\n]");
}

std::string pressure_text(const RegionSpec& region) {
  return region.pressure == InitialPressure::uniform ? show(region.uniform_pressure)
                                                     : name_of(pressure_names, region.pressure);
}

void write_frame(std::ostream& out, const Case& c) {
  out << "# The resolved case: every key with its value, defaults included.\n"
      << "[case]\nname = " << quoted(c.name) << "\ndescription = " << quoted(c.description) << "\n\n"
      << "[resolution]\nspacing = " << show(c.spacing) << "\nsupport_ratio = " << show(c.support_ratio)
      << "\ndimensions = " << c.dimensions << "\norigin = " << text_of(c.origin) << "\n\n"
      << "[gravity]\nacceleration = " << text_of(c.gravity) << "\n\n"
      << "[body_force]\nacceleration = " << text_of(c.body_force) << "\n\n"
      << "[domain]\nmin = " << text_of(c.domain.lower) << "\nmax = " << text_of(c.domain.upper)
      << "\nperiodic = [";
  const char* separator = "";
  for (std::size_t k = 0; k < 3; ++k) {
    if (!c.domain.periodic[k]) continue;
    out << separator << quoted(axis_names[k]);
    separator = ", ";
  }
  out << "]\ndeparture = " << name_of(departure_names, c.domain.departure) << "\nexits = [";
  separator = "";
  for (std::size_t face = 0; face < c.exits.size(); ++face) {
    if (!c.exits[face]) continue;
    out << separator << quoted(direction_names[face]);
    separator = ", ";
  }
  out << "]\n\n";
}

void write_fluids(std::ostream& out, const Case& c) {
  for (const FluidSpec& fluid : c.fluids) {
    out << "[fluid." << fluid.name << "]\ndensity = " << show(fluid.density)
        << "\nsurface_tension = " << show(fluid.surface_tension)
        << "\nrheology = " << quoted(fluid.info().name) << "\n";
    for (int k = 0; k < fluid.info().parameter_count; ++k)
      out << fluid.info().parameters[k].key << " = " << show(fluid.parameters[static_cast<std::size_t>(k)])
          << "\n";
    out << "\n";
  }
  for (const RegionSpec& region : c.regions)
    out << "[[region]]\nfluid = " << quoted(c.fluids[static_cast<std::size_t>(region.fluid)].name)
        << "\nshapes = " << text_of(region.shapes) << "\nsubtract = " << text_of(region.subtract)
        << "\nvelocity = " << text_of(region.velocity)
        << "\nangular_velocity = " << text_of(region.angular_velocity)
        << "\ncenter = " << text_of(region.center) << "\nwaves = " << text_of(region.waves)
        << "\npressure = " << pressure_text(region) << "\njitter = " << show(region.jitter) << "\n\n";
}

std::string text_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + show(value);
  return text + "]";
}
std::string text_of(const std::vector<Vec3d>& values) {
  std::string text;
  for (const Vec3d& value : values) text += (text.empty() ? "[" : ", ") + text_of(value);
  return text + "]";
}

std::string text_of(const WallMotion& m) {
  std::string text = "{type = " + name_of(motion_names, m.kind);
  if (m.kind == MotionKind::constant || m.kind == MotionKind::ramp)
    text += ", velocity = " + text_of(m.velocity) + ", angular_velocity = " + text_of(m.angular_velocity);
  if (m.kind == MotionKind::ramp) text += ", duration = " + show(m.ramp_time);
  if (m.kind == MotionKind::sine)
    text += ", amplitude = " + text_of(m.amplitude) +
            ", angular_amplitude = " + text_of(m.angular_amplitude) + ", frequency = " + show(m.frequency) +
            ", phase = " + show(m.phase);
  if (m.kind == MotionKind::table) {
    text += ", time = " + text_of(m.time) + ", displacement = " + text_of(m.displacement);
    if (!m.angle.empty()) text += ", angle = " + text_of(m.angle) + ", axis = " + text_of(m.axis);
    text += ", interpolation = " + name_of(interpolation_names, m.interpolation);
  }
  if (m.kind != MotionKind::rest)
    text += ", center = " + text_of(m.center) + ", start = " + show(m.start) + ", stop = " + show(m.stop);
  return text + "}";
}

void write_walls(std::ostream& out, const Case& c) {
  for (const WallSpec& wall : c.walls) {
    out << "[[wall]]\nname = " << quoted(wall.name) << "\nslip = " << name_of(slip_names, wall.slip);
    if (wall.slip == WallSlip::partial_slip) out << "\nslip_length = " << show(wall.slip_length);
    out << "\ncontact_angle = " << show(wall.contact_angle)
        << "\ntension_limit = " << (wall.tension_limit < 0 ? quoted("auto") : show(wall.tension_limit));
    if (wall.slip != WallSlip::free_slip)
      out << "\nsurface_velocity = " << text_of(wall.surface.velocity)
          << "\nsurface_angular_velocity = " << text_of(wall.surface.angular_velocity)
          << "\nsurface_center = " << text_of(wall.surface.center);
    out << "\nremove_at = " << show(wall.motion.remove_at) << "\nmotion = " << text_of(wall.motion);
    out << "\nshapes = " << text_of(wall.shapes) << "\nsubtract = " << text_of(wall.subtract) << "\n\n";
  }
}

void write_numerics(std::ostream& out, const Case& c) {
  const NumericsSetup& n = c.numerics;
  out << "[numerics]\nkernel = " << quoted(c.kernel)
      << "\nsound_speed = " << (n.sound_speed > 0 ? show(n.sound_speed) : "\"auto\"")
      << "\ncourant = " << show(n.courant) << "\nmax_time_step = " << show(n.max_time_step)
      << "\ndensity_diffusion = " << show(n.density_diffusion)
      << "\ntension_limit = " << show(n.tension_limit) << "\nanti_pairing = " << show(n.anti_pairing)
      << "\nshifting = " << show(n.shifting) << "\noperator = " << name_of(operator_names, n.viscous_operator)
      << "\nexplicit_part = " << name_of(explicit_names, n.explicit_part) << "\nviscosity_correction = "
      << (n.viscosity_correction > 0 ? show(n.viscosity_correction) : "\"auto\"")
      << "\nviscous_step = " << name_of(stepping_names, n.viscous_step)
      << "\ndiffusion_number = " << show(n.diffusion_number) << "\ntheta = " << show(n.theta)
      << "\nyield = " << name_of(yield_names, n.yield) << "\nyield_iterations = " << n.yield_iterations
      << "\nyield_augmentation = " << (n.yield_augmentation > 0 ? show(n.yield_augmentation) : "\"auto\"")
      << "\nsolver = " << name_of(solver_names, n.solver)
      << "\nsolver_loop = " << name_of(loop_names, n.solver_loop) << "\ntolerance = " << show(n.tolerance)
      << "\nmax_iterations = " << n.max_iterations << "\nrelaxation = " << show(n.relaxation)
      << "\nskin = " << show(n.skin) << "\n\n";
}

void write_measure(std::ostream& out, const Case& c, const MeasureSpec& m) {
  out << "\n[[measure]]\nname = " << quoted(m.name) << "\ntype = " << name_of(measure_names, m.type);
  if (m.type == MeasureType::front || m.type == MeasureType::jet) out << "\nfraction = " << show(m.fraction);
  if (m.type == MeasureType::front || m.type == MeasureType::flow_rate)
    out << "\ndirection = " << name_of(direction_names, index_of(m.direction))
        << "\nposition = " << show(m.position) << "\n";
  else if (m.type == MeasureType::force)
    out << "\nwall = " << quoted(c.walls[static_cast<std::size_t>(m.wall)].name)
        << "\nabout = " << text_of(m.about) << "\n";
  else if (m.type == MeasureType::volume)
    out << "\nmin = " << text_of(m.min) << "\nmax = " << text_of(m.max) << "\n";
  else if (m.type == MeasureType::profile)
    out << "\nstart = " << text_of(m.start) << "\nend = " << text_of(m.end) << "\npoints = " << m.points
        << "\n";
  else
    out << "\nlip = " << text_of(m.lip) << "\noutward = " << name_of(direction_names, index_of(m.outward))
        << "\nbottom = " << show(m.bottom) << "\n";
}

}  // namespace

std::string to_toml(const Case& c) {
  std::ostringstream out;
  write_frame(out, c);
  write_fluids(out, c);
  write_walls(out, c);
  write_numerics(out, c);
  out << limits_text(c.limits);
  out << "[output]\nend_time = " << show(c.output.end_time)
      << "\nuntil = " << (c.output.until > 0 ? show(c.output.until) : "\"end_time\"")
      << "\ninterval = " << show(c.output.interval)
      << "\nhistory_interval = " << show(c.output.history_interval) << "\nwalls = " << text_of(c.output.walls)
      << "\ncheckpoint_interval = " << show(c.output.checkpoint_interval)
      << "\nstop_after = " << quoted(c.output.stop_after) << "\n";
  for (const MeasureSpec& measure : c.measures) write_measure(out, c, measure);
  return out.str();
}

}  // namespace slagflow
