#include "backend/error.hpp"
#include "simulation/advance.hpp"
#include "simulation/sharing.hpp"
#include "simulation/simulation_state.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow {

namespace {

Vec3d extent(const SimulationSetup& s) { return s.domain.upper - s.domain.lower; }

ListReach list_reach(const SimulationSetup& s) {
  const double h = s.support_ratio * s.spacing, skin = s.numerics.skin * h;
  return {h, skin, skin, h + skin};
}

CellGrid cover_domain(const SimulationSetup& s) {
  // A shorter period would let a pair meet twice, through two images.
  const double least = 2 * (list_reach(s).support + list_reach(s).wall_skin);
  for (int k = 0; k < 3; ++k)
    if (s.domain.periodic[static_cast<std::size_t>(k)] && extent(s)[k] < least)
      throw InputError("domain: the extent along periodic axis " + std::string(1, "xyz"[k]) + " is " +
                       std::to_string(extent(s)[k]) + " m; allowed: at least " + std::to_string(least) +
                       " m, twice the reach of the neighbour list");
  // Of many particles cells may be many, too; empty ones take time and memory.
  constexpr double a_particle = 8, numbered = 2e9;
  const auto particles = static_cast<double>(s.particles.position.size() + s.walls.position.size());
  const double most = smaller(numbered, larger(CellGrid::usual_most, a_particle * particles));
  return CellGrid::cover(extent(s), s.domain.periodic, list_reach(s).width, most);
}

}  // namespace

void require_shareable(const SimulationSetup& s) {
  const CellGrid grid = cover_domain(s);
  Slabs(grid.planes(), grid.periodic[grid.order.axis[2]], ranks().size());
}

