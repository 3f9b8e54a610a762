// Host copies of a simulation's state.
#include <algorithm>
#include <vector>

#include "backend/launch.hpp"
#include "fluid/melt.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

namespace {

struct FlagYielded {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<const Real> stress;
  Span<std::uint8_t> result;
  Span<const Real> held{};  // of an exact yield stress
  Span<const Quad> melt{};  // with heat
  HOST_DEVICE void operator()(Index i) const {
    const Rheology& own = fluids[fluid[i]].rheology;
    bool flows = false;
    if (held.data)
      flows = held[i] < 1;
    else if (melt.size == 0)
      flows = yielded(own, stress[i]);
    else
      flows = !Melt(melt[i]).is_solid() && yielded(Melt(melt[i]).of(own), stress[i]);
    result[i] = flows ? 1 : 0;
  }
};

}  // namespace

struct StateTransfer::Data {
  SideCopy copy;
  std::vector<SideCopy::Part> parts;
  std::vector<const void*> buffers;              // whose contents the parts are
  std::vector<std::vector<std::byte>> together;  // with several ranks: those of all, in place of the copy
  On where = On::first_rank;
  const Simulation::State* of = nullptr;          // null: nothing is under way
  double time = 0, flow_time = 0, list_time = 0;  // walls and inlets go by that of the flow
  Reading what{};
  std::size_t fluid = 0, walls = 0;     // particles
  std::vector<float> wall_temperature;  // [K] by id, where heat is on

  template <class T>
  void add(const Buffer<T>& buffer) {
    parts.push_back({buffer.span().data, static_cast<std::size_t>(buffer.size()) * sizeof(T)});
    buffers.push_back(&buffer);
  }
  // With several ranks what the others have comes at once, to the first or to all.
  template <class T>
  void add(const Buffer<T>& buffer, const Rows& rows) {
    add(buffer);
    if (!rows.halo) return;
    const std::vector<T> all = rows_of_all(buffer, rows, where);
    together.emplace_back(all.size() * sizeof(T));
    if (!all.empty()) std::memcpy(together.back().data(), all.data(), together.back().size());
  }
  void add_shown(const ParticleArrays& arrays) {
    arrays.each(Fate::shown, [&](const auto& array) { add(array, arrays.count); });
  }
  // What the buffer held when the copy was started.
  template <class T>
  const T* part(const Buffer<T>& buffer) const {
    const auto at = std::find(buffers.begin(), buffers.end(), static_cast<const void*>(&buffer));
    const auto number = static_cast<std::size_t>(at - buffers.begin());
    if (!together.empty()) return reinterpret_cast<const T*>(together[number].data());
    return static_cast<const T*>(copy.part(number));
  }
  void put(FluidSnapshot& out) const;
  void put_heat(const std::vector<std::size_t>& order, FluidSnapshot& out) const;
  void put(WallSnapshot& out) const;

  struct End {
    Data& data;
    ~End() {
      data.of = nullptr;
      data.copy.forget();
      data.together.clear();
    }
  };
};

StateTransfer::StateTransfer() : data_(std::make_unique<Data>()) {}
StateTransfer::~StateTransfer() = default;

bool StateTransfer::under_way() const { return data_->of != nullptr; }

void StateTransfer::finish(FluidSnapshot& fluid_out, WallSnapshot& walls_out) {
  const Data::End end{*data_};
  if (data_->together.empty()) data_->copy.wait();
  data_->put(fluid_out);
  if (data_->what == Reading::fluid_and_walls) data_->put(walls_out);
}

void StateTransfer::Data::put(FluidSnapshot& out) const {
  const std::size_t n = fluid;
  const FluidArrays& f = of->fluid;
  const Index* id = part(f.id);
  const Vec3d* position = part(f.position);
  const Quad *motion = part(f.motion), *state = part(f.state);
  const Real *pressure = part(f.pressure), *shear_rate = part(f.shear_rate), *stress = part(of->scratch),
             *thickness = part(of->sheets.thickness());
  const std::uint8_t *kind = part(f.fluid), *yielded = part(of->yielded);
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });

  out.time = time;
  out.position.resize(n), out.velocity.resize(n), out.pressure.resize(n), out.density.resize(n);
  out.viscosity.resize(n), out.shear_rate.resize(n), out.shear_stress.resize(n), out.thickness.resize(n);
  out.yielded.resize(n), out.fluid.resize(n), out.id.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    const Quad m = motion[i];
    out.position[k] = position[i] + of->setup.domain.lower;
    out.velocity[k] = {static_cast<float>(m.x), static_cast<float>(m.y), static_cast<float>(m.z)};
    out.pressure[k] = static_cast<float>(pressure[i]);
    out.density[k] = static_cast<float>(of->setup.fluids[kind[i]].rest_density + static_cast<double>(m.w));
    out.viscosity[k] = static_cast<float>(state[i].y);
    out.shear_rate[k] = static_cast<float>(shear_rate[i]);
    out.shear_stress[k] = static_cast<float>(stress[i]);
    out.thickness[k] = static_cast<float>(thickness[i]);
    out.yielded[k] = yielded[i], out.fluid[k] = kind[i], out.id[k] = id[i];
  }
  put_heat(order, out);
}

