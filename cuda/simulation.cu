#include <sstream>

#include "advance.hpp"
#include "backend/error.hpp"
#include "shifting.hpp"
#include "simulation_state.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow {

namespace {

Vec3d extent(const SimulationSetup& s) { return s.domain.upper - s.domain.lower; }

ListReach list_reach(const SimulationSetup& s) {
  const double h = s.support_ratio * s.spacing;
  // Fluid slides along walls faster than along itself; wall rows are short, so a thicker skin costs little.
  constexpr double wall_skins = 2.5;
  const double skin = s.numerics.skin * h;
  return {h, skin, wall_skins * skin, h + skin};
}

CellGrid cover_domain(const SimulationSetup& s) {
  // A shorter period would let a pair meet twice, through two images.
  const double least = 2 * (list_reach(s).support + list_reach(s).wall_skin);
  for (int k = 0; k < 3; ++k)
    if (s.domain.periodic[static_cast<std::size_t>(k)] && extent(s)[k] < least)
      throw InputError("domain: the extent along periodic axis " + std::string(1, "xyz"[k]) + " is " +
                       std::to_string(extent(s)[k]) + " m; allowed: at least " + std::to_string(least) +
                       " m, twice the reach of the neighbour list");
  return CellGrid::cover(extent(s), s.domain.periodic, list_reach(s).width);
}

}  // namespace

Simulation::State::State(const SimulationSetup& s)
    : setup((validate(s), s)),
      flow(flow_constants(s)),
      box(periodic_box(s)),
      reach(list_reach(s)),
      fluids(context, "fluid constants"),
      fluid(context),
      wall(context),
      walls(context),
      ordering(context, extent(s), s.domain.periodic, cover_domain(s)),
      fluid_list(context, "fluid neighbours"),
      wall_list(context, "wall neighbours"),
      wall_to_fluid(context, "fluid neighbours of walls"),
      list_age(context),
      wall_forces(context),
      surface_tension(context, setup),
      list_places(context, "places of the list"),
      wall_list_places(context, "wall places of the list"),
      scratch(context, "scratch"),
      viscous(context, s.numerics),
      diagnostics(context),
      watch(context, setup),
      planes(s) {
  departed.resize(s.fluids.size());
  dt = full_dt = stable_time_step(setup);
  upload_fluid();
  upload_walls();
  planes.begin(context, fluid, diagnostics);
  list_places.copy_from(fluid.place);
  rebuild();
  extrapolate_wall_pressure(context, pairs(), wall_to_fluid.view(), wall);
  update_density(context, pairs(), fluid, scratch, 0);  // viscosity and shear rate of the start
  watch.begin(fluid, fluids.span(), diagnostics);
}

void Simulation::State::upload_fluid() {
  const auto& p = setup.particles;
  const std::size_t n = p.position.size();
  const auto constants = fluid_constants(setup);
  const double c2 = setup.numerics.sound_speed * setup.numerics.sound_speed;
  std::vector<Vec3d> position(n);
  std::vector<Quad> place(n), motion(n);
  std::vector<Index> id(n);
  std::vector<std::int64_t> count(setup.fluids.size());
  for (std::size_t i = 0; i < n; ++i) {
    const auto& f = constants[p.fluid[i]];
    const auto excess = static_cast<Real>(p.pressure[i] / c2);
    position[i] = p.position[i] - setup.domain.lower;
    place[i] = quad(to_real(position[i]), f.mass / (f.rest_density + excess));
    motion[i] = quad(to_real(p.velocity[i]), excess);
    id[i] = static_cast<Index>(i);
    ++count[p.fluid[i]];
  }
  for (std::size_t kind = 0; kind < count.size(); ++kind)
    start_mass += static_cast<double>(count[kind]) * particle_mass(setup, kind);
  start_count = static_cast<Index>(n);
  fluids.upload(constants);
  fluid.resize(static_cast<Index>(n));
  fluid.position.upload(position), fluid.place.upload(place), fluid.motion.upload(motion),
      fluid.id.upload(id);
  fluid.fluid.upload(p.fluid);
  fluid.increment.upload(std::vector<Quad>(n)), fluid.last_increment.upload(std::vector<Quad>(n));
  fluid.by_pressure.upload(std::vector<Quad>(n, quad(to_real(-1 * setup.gravity), 0)));
  fluid.state.upload(std::vector<Quad>(n));
  fluid.pressure.upload({p.pressure.begin(), p.pressure.end()});
  fluid.shear_rate.upload(std::vector<Real>(n));
  setup.particles = {};  // from here on the device has them
}