namespace {

std::vector<OutletBox> outlet_boxes(const SimulationSetup& s) {
  std::vector<OutletBox> boxes;
  for (const OutletSetup& outlet : s.outlets)
    boxes.push_back({outlet.lower - s.domain.lower, outlet.upper - s.domain.lower});
  return boxes;
}

// The stresses of an exact yield stress belong to the pairs of a list, and the colours of sor to cells that
// do not touch: there all is built anew.
Renewal renewal(const SimulationSetup& s) {
  const bool of_all = s.numerics.yield == YieldModel::exact || s.numerics.solver == ViscousSolver::sor;
  return of_all ? Renewal::of_all : Renewal::by_cell;
}

// Of fluid that rests on its lattice.
FluidMemory memory_at_rest(const SimulationSetup& s) {
  const auto constants = fluid_constants(s);
  const double c2 = s.numerics.sound_speed * s.numerics.sound_speed;
  FluidMemory memory;
  for (std::size_t i = 0; i < s.particles.position.size(); ++i) {
    const FluidConstants& f = constants[s.particles.fluid[i]];
    const auto excess = static_cast<Real>(s.particles.pressure[i] / c2);
    memory.excess.push_back(excess), memory.hollow.push_back(0);
    memory.packing.push_back(1 + excess / f.rest_density);
    memory.by_pressure.push_back(-f.rest_density * to_real(s.gravity));
    memory.id.push_back(static_cast<Index>(i));
  }
  return memory;
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
      inlets(context),
      ordering(context, extent(s), s.domain.periodic, cover_domain(s)),
      fluid_list(context, "fluid neighbours"),
      wall_list(context, "wall neighbours"),
      wall_to_fluid(context, "fluid neighbours of walls"),
      list_age(context, renewal(s)),
      wall_forces(context),
      surface_tension(context, setup),
      list_places(context, "places of the list"),
      scratch(context, "scratch"),
      viscous(context, s.numerics),
      heat(context),
      diagnostics(context),
      watch(context, setup),
      planes(s),
      rectangles(context, s),
      contact(context),
      residence(context),
      below_faces(context),
      sheets(context),
      step_graph(context, "steps"),
      yielded(context, "yielded"),
      side_stream(context) {
  if (setup.time_parts || ranks().several()) step_graph.launch_singly();
  if (setup.numerics.weights == StoredWeights::brief)
    viscous.shorten_weights(short_weight_unit(middle_weight(setup)));
  departed.resize(s.fluids.size());
  ordering.set_outlets(outlet_boxes(s), s.fluids.size());
  time = setup.start_time, last_dt = setup.last_step;
  take_stock();
  if (ranks().several()) deal_out();
  upload_fluid();
  dt = full_dt = longest_step();
  upload_walls();
  planes.begin(context, fluid, diagnostics);
  residence.start(setup);
  list_places.copy_from(fluid.place);
  rectangles.start(fluid);
  rebuild();
  extrapolate_wall_pressure(context, pairs(), wall_to_fluid.view(), wall);
  update_density(context, pairs(), fluid, scratch, 0);  // viscosity and shear rate of the start
  watch.begin(fluid, fluids.span(), diagnostics);
}

// Of all fluid, which remembers something from here on.
void Simulation::State::take_stock() {
  FluidParticles& p = setup.particles;
  if (p.memory.id.empty()) p.memory = memory_at_rest(setup);
  std::vector<std::int64_t> count(setup.fluids.size());
  for (const std::uint8_t kind : p.fluid) ++count[kind];
  for (std::size_t kind = 0; kind < count.size(); ++kind)
    start_mass += static_cast<double>(count[kind]) * particle_mass(setup, kind);
  start_count = p.memory.id.empty() ? 0 : p.memory.id.back() + 1;
}

void Simulation::State::upload_fluid() {
  auto& p = setup.particles;
  const std::size_t n = p.position.size();
  const FluidMemory memory = std::move(p.memory);
  const auto constants = fluid_constants(setup);
  std::vector<Vec3d> position(n);
  std::vector<Quad> place(n), motion(n), by_pressure(n), state(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& f = constants[p.fluid[i]];
    position[i] = p.position[i] - setup.domain.lower;
    place[i] = quad(to_real(position[i]), f.volume(memory.excess[i], memory.packing[i]));
    by_pressure[i] = quad(memory.by_pressure[i], 0);
    state[i] = {static_cast<Real>(p.pressure[i]), viscosity(f.rheology, 0), place[i].w, f.mass};
    motion[i] = quad(to_real(p.velocity[i]), memory.excess[i]);
  }
  fluids.upload(constants);
  fluid.resize(static_cast<Index>(n));
  fluid.position.upload(position), fluid.place.upload(place), fluid.motion.upload(motion),
      fluid.packing.upload(memory.packing), fluid.hollow.upload(memory.hollow), fluid.id.upload(memory.id);
  fluid.fluid.upload(p.fluid);
  fluid.increment.upload(std::vector<Quad>(n)), fluid.last_increment.upload(std::vector<Quad>(n));
  fluid.by_pressure.upload(by_pressure);
  fluid.state.upload(state);
  fluid.pressure.upload({p.pressure.begin(), p.pressure.end()});
  fluid.shear_rate.upload(std::vector<Real>(n));
  heat.start(setup, memory.enthalpy, fluid);
  setup.particles = {};  // from here on the device has them
}

void Simulation::State::upload_walls() {
  walls.upload(setup, wall);
  inlets.upload(setup);
  walls.place({time, dt, 0}, wall), inlets.place({time, dt, 0}, wall);
  if (knows_wall_forces()) wall_forces.start(setup.walls.body);
  contact.start(setup);
  setup.walls.normal = setup.walls.back_normal = {};
  setup.walls.depth = setup.walls.back_depth = {};
  ordering.sort(wall);
}

void Simulation::State::rebuild() {
  Section timer(context, "neighbours");
  planes.advance(context, fluid, list_places.span(), diagnostics, ordering.outlets());
  if (rectangles.any()) rectangles.count(context, fluid, diagnostics);
  residence.leave(fluid, ordering.outlets(), time, diagnostics);
  const bool fed = feed();
  const double content = heat.any() ? heat.content(fluid, fluids.span(), diagnostics) : 0;
  const Index before = fluid.count;
  const bool cut = builds > 0 && ordering.balance();
  ordering.sort(fluid, departed);
  if (heat.any() && fluid.count < before)
    heat.note_left(content, heat.content(fluid, fluids.span(), diagnostics));
  check_departure();
  if (walls.any() || cut) sort_walls();
  build_lists();
  if (exact_yield()) viscous.exact_yield().follow({fluid_list, wall_list, fluid.id, wall.id}, next_id());
  // Columns have stepped back: their pressures are those of other places.
  if (fed) extrapolate_wall_pressure(context, pairs(), wall_to_fluid.view(), wall);
  list_places.copy_from(fluid.place);
  rectangles.start(fluid);
  list_age.begin(ordering.fluid_sources(fluid), moving_wall_sources());
  list_time = time;
  displacement = lists_worn = 0;
  last.reset();
  ++builds;
}

// What the inlets have brought since the last time. Whether there was any.
bool Simulation::State::feed() {
  if (!inlets.any()) return false;
  const Index before = fluid.count, first_id = next_id();
  const FedParticles fed = inlets.feed({time, last_dt, first_id}, wall, fluids.span(), flow, fluid);
  if (fed.position.empty()) return false;
  planes.add(fed.position);
  enter_heat(before, fed);
  residence.enter(first_id, time);
  given += ranks().shared(energy_from(context, before, fluid, fluids.span(), setup, diagnostics));
  inlets.place({time, dt, last_dt}, wall);
  return true;
}

void Simulation::State::enter_heat(Index before, const FedParticles& fed) {
  if (!heat.any()) return;
  std::vector<double> temperature;
  for (const std::size_t inlet : fed.inlet) temperature.push_back(setup.inlets[inlet].temperature);
  heat.enter(before, fed.fluid, temperature, fluid);
}

double Simulation::State::fed_mass() const {
  const std::vector<std::int64_t> fed = inlets.fed();
  double mass = 0;
  for (std::size_t k = 0; k < fed.size(); ++k)
    mass += static_cast<double>(fed[k]) * particle_mass(setup, setup.inlets[k].fluid);
  return mass;
}

std::array<NeighbourList*, 3> Simulation::State::lists() { return {&fluid_list, &wall_list, &wall_to_fluid}; }

std::array<ListedParticles, 3> Simulation::State::listed() const {
  const auto fluid_reach = static_cast<Real>(reach.support + reach.fluid_skin);
  const auto wall_reach = static_cast<Real>(reach.support + reach.wall_skin);
  const SourceView from_fluid = ordering.fluid_sources(fluid), from_walls = ordering.wall_sources(wall);
  const Span<const Quad> places{fluid.place.span().data, fluid.count},
      wall_places{wall.place.span().data, wall.count};
  return {{{from_fluid, places, fluid.count, from_fluid.cell_start, box, fluid_reach, Pairs::self},
           {from_walls, places, fluid.count, from_fluid.cell_start, box, wall_reach, Pairs::other},
           {from_fluid, wall_places, wall.count, from_walls.cell_start, box, wall_reach, Pairs::other}}};
}

void Simulation::State::build_lists() {
  ++arrangement;
  const auto particles = listed();
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const ListedParticles& p = particles[k];
    lists()[k]->build(p.sources, p.targets, p.box, p.reach, p.pairs);
  }
}

// Without places where no wall ever moves.
SourceView Simulation::State::moving_wall_sources() const {
  SourceView sources = ordering.wall_sources(wall);
  if (!walls.any()) sources.place = {};
  return sources;
}

ListAge::Particles Simulation::State::fluid_for_age() const {
  return {ordering.fluid_sources(fluid), displacement, wall_list.near_sources(), fluid.count.halo};
}
ListAge::Particles Simulation::State::walls_for_age() const {
  return {ordering.wall_sources(wall), largest_wall_displacement(), wall_to_fluid.near_sources(),
          wall.count.halo};
}

void Simulation::State::renew_lists(const ListGate& gate) {
  if (renewal(setup) == Renewal::of_all) return;
  const auto particles = listed();
  const Span<const std::uint8_t> worn[] = {list_age.worn(), list_age.worn(), list_age.walls_worn()};
  for (std::size_t k = 0; k < particles.size(); ++k)
    lists()[k]->renew(particles[k], {worn[k], gate, viscous.record()});
}

// What moving walls ask for at the end of a step, when they are where the next one begins.
void Simulation::State::follow_moving_walls() {
  if (!walls.any()) return;
  Section timer(context, "list age");
  place_walls();
  if (!list_age.look(fluid_for_age(), walls_for_age(), reach, viscous.record())) return;
  renew_lists(list_age.gate(reach, nullptr));
  lists_worn = viscous.read().worn;
}

// The walls as they were when the lists were built, in the same order.
void Simulation::State::restore_walls() {
  if (walls.any()) {
    inlets.fed_at(list_time);
    walls.place({list_time, dt, 0}, wall), inlets.place({list_time, dt, 0}, wall);
  }
  if (walls.any() || ranks().several()) ordering.sort(wall);
}

// The lists as they were: from the places at which all were built, in the order that the particles still
// have, and what was renewed since.
void Simulation::State::rebuild_lists_as_saved() {
  fluid.place.swap(list_places);
  ordering.find_cells(fluid);
  build_lists();
  list_age.restore(ordering.fluid_sources(fluid), moving_wall_sources());
  fluid.place.swap(list_places);
  if (exact_yield())
    viscous.exact_yield().take_restored({fluid_list, wall_list, fluid.id, wall.id}, next_id());
  if (!list_age.opened()) return;
  if (walls.any()) place_walls();
  list_age.restore(ordering.fluid_sources(fluid), moving_wall_sources());
  if (renewal(setup) == Renewal::of_all) return;
  const auto particles = listed();
  for (std::size_t k = 0; k < particles.size(); ++k)
    if (!lists()[k]->recall(particles[k], doubtful(particles[k]), list_bits[k])) lists_worn = 1;
  list_bits = {};
}

NeighbourList::Doubtful Simulation::State::doubtful(const ListedParticles& p) const {
  constexpr double rounding = 1e-3;
  const double h = reach.support, outer = static_cast<double>(p.reach);
  return {static_cast<Real>(h * (1 - rounding)), static_cast<Real>(outer + (outer - h) + rounding * h)};
}

void Simulation::State::remember_lists() {
  list_bits = {};
  if (renewal(setup) == Renewal::of_all || !list_age.opened()) return;
  const auto particles = listed();
  for (std::size_t k = 0; k < particles.size(); ++k)
    list_bits[k] = lists()[k]->remember(particles[k], doubtful(particles[k]));
}

void Simulation::State::check_departure() const {
  if (setup.domain.departure != Departure::stop) return;
  for (const auto& by_face : departed)
    for (int face = 0; face < faces; ++face)
      if (by_face[static_cast<std::size_t>(face)] > 0)
        throw Error("a particle left the domain through face " + std::string(face % 2 ? "+" : "-") +
                    "xyz"[face / 2] + " at " + std::to_string(time) + " s, and domain.departure is \"stop\"");
}

bool Simulation::State::lists_hold() const {
  if (walls.vanishes(list_time, time) || inlets.overdue(time) || lists_worn > 0) return false;
  return judge(displacement, largest_wall_displacement(), reach) != Verdict::broken;
}

PairContext Simulation::State::pairs() const {
  PairContext c{fluid_list.view(), wall_list.view(), view(fluid), view(wall), fluids.span(), flow, box};
  c.capillary = surface_tension.acceleration();
  return c;
}

Simulation::Simulation(const SimulationSetup& setup) : state_(std::make_unique<State>(setup)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

// What the watch remembers stays as it is: a look out of turn must not change what it finds later.
void Simulation::require_sound() {
  State& s = *state_;
  const Watch::Seen before = s.watch.seen;
  s.look();
  s.watch.seen = before;
}

double Simulation::time() const { return state_->now(); }
double Simulation::time_step() const { return state_->heat_time > 0 ? state_->heat_dt : state_->dt; }
double Simulation::velocity_time_step() const { return state_->solve_step.dt; }
std::int64_t Simulation::steps() const { return state_->steps; }
PeakCompression Simulation::largest_compression() const { return state_->largest_compression; }
SolveReport Simulation::last_solve() const { return state_->report; }
SolverTotals Simulation::solver_totals() const { return state_->solver; }
std::int64_t Simulation::list_builds() const { return state_->builds; }
std::size_t Simulation::device_bytes() const { return state_->context.allocated(); }
DeviceCounts Simulation::device_counts() const { return state_->context.counts(); }
std::map<std::string, double> Simulation::timings() const { return state_->context.timings(); }

}  // namespace slagflow
