#include <charconv>
#include <limits>

#include "backend/error.hpp"
#include "fluid/constants.hpp"
#include "fluid/lattice_viscosity.hpp"
#include "fluid/yield_rheology.hpp"

namespace slagflow {

namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw InputError(message);
}

// As short as it reads back to the same number.
std::string text_of(double number) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

// The exact yield stress is the minimum of an energy: one of an implicit Euler step with the radial operator.
void exact_yield_conflicts(const NumericsSetup& n, std::vector<Conflict>& found) {
  const std::string with = " with numerics.yield = \"exact\": allowed: ";
  if (n.theta != 1) found.push_back({"numerics.theta", "value " + text_of(n.theta) + with + "1"});
  if (n.viscous_operator != ViscousOperator::radial)
    found.push_back({"numerics.operator", "value \"laplacian\"" + with + "\"radial\""});
  if (n.viscous_step != ViscousStepping::implicit_step)
    found.push_back({"numerics.viscous_step", "value \"explicit\"" + with + "\"implicit\""});
}

// The device repeats iterations that decide by themselves whether they go on.
void device_loop_conflicts(const NumericsSetup& n, std::vector<Conflict>& found) {
  const auto refuse = [&](const std::string& with) {
    found.push_back({"numerics.solver_loop", "value \"conditional\" with " + with + ": allowed: \"batch\""});
  };
  if (n.solver == ViscousSolver::sor) refuse("numerics.solver = \"sor\"");
  if (n.solver == ViscousSolver::jacobi) refuse("numerics.solver = \"jacobi\"");
  if (n.viscous_step == ViscousStepping::explicit_step) refuse("numerics.viscous_step = \"explicit\"");
  if (n.yield == YieldModel::exact) refuse("numerics.yield = \"exact\"");
}

void validate_exact_yield(const SimulationSetup& s) {
  const NumericsSetup& n = s.numerics;
  require(n.yield_augmentation >= 0 && n.yield_iterations > 0,
          "yield_augmentation: allowed: 0 or larger; yield_iterations: larger than 0");
  for (const FluidSetup& f : s.fluids)
    require(allows_exact_yield(f.rheology.kind), "yield \"exact\" with fluid \"" + f.name +
                                                     "\" of rheology \"" + f.rheology.info().name +
                                                     "\"; allowed: newtonian, bingham, "
                                                     "herschel-bulkley, carreau-yasuda");
}

// Sum V |F| x^2 over a lattice.
double gradient_on_lattice(const FlowConstants& flow) {
  const auto dx = static_cast<double>(flow.spacing), h = static_cast<double>(flow.support);
  const int reach = static_cast<int>(h / dx), across = flow.dimensions == 3 ? reach : 0;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -across; j <= across; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const double r2 = square(dx) * (i * i + j * j + k * k);
        if (r2 >= square(h)) continue;
        sum -= static_cast<double>(flow.smoothing.gradient(static_cast<Real>(r2))) * square(i * dx);
      }
  return sum * static_cast<double>(flow.wall_volume);
}

double particle_volume(const SimulationSetup& s) { return std::pow(s.spacing, s.dimensions); }

}  // namespace

bool allows_exact_yield(RheologyKind kind) {
  if (yield_parameter(kind) >= 0) return true;
  const RheologyInfo& info = rheologies[static_cast<std::size_t>(kind)];
  for (int k = 0; k < info.parameter_count; ++k)
    if (info.parameters[k].role == ParameterRole::yield_stress) return false;
  return true;
}

std::vector<Conflict> conflicts(const NumericsSetup& n) {
  std::vector<Conflict> found;
  if (n.yield == YieldModel::exact) exact_yield_conflicts(n, found);
  if (n.solver_loop == SolverLoop::conditional) device_loop_conflicts(n, found);
  return found;
}

std::string tension_conflict(double wall_limit, const NumericsSetup& n) {
  if (!(wall_limit > n.tension_limit)) return "";
  return "value " + text_of(wall_limit) +
         ": allowed: up to what the fluid bears, numerics.tension_limit = " + text_of(n.tension_limit) +
         " [Pa]";
}