void Simulation::State::upload_walls() {
  walls.upload(setup, wall);
  walls.place(time, dt, wall);
  if (knows_wall_forces()) wall_forces.start(setup.walls.body);
  setup.walls.normal = setup.walls.back_normal = {};
  setup.walls.depth = setup.walls.back_depth = {};
  ordering.sort(wall);
}

void Simulation::State::rebuild() {
  Section timer(context, "neighbours");
  planes.advance(context, fluid, list_places.span(), diagnostics);
  ordering.sort(fluid, departed);
  check_departure();
  if (walls.any()) ordering.sort(wall);
  build_lists();
  if (exact_yield()) viscous.exact_yield().follow({fluid_list, wall_list, fluid.id, wall.id}, start_count);
  list_places.copy_from(fluid.place);
  if (walls.any()) wall_list_places.copy_from(wall.place);
  list_time = time;
  displacement = 0;
  last.reset();
  ++builds;
}

void Simulation::State::build_lists() {
  const auto fluid_reach = static_cast<Real>(reach.support + reach.fluid_skin);
  const auto wall_reach = static_cast<Real>(reach.support + reach.wall_skin);
  const auto sources = ordering.fluid_sources(fluid);
  fluid_list.build(sources, fluid.place.span(), box, fluid_reach, NeighbourList::Pairs::self);
  wall_list.build(ordering.wall_sources(wall), fluid.place.span(), box, wall_reach,
                  NeighbourList::Pairs::other);
  wall_to_fluid.build(sources, wall.place.span(), box, wall_reach, NeighbourList::Pairs::other);
}

// The walls as they were when the lists were built, in the same order.
void Simulation::State::restore_walls() {
  if (!walls.any()) return;
  walls.place(list_time, dt, wall);
  ordering.sort(wall);
  wall_list_places.copy_from(wall.place);
}

// The lists as they were: from the places at which they were built, in the order that the particles still
// have.
void Simulation::State::rebuild_lists_as_saved() {
  fluid.place.swap(list_places);
  ordering.find_cells(fluid);
  build_lists();
  fluid.place.swap(list_places);
  if (exact_yield()) viscous.exact_yield().remember({fluid_list, wall_list, fluid.id, wall.id}, start_count);
}

void Simulation::State::check_departure() const {
  if (setup.domain.departure != Departure::stop) return;
  for (const auto& by_face : departed)
    for (int face = 0; face < faces; ++face)
      if (by_face[static_cast<std::size_t>(face)] > 0)
        throw Error("a particle left the domain through face " + std::string(face % 2 ? "+" : "-") +
                    "xyz"[face / 2] + " at " + std::to_string(time) + " s, and domain.departure is \"stop\"");
}

bool Simulation::State::lists_hold() {
  Section timer(context, "list age");
  if (walls.vanishes(list_time, time)) return false;
  if (last && !walls.any()) return ListAge::lists_hold(*last, reach);
  return list_age.lists_hold(
      {ordering.fluid_sources(fluid), list_places.span(), displacement},
      {ordering.wall_sources(wall), wall_list_places.span(), walls.largest_displacement(list_time, time)},
      reach);
}

PairContext Simulation::State::pairs() const {
  PairContext c{fluid_list.view(), wall_list.view(), view(fluid), view(wall), fluids.span(), flow, box};
  c.capillary = surface_tension.acceleration();
  return c;
}

// The velocity that gravity adds in a step, against which the error of the solve is measured. Without gravity
// a ten-thousandth of the largest speed, of the fluid or a wall, stands for it.
double Simulation::State::kick() {
  const double g = norm(setup.gravity + setup.body_acceleration);
  return g > 0 ? g * dt : 1e-4 * larger(walls.largest_speed(), largest_speed(context, fluid, diagnostics));
}

// The longest stable step; that of an explicit viscous step changes with the viscosities, equation (5).
void Simulation::State::choose_time_step() {
  dt = full_dt;
  if (setup.numerics.viscous_step != ViscousStepping::explicit_step) return;
  const double diffusivity = largest_diffusivity(context, fluid, diagnostics);
  if (diffusivity > 0)
    dt = smaller(dt, setup.numerics.diffusion_number * square(setup.spacing) / diffusivity);
}

