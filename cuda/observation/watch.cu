#include <cmath>
#include <sstream>

#include "backend/error.hpp"
#include "fluid/constants.hpp"
#include "heat/heat.hpp"
#include "observation/watch.hpp"

namespace slagflow {

namespace {

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

double speed_squared(Quad motion) { return static_cast<double>(dot(xyz(motion), xyz(motion))); }
double density_excess(Quad motion) { return static_cast<double>(motion.w); }

}  // namespace

Watch::Watch(Context& context, const SimulationSetup& setup)
    : context_(context),
      setup_(setup),
      particles_(static_cast<double>(setup.particles.fluid.size())),
      mass_(0),
      max_speed_(setup.limits.max_speed > 0 ? setup.limits.max_speed
                                            : runaway_mach * setup.numerics.sound_speed) {
  std::vector<std::int64_t> count(setup.fluids.size());
  for (const std::uint8_t kind : setup.particles.fluid) ++count[kind];
  for (std::size_t kind = 0; kind < count.size(); ++kind)
    mass_ += static_cast<double>(count[kind]) * particle_mass(setup, kind);
  // What is about to come through inlets belongs to the measure of a growth.
  for (const InletSetup& in : setup.inlets)
    mass_ +=
        static_cast<double>(in.origin.size()) * inlet_moving_rows(setup) * particle_mass(setup, in.fluid);
}

void Watch::begin(const FluidArrays& fluid, Span<const FluidConstants> fluids, DiagnosticScratch& scratch) {
  if (fluid.count.of_all() == 0) return;
  GatheredSums sums(context_, scratch);
  Vitals vitals;
  gather_vitals(sums, fluid, fluids, setup_, vitals);
  sums.read();
  seen.lowest_energy = seen.recent_energy = vitals.kinetic_energy + vitals.stored_energy;
}

void Watch::look(const FluidArrays& fluid, const Vitals& vitals, const WatchMoment& now) {
  const LimitSetup& limits = setup_.limits;
  const double lost =
      static_cast<double>(now.departed) / larger(1.0, particles_ + static_cast<double>(now.fed));
  if (lost > limits.max_lost_fraction)
    fail(now,
         "a fraction " + number(lost) +
             " of the particles has left the domain; limits.max_lost_fraction is " +
             number(limits.max_lost_fraction),
         "a larger domain, or close its walls");
  const double least_step =
      limits.min_time_step_ratio * smaller(stable_time_step(setup_), conduction_time_step(setup_));
  if (now.time_step < least_step)
    fail(now,
         "the time step fell to " + number(now.time_step) + " s; limits.min_time_step_ratio allows " +
             number(least_step) + " s",
         "a larger sound_speed or a smaller spacing");
  if (fluid.count.of_all() == 0) return;
  if (!(vitals.max_speed <= max_speed_))
    fail_at_worst(
        fluid, now,
        "a speed of " + number(vitals.max_speed) + " m/s; limits.max_speed is " + number(max_speed_) + " m/s",
        speed_squared, "a smaller courant, a larger sound_speed, or thicker walls");
  if (!(vitals.max_compression <= limits.max_compression))
    fail_at_worst(
        fluid, now,
        "a compression (rho - rho0)/rho0 of " + number(vitals.max_compression) +
            "; limits.max_compression is " + number(limits.max_compression),
        density_excess,
        "numerics.sound_speed = " +
            number(
                stiff_enough(setup_.numerics.sound_speed, vitals.max_compression, limits.max_compression)) +
            " (it is " + number(setup_.numerics.sound_speed) + " m/s) or a smaller courant" +
            (setup_.inlets.empty() ? ""
                                   : "; an inlet feeds whatever stands before it: is what it fills full, "
                                     "or does its face look at a wall?"));
  check_energy(vitals, now);
}

// Kinetic, stored and dissipated energy, less the work of moving walls and what pairing and walls gave, can
// only fall; potential energy counts from the lowest point of the domain, so that a particle that leaves
// takes energy with it and never adds any. The measure of what is a growth: kinetic and dissipated energy
// themselves, lifting all fluid by one spacing, and a thousandth of the elastic energy for rounding. On a
// periodic axis along the force the potential has no single value.
void Watch::check_energy(const Vitals& vitals, const WatchMoment& now) {
  const Vec3d force = setup_.gravity + setup_.body_acceleration;
  for (int k = 0; k < 3; ++k)
    if (setup_.domain.periodic[static_cast<std::size_t>(k)] && force[k] != 0) return;
  const double energy = vitals.kinetic_energy + vitals.stored_energy + now.dissipated - now.work - now.given;
  // Places and velocities are half a step apart, so that a particle which bounces may be off by what it
  // exchanges in a step.
  const double unsure = std::fabs(now.just_given), sure_energy = energy - unsure;
  seen.lowest_energy = smaller(seen.lowest_energy, energy + unsure);
  // The work of walls is known to some ten per cent only: their pressure is too low next to the free surface.
  constexpr double work_weight = 3;
  const double scale = vitals.kinetic_energy + larger(now.dissipated, 0.0) +
                       work_weight * std::fabs(now.work) +
                       (mass_ + now.fed_mass) * norm(force) * setup_.spacing + 1e-3 * vitals.elastic_energy;
  const double growth = (sure_energy - seen.lowest_energy) / scale;
  if (growth > setup_.limits.max_energy_growth)
    fail(now,
         "the energy grew by " + number(sure_energy - seen.lowest_energy) +
             " J without a source, a share of " + number(growth) + "; limits.max_energy_growth is " +
             number(setup_.limits.max_energy_growth),
         "a smaller courant");
  check_dissipated(now, scale);
  check_given(vitals, now, scale);
}

// Viscosity takes energy, whatever walls do.
void Watch::check_dissipated(const WatchMoment& now, double scale) const {
  const double most = setup_.limits.max_energy_growth * (scale + std::fabs(now.dissipated));
  if (-now.dissipated > most)
    fail(now,
         "viscosity gave the fluid " + number(-now.dissipated) + " J; limits.max_energy_growth = " +
             number(setup_.limits.max_energy_growth) + " allows " + number(most) + " J",
         "a smaller numerics.tolerance");
}

// Between two looks pairing and walls at rest give no more than what the arrangement of the particles holds,
// a share of the pressure times the volume, unless it is what the fluid has just lost to them or to others: a
// blow loses energy in the density, and walls give some of it back. (Moving walls give as much as they like;
// over a long flow what sheared particles get adds up.)
void Watch::check_given(const Vitals& vitals, const WatchMoment& now, double scale) {
  // What they give back they have taken before: in all, no more.
  const double gain = smaller(now.given - seen.given, now.given);
  const double energy = vitals.kinetic_energy + vitals.stored_energy + now.dissipated - now.work;
  const double above = energy - seen.recent_energy;
  constexpr double forgotten = 0.125;  // a look
  seen.given = now.given;
  seen.recent_energy += above > 0 ? above : forgotten * above;
  if (!setup_.inlets.empty()) return;
  for (const WallBody& body : setup_.bodies)
    if (body.motion.moves()) return;
  constexpr double arrangement = 0.05;
  const double most = setup_.limits.max_energy_growth * scale + arrangement * vitals.pressure_energy;
  if (smaller(gain, above) > most)
    fail(now,
         "the pressure of walls and between close particles gave " + number(gain) + " J in " +
             std::to_string(setup_.limits.interval) +
             " steps, more than they can have; limits.max_energy_growth = " +
             number(setup_.limits.max_energy_growth) + " allows " + number(most) + " J",
         "a smaller courant");
}

void Watch::fail(const WatchMoment& now, const std::string& what, const std::string& advice) const {
  throw Error("stopped in step " + std::to_string(now.step) + " at " + number(now.time) + " s: " + what +
              "; try " + advice);
}

void Watch::fail_at_worst(const FluidArrays& fluid, const WatchMoment& now, const std::string& what,
                          double (*badness)(Quad motion), const std::string& advice) const {
  const auto position = rows_of_all(fluid.position, fluid.count, On::all_ranks);
  const auto motion = rows_of_all(fluid.motion, fluid.count, On::all_ranks);
  const auto id = rows_of_all(fluid.id, fluid.count, On::all_ranks);
  std::size_t worst = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const double b = badness(motion[i]);
    if (!std::isfinite(b) || b > badness(motion[worst])) worst = i;
    if (!std::isfinite(b)) break;
  }
  const Vec3d x = position[worst] + setup_.domain.lower;
  const Quad m = motion[worst];
  std::ostringstream where;
  where << what << "; particle " << id[worst] << " at (" << x.x << ", " << x.y << ", " << x.z
        << ") m, velocity (" << m.x << ", " << m.y << ", " << m.z << ") m/s, density excess " << m.w
        << " kg/m^3";
  fail(now, where.str(), advice);
}

}  // namespace slagflow