void validate(const SimulationSetup& s) {
  require(s.spacing > 0, "spacing is " + std::to_string(s.spacing) + " m; allowed: larger than 0");
  require(s.dimensions == 2 || s.dimensions == 3,
          "dimensions is " + std::to_string(s.dimensions) + "; allowed: 2, 3");
  require(s.numerics.sound_speed > 0,
          "sound_speed is " + std::to_string(s.numerics.sound_speed) + " m/s; allowed: larger than 0");
  require(s.numerics.theta > 0 && s.numerics.theta <= 1,
          "theta is " + std::to_string(s.numerics.theta) + "; allowed: 0.5 to 1");
  require(!s.fluids.empty(), "there is no fluid");
  for (const Conflict& c : conflicts(s.numerics)) throw InputError(c.key + ": " + c.what);
  if (s.numerics.yield == YieldModel::exact) validate_exact_yield(s);
  for (const WallBody& body : s.bodies) {
    const std::string conflict = tension_conflict(body.tension_limit, s.numerics);
    require(conflict.empty(), "tension_limit of wall \"" + body.name + "\": " + conflict);
  }
  const auto& p = s.particles;
  const std::size_t n = p.position.size();
  require(n < static_cast<std::size_t>(std::numeric_limits<Index>::max()),
          "more than 2^31 - 1 fluid particles");
  require(p.velocity.size() == n && p.pressure.size() == n && p.fluid.size() == n,
          "particle arrays differ in length");
  const FluidMemory& m = p.memory;
  require(m.id.empty() || (m.id.size() == n && m.excess.size() == n && m.hollow.size() == n &&
                           m.packing.size() == n && m.by_pressure.size() == n),
          "arrays of what the fluid remembers differ in length");
  const auto& w = s.walls;
  require(w.position.size() < static_cast<std::size_t>(std::numeric_limits<Index>::max()),
          "more than 2^31 - 1 wall particles");
  require(w.normal.size() == w.position.size() && w.depth.size() == w.position.size() &&
              w.body.size() == w.position.size() &&
              (w.back_depth.empty() || w.back_depth.size() == w.position.size()) &&
              w.back_normal.size() == w.back_depth.size(),
          "wall arrays differ in length");
  for (const InletSetup& in : s.inlets)
    require(!in.origin.empty() && in.share.size() == in.origin.size() && in.stride > 0 &&
                in.body < s.bodies.size() && in.fluid < s.fluids.size(),
            "inlet \"" + in.name + "\" has no columns, or not as it should");
  for (int k = 0; k < 3; ++k)
    require(s.domain.upper[k] > s.domain.lower[k],
            "the domain has no extent along axis " + std::string(1, "xyz"[k]));
}

int inlet_moving_rows(const SimulationSetup& s) { return static_cast<int>(std::ceil(s.support_ratio)) + 2; }

int inlet_rows(const SimulationSetup& s) { return 2 * inlet_moving_rows(s) - 2; }

double inlet_row_place(int row, int moving_rows) { return row < moving_rows ? row + 0.5 : row - 1.5; }

double wall_tension_limit(const WallBody& body, const NumericsSetup& n) {
  if (body.tension_limit >= 0) return body.tension_limit;
  return n.tension == TensionModel::limit ? n.tension_limit : 0;
}

double common_wall_tension_limit(const SimulationSetup& s) {
  const double first =
      s.bodies.empty() ? s.numerics.tension_limit : wall_tension_limit(s.bodies.front(), s.numerics);
  for (const WallBody& body : s.bodies)
    if (wall_tension_limit(body, s.numerics) != first) return -1;
  return first;
}

double anti_pairing(const SimulationSetup& s) {
  if (s.numerics.anti_pairing >= 0) return s.numerics.anti_pairing;
  bool needed = s.numerics.kernel == SmoothingKind::lucy;
  for (const FluidSetup& fluid : s.fluids) needed = needed || fluid.surface_tension > 0;
  return needed ? 0.1 : 0;
}

FlowConstants flow_constants(const SimulationSetup& s) {
  const double h = s.support_ratio * s.spacing, c0 = s.numerics.sound_speed;
  FlowConstants flow;
  flow.smoothing = Smoothing(s.numerics.kernel, h, s.dimensions, s.numerics.viscous_weight);
  flow.dimensions = s.dimensions;
  flow.spacing = static_cast<Real>(s.spacing);
  flow.support = static_cast<Real>(h);
  flow.wall_volume = static_cast<Real>(particle_volume(s));
  flow.gravity = to_real(s.gravity);
  flow.body_acceleration = to_real(s.body_acceleration);
  flow.sound_speed_squared = static_cast<Real>(c0 * c0);
  flow.diffusion = static_cast<Real>(s.numerics.density_diffusion * h * c0);
  flow.damping_reference = static_cast<Real>(c0 * h);
  flow.viscous_tension = s.numerics.tension != TensionModel::limit;
  flow.flat_tension = s.numerics.kernel != SmoothingKind::lucy;
  flow.tension_limit = static_cast<Real>(s.numerics.tension_limit);
  flow.wall_tension_limit = static_cast<Real>(common_wall_tension_limit(s));
  flow.tension_reference = static_cast<Real>(c0 * s.spacing / 40);
  flow.anti_pairing = static_cast<Real>(anti_pairing(s));
  flow.pairing_reference = 1 / flow.smoothing.value(square(flow.spacing));
  flow.inverse_gradient_sum = static_cast<Real>(1 / gradient_on_lattice(flow));
  const double correction = viscosity_correction(s);
  const bool radial = s.numerics.viscous_operator == ViscousOperator::radial;
  flow.coupling = radial ? PairCoupling::radial : PairCoupling::isotropic;
  flow.operator_factor = static_cast<Real>((radial ? 2 * (s.dimensions + 2) : 2) * correction);
  flow.shear_factor = static_cast<Real>((s.dimensions + 2) * correction);
  return flow;
}