ViscousStep::Step Simulation::State::viscous_step() {
  double lightest = 1e300;
  for (const auto& f : fluid_constants(setup)) lightest = smaller(lightest, static_cast<double>(f.mass));
  return {dt, kick(), lightest};
}

void Simulation::State::begin_solve() {
  solve_step = viscous_step();
  viscous.begin(pairs(), solve_step, fluid_list.capacity(), fluid);
}

SolveResult Simulation::State::finish_solve(const StepRecord& now) {
  const auto sources = ordering.fluid_sources(fluid);
  const SolveResult result =
      viscous.finish(now, pairs(), {sources.grid, sources.cell_start}, solve_step, fluid);
  report.iterations = result.iterations;
  report.residual = result.right_hand_side > 0 ? result.residual / result.right_hand_side : 0;
  report.velocity_error = result.residual / (solve_step.mass * std::sqrt(static_cast<double>(fluid.count)));
  report.converged = result.converged;
  solver.iterations += result.iterations;
  solver.max_iterations = larger(solver.max_iterations, result.iterations);
  solver.yield_iterations += result.yield_iterations;
  if (ended_at_yield_iterations(result)) ++solver.yield_unconverged;
  if (!std::isfinite(result.residual)) check_finite();
  return result;
}

bool Simulation::State::ended_at_yield_iterations(const SolveResult& result) const {
  return exact_yield() && !result.converged && result.yield_iterations == setup.numerics.yield_iterations;
}

// A solve that does not converge is tried again with half the time step, and from a first guess of nothing.
void Simulation::State::solve(const StepRecord& begun) {
  constexpr int most_halvings = 4;
  SolveResult result = finish_solve(begun);
  for (int halving = 0; !result.converged; ++halving) {
    if (halving == most_halvings) give_up(result);
    ++solver.retried;
    dt /= 2;
    density_ahead += dt;
    walls.place(time, dt, wall);
    viscous.forget(fluid);
    begin_solve();
    result = finish_solve(viscous.read());
  }
  solver.steps += 1;
  solver.worst_residual = larger(solver.worst_residual, report.residual);
}

// All of it is idle unless the solve has converged.
void Simulation::State::launch_move() {
  add_wall_forces();
  shift();
  StepRecord* record = viscous.record();
  surface_tension.launch_power(fluid, viscous.velocity(), record);
  Section timer(context, "advance");
  advance_particles(context, fluid, {viscous.velocity(), dt}, list_places, record);
  if (!walls.any())
    list_age.launch_approach(ordering.fluid_sources(fluid), list_places.span(),
                             ordering.wall_sources(wall).cell_start, reach, record);
}

// The device goes on to the end of the step before the host looks, once; mostly the solve has converged.
StepRecord Simulation::State::solve_and_move() {
  begin_solve();
  launch_move();
  const StepRecord begun = viscous.read();
  solve(begun);
  if (begun.solve.converged) return begun;
  launch_move();
  return viscous.read();
}

void Simulation::State::give_up(const SolveResult& result) {
  std::ostringstream message;
  message << "the viscous solve did not converge in step " << steps + 1 << " at " << time
          << " s, nor with a time step down to " << dt << " s: residual " << report.residual << " after "
          << result.iterations << " iterations";
  if (ended_at_yield_iterations(result))
    message << ", the exact yield stress after numerics.yield_iterations = " << result.yield_iterations
            << "; try more yield_iterations, a larger tolerance or a smaller courant";
  else
    message << "; try more numerics.max_iterations, solver \"multigrid\" or a smaller courant";
  throw Error(message.str());
}

bool Simulation::State::knows_wall_forces() const {
  return setup.measure_walls || walls.any() || walls.largest_speed() > 0;
}

void Simulation::State::add_wall_forces() {
  if (!knows_wall_forces()) return;
  Section timer(context, "wall forces");
  wall_forces.add(viscous.as_solved(pairs()), wall_to_fluid.view(), wall,
                  {dt, viscous.implicit_share(), viscous.velocity(), viscous.explicit_velocity(fluid),
                   viscous.wall_yield(), surface_tension.view(), &viscous.record()->solve});
}

void Simulation::State::shift() {
  if (setup.numerics.shifting <= 0) return;
  Section timer(context, "shifting");
  shift_particles(context, pairs(),
                  {static_cast<Real>(setup.numerics.shifting), static_cast<Real>(dt), fluid.shear_rate.span(),
                   &viscous.record()->solve},
                  fluid.position.span());
}