void StateTransfer::Data::put_heat(const std::vector<std::size_t>& order, FluidSnapshot& out) const {
  if (!of->heat.any()) return;
  const Quad* heat = part(of->fluid.heat);
  out.heat = true;
  out.temperature.clear(), out.solid_fraction.clear();
  for (const std::size_t i : order) {
    out.temperature.push_back(static_cast<float>(of->heat.reference() + static_cast<double>(heat[i].x)));
    out.solid_fraction.push_back(static_cast<float>(heat[i].w));
  }
}

void StateTransfer::Data::put(WallSnapshot& out) const {
  const WallParticles& w = of->setup.walls;
  const Index* id = part(of->wall.id);
  const Real* pressure = part(of->wall.pressure);
  std::vector<float> by_id(w.body.size());
  for (std::size_t i = 0; i < walls; ++i)
    by_id[static_cast<std::size_t>(id[i])] = static_cast<float>(pressure[i]);
  out.time = time;
  out.moves = of->walls.any();
  out.heat = of->heat.any();
  out.position.clear(), out.pressure.clear(), out.body.clear(), out.temperature.clear();
  for (std::size_t k = 0; k < by_id.size(); ++k) {
    const std::uint8_t body = w.body[k];
    if (of->walls.removed(body, flow_time)) continue;
    out.position.push_back(of->inlets.any() && of->inlets.is_column(k)
                               ? of->inlets.position_at(k, flow_time, list_time)
                               : of->walls.position_at(w.position[k], body, flow_time));
    out.pressure.push_back(by_id[k]), out.body.push_back(body);
    if (out.heat) out.temperature.push_back(wall_temperature[k]);
  }
}

void Simulation::start_reading(StateTransfer& transfer, Reading what) {
  State& s = *state_;
  const Index n = s.fluid.count;
  s.scratch.resize(n), s.yielded.resize(n);
  s.measure_stress(s.scratch.span());
  launch(s.context, "yielded", n,
         FlagYielded{s.fluids.span(), s.fluid.fluid.span(), s.scratch.span(), s.yielded.span(),
                     s.exact_yield() ? s.viscous.exact_yield().held() : Span<const Real>{},
                     s.fluid.melt.span()});
  const Buffer<Real>& thickness = s.sheets.measure(s.pairs());
  StateTransfer::Data& data = *transfer.data_;
  data.what = what, data.time = s.now(), data.flow_time = s.time, data.list_time = s.list_time;
  data.parts.clear(), data.buffers.clear();
  const Rows& rows = s.fluid.count;
  data.add_shown(s.fluid), data.add(s.scratch, rows), data.add(thickness, rows), data.add(s.yielded, rows);
  if (what == Reading::fluid_and_walls) data.add_shown(s.wall);
  const bool here = data.where == On::all_ranks || ranks().first();
  data.fluid = here ? static_cast<std::size_t>(rows.of_all()) : 0;
  data.walls = here ? static_cast<std::size_t>(s.wall.count.of_all()) : 0;
  if (what == Reading::fluid_and_walls && s.heat.any()) data.wall_temperature = s.heat.wall_temperatures();
  if (data.together.empty()) data.copy.start(s.side_stream, data.parts);
  data.of = state_.get();
}

void Simulation::read(FluidSnapshot& fluid) {
  WallSnapshot none;
  state_->own_transfer.data_->where = On::all_ranks;
  start_reading(state_->own_transfer, Reading::fluid);
  state_->context.synchronize();
  state_->own_transfer.finish(fluid, none);
}

void Simulation::read(FluidSnapshot& fluid, WallSnapshot& walls) {
  state_->own_transfer.data_->where = On::all_ranks;
  start_reading(state_->own_transfer, Reading::fluid_and_walls);
  state_->context.synchronize();
  state_->own_transfer.finish(fluid, walls);
}

}  // namespace slagflow