double particle_mass(const SimulationSetup& s, std::size_t kind) {
  // 24 bits, so that the mass of up to 2^29 particles, and the sum of what is in and what left, are exact.
  return static_cast<float>(s.fluids[kind].rest_density * particle_volume(s));
}

std::vector<FluidConstants> fluid_constants(const SimulationSetup& s) {
  std::vector<FluidConstants> result;
  for (std::size_t kind = 0; kind < s.fluids.size(); ++kind)
    result.push_back({static_cast<Real>(s.fluids[kind].rest_density),
                      static_cast<Real>(particle_mass(s, kind)), s.fluids[kind].rheology,
                      s.thermal.on ? static_cast<Real>(s.fluids[kind].material.max_viscosity) : Real(1e30)});
  return result;
}

PeriodicBox periodic_box(const SimulationSetup& s) {
  PeriodicBox box;
  for (int k = 0; k < 3; ++k)
    if (s.domain.periodic[static_cast<std::size_t>(k)]) {
      const double extent = s.domain.upper[k] - s.domain.lower[k];
      box.period[k] = static_cast<Real>(extent);
      box.inverse[k] = static_cast<Real>(1 / extent);
    }
  return box;
}

double viscosity_correction(const SimulationSetup& s) {
  if (s.numerics.viscosity_correction > 0) return s.numerics.viscosity_correction;
  return 1 / lattice_viscosity(s.numerics.viscous_operator, {s.numerics.kernel, s.numerics.viscous_weight},
                               s.support_ratio, s.dimensions);
}

double capillary_time_step(const SimulationSetup& s) {
  const double pi = 3.14159265358979324;
  double dt = std::numeric_limits<double>::infinity();
  for (const FluidSetup& f : s.fluids)
    if (f.surface_tension > 0)
      dt = smaller(dt, std::sqrt(f.rest_density * std::pow(s.spacing, 3) / (2 * pi * f.surface_tension)));
  return s.numerics.courant * dt;
}

double diffusion_time_step(const SimulationSetup& s) {
  constexpr double pi = 3.14159265358979324, share = 0.7;
  constexpr int shells = 1000;
  const double h = s.support_ratio * s.spacing, width = h / shells;
  const Smoothing smoothing(s.numerics.kernel, h, s.dimensions);
  double sum = 0;  // of V |F| [1/m^2], as an integral
  for (int k = 0; k < shells; ++k) {
    const double r = (k + 0.5) * width, around = s.dimensions == 2 ? 2 * pi * r : 4 * pi * r * r;
    sum -= static_cast<double>(smoothing.gradient(static_cast<Real>(r * r))) * around * width;
  }
  return share * 2 / (s.numerics.density_diffusion * h * s.numerics.sound_speed * sum);
}

double stiff_enough(double sound_speed, double compression, double allowed) {
  const double wanted = 1.1 * sound_speed * compression / allowed;
  const double digit = std::pow(10, std::floor(std::log10(wanted)) - 1);
  return std::ceil(wanted / digit) * digit;
}

double stable_time_step(const SimulationSetup& s) {
  const double acoustic = s.numerics.courant * 0.5 * s.support_ratio * s.spacing / s.numerics.sound_speed;
  double dt = smaller(acoustic, capillary_time_step(s));
  if (s.numerics.density_diffusion > 0) dt = smaller(dt, diffusion_time_step(s));
  if (s.end_time > 0) dt = smaller(dt, 0.5 * s.end_time);
  return s.numerics.max_time_step > 0 ? smaller(dt, s.numerics.max_time_step) : dt;
}

}  // namespace slagflow