void Simulation::State::look() {
  Section timer(context, "watch");
  std::int64_t left = 0;
  for (const auto& by_face : departed)
    for (const std::int64_t count : by_face) left += count;
  const double work = (knows_wall_forces() ? wall_forces.work() : 0) + capillary_work;
  watch.look(fluid, fluids.span(), {time, dt, dissipated, work, steps, left}, diagnostics);
}

// Names the first particle that is not a number: by its motion, or else by its density, which follows within
// a step.
void Simulation::State::check_finite() {
  std::vector<Vec3d> position;
  std::vector<Quad> motion;
  std::vector<Index> id;
  fluid.position.download(position), fluid.motion.download(motion), fluid.id.download(id);
  std::ostringstream message;
  message << "not a number in step " << steps + 1 << " at " << time << " s: ";
  for (const bool motion_only : {true, false})
    for (std::size_t i = 0; i < id.size(); ++i) {
      const Quad m = motion[i];
      const Vec3d x = position[i] + setup.domain.lower;
      if (std::isfinite(m.x + m.y + m.z) && std::isfinite(x.x + x.y + x.z) &&
          (motion_only || std::isfinite(m.w)))
        continue;
      message << "particle " << id[i] << " at (" << x.x << ", " << x.y << ", " << x.z << ") m, velocity ("
              << m.x << ", " << m.y << ", " << m.z << ") m/s, density excess " << m.w
              << " kg/m^3; try a smaller courant or a larger sound_speed";
      throw Error(message.str());
    }
  message << "in the viscous solve; try a smaller courant";
  throw Error(message.str());
}

Simulation::Simulation(const SimulationSetup& setup) : state_(std::make_unique<State>(setup)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::step() {
  State& s = *state_;
  const double last_dt = s.dt;
  s.walls.place(s.time, s.dt, s.wall);
  if (!s.lists_hold()) {
    s.rebuild();
    // A particle may not cross a quarter of the support in one step.
    const double speed = larger(largest_speed(s.context, s.fluid, s.diagnostics), s.walls.largest_speed());
    s.full_dt =
        smaller(stable_time_step(s.setup), 0.25 * static_cast<double>(s.flow.support) / larger(speed, 1e-30));
  }
  s.choose_time_step();
  s.walls.place(s.time, s.dt, s.wall);  // with the velocities of this step
  if (s.fluid.count > 0) {
    s.surface_tension.update(s.pairs(), s.wall.id.span());
    {
      Section timer(s.context, "density and shear rate");
      update_density(s.context, s.pairs(), s.fluid, s.scratch, static_cast<Real>(s.dt - s.density_ahead));
      s.density_ahead = 0;
    }
    launch_dissipation(s.context, s.fluid, &s.viscous.record()->dissipation);
    {
      Section timer(s.context, "wall pressure");
      extrapolate_wall_pressure(s.context, s.pairs(), s.wall_to_fluid.view(), s.wall);
    }
    s.last = s.solve_and_move();
    // What the last step dissipated: the viscous forces acted on the velocities that it ended with.
    if (s.steps > 0) s.dissipated += last_dt * s.last->dissipation;
    s.displacement = std::sqrt(s.last->displacement_squared);
    s.capillary_work += s.dt * s.last->capillary_power;
    if (!std::isfinite(s.displacement)) s.check_finite();
  }
  s.time += s.dt;
  ++s.steps;
  if (s.steps % s.setup.limits.interval == 0) s.look();
}

// What the watch remembers stays as it is: a look out of turn must not change what it finds later.
void Simulation::require_sound() {
  State& s = *state_;
  const double remembered = s.watch.lowest_energy;
  s.look();
  s.watch.lowest_energy = remembered;
}

double Simulation::time() const { return state_->time; }
double Simulation::time_step() const { return state_->dt; }
std::int64_t Simulation::steps() const { return state_->steps; }
SolveReport Simulation::last_solve() const { return state_->report; }
SolverTotals Simulation::solver_totals() const { return state_->solver; }
std::int64_t Simulation::list_builds() const { return state_->builds; }
std::size_t Simulation::device_bytes() const { return state_->context.allocated(); }
std::int64_t Simulation::waits() const { return state_->context.waits(); }
std::map<std::string, double> Simulation::timings() const { return state_->context.timings(); }

}  // namespace slagflow
