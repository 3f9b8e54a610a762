// What a simulation tells: totals and host copies of its state.
#include <algorithm>

#include "backend/launch.hpp"
#include "shear_stress.hpp"
#include "simulation_state.hpp"

namespace slagflow {

namespace {

struct FlagYielded {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<const Real> stress;
  Span<std::uint8_t> result;
  Span<const Real> held{};  // of an exact yield stress
  HOST_DEVICE void operator()(Index i) const {
    if (held.data)
      result[i] = held[i] < 1 ? 1 : 0;
    else
      result[i] = yielded(fluids[fluid[i]].rheology, stress[i]) ? 1 : 0;
  }
};

struct NoStress {
  Span<Real> result;
  HOST_DEVICE void operator()(Index i) const { result[i] = 0; }
};

template <class T>
std::vector<T> on_host(const Buffer<T>& buffer) {
  std::vector<T> result;
  buffer.download(result);
  return result;
}

}  // namespace

double Simulation::neighbours_mean() const {
  State& s = *state_;
  return mean_neighbours(s.context, s.pairs(), s.diagnostics);
}

Totals Simulation::totals() {
  State& s = *state_;
  Totals t = measure_totals(s.context, s.fluid, s.fluids.span(), s.setup, s.diagnostics);
  t.particles = s.fluid.count;
  t.mass_start = s.start_mass;
  t.dissipated_energy = s.dissipated;
  for (std::size_t kind = 0; kind < s.departed.size(); ++kind)
    for (std::size_t face = 0; face < faces; ++face) {
      t.departed[face] += s.departed[kind][face];
      t.mass_left += static_cast<double>(s.departed[kind][face]) * particle_mass(s.setup, kind);
    }
  if (s.setup.measure_walls)
    for (std::size_t body = 0; body < s.setup.bodies.size(); ++body) {
      t.walls.push_back(s.wall_forces.load(body));
      WallLoad& load = t.walls.back();  // torques about the lower corner become those about the origin
      load.pressure_torque += cross(s.setup.domain.lower, load.pressure);
      load.viscous_torque += cross(s.setup.domain.lower, load.viscous);
    }
  // What left through the face beyond a front's plane has passed it.
  for (std::size_t k = 0; k < t.fronts.size(); ++k) {
    const FrontSetup& front = s.setup.fronts[k];
    t.fronts[k].passed += t.departed[2 * static_cast<std::size_t>(front.axis) + (front.sign > 0 ? 1U : 0U)];
  }
  t.planes = s.planes.states(s.context, s.fluid, s.list_places.span(), s.diagnostics);
  for (const BoxSetup& box : s.setup.boxes)
    t.boxes.push_back(count_in_box(s.context, s.fluid, box, s.setup.domain.lower, s.diagnostics));
  return t;
}

std::vector<ProfilePoint> Simulation::profile(std::size_t line) const {
  State& s = *state_;
  const ProfileSource source{
      s.fluid, s.ordering.fluid_sources(s.fluid), s.box, s.reach.support, s.displacement, s.setup.dimensions};
  return measure_profile(s.context, source, s.setup.lines.at(line), s.setup.domain.lower);
}

// Before the first step there are no pairs, and no stress.
void Simulation::State::measure_stress(Span<Real> result) {
  if (builds == 0)
    launch(context, "shear stress", fluid.count, NoStress{result});
  else if (exact_yield())
    viscous.exact_yield().measure_stress(pairs(), fluid.shear_rate.span(), result);
  else
    measure_shear_stress(context, pairs(), result);
}

void Simulation::read(FluidSnapshot& out) {
  State& s = *state_;
  const auto n = static_cast<std::size_t>(s.fluid.count);
  Buffer<std::uint8_t> flags(s.context, "yielded", s.fluid.count);
  Buffer<Real> stress(s.context, "shear stresses", s.fluid.count);
  s.measure_stress(stress.span());
  launch(s.context, "yielded", s.fluid.count,
         FlagYielded{s.fluids.span(), s.fluid.fluid.span(), stress.span(), flags.span(),
                     s.exact_yield() ? s.viscous.exact_yield().held() : Span<const Real>{}});
  const auto position = on_host(s.fluid.position);
  const auto motion = on_host(s.fluid.motion);
  const auto state = on_host(s.fluid.state);
  const auto pressure = on_host(s.fluid.pressure), shear_rate = on_host(s.fluid.shear_rate),
             shear_stress = on_host(stress);
  const auto id = on_host(s.fluid.id);
  const auto fluid = on_host(s.fluid.fluid), is_yielded = on_host(flags);

  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });

  out.time = s.time;
  out.position.resize(n), out.velocity.resize(n), out.pressure.resize(n), out.density.resize(n);
  out.viscosity.resize(n), out.shear_rate.resize(n), out.shear_stress.resize(n), out.yielded.resize(n),
      out.fluid.resize(n), out.id.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    out.position[k] = position[i] + s.setup.domain.lower;
    out.velocity[k] = {static_cast<float>(motion[i].x), static_cast<float>(motion[i].y),
                       static_cast<float>(motion[i].z)};
    out.pressure[k] = static_cast<float>(pressure[i]);
    out.density[k] =
        static_cast<float>(s.setup.fluids[fluid[i]].rest_density + static_cast<double>(motion[i].w));
    out.viscosity[k] = static_cast<float>(state[i].y);
    out.shear_rate[k] = static_cast<float>(shear_rate[i]);
    out.shear_stress[k] = static_cast<float>(shear_stress[i]);
    out.yielded[k] = is_yielded[i];
    out.fluid[k] = fluid[i];
    out.id[k] = id[i];
  }
}

void Simulation::read(WallSnapshot& out) {
  State& s = *state_;
  const auto id = on_host(s.wall.id);
  const auto pressure = on_host(s.wall.pressure);
  std::vector<float> by_id(s.setup.walls.body.size());
  for (std::size_t i = 0; i < id.size(); ++i)
    by_id[static_cast<std::size_t>(id[i])] = static_cast<float>(pressure[i]);
  out.time = s.time;
  out.moves = s.walls.any();
  out.position.clear(), out.pressure.clear(), out.body.clear();
  for (std::size_t k = 0; k < by_id.size(); ++k) {
    const std::uint8_t body = s.setup.walls.body[k];
    if (s.walls.removed(body, s.time)) continue;
    out.position.push_back(s.walls.position_at(s.setup.walls.position[k], body, s.time));
    out.pressure.push_back(by_id[k]), out.body.push_back(body);
  }
}

}  // namespace slagflow
