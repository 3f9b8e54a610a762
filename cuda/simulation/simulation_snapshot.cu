// Host copies of a simulation's state.
#include <algorithm>
#include <vector>

#include "backend/launch.hpp"
#include "simulation/simulation_state.hpp"

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

// What is copied, in this order.
enum class Part : std::size_t {
  position,
  motion,
  state,
  pressure,
  shear_rate,
  shear_stress,
  id,
  fluid,
  flags,
  wall_id,
  wall_pressure
};

template <class T>
SideCopy::Part all_of(const Buffer<T>& buffer) {
  return {buffer.span().data, static_cast<std::size_t>(buffer.size()) * sizeof(T)};
}

}  // namespace

struct StateTransfer::Data {
  SideCopy copy;
  const Simulation::State* of = nullptr;  // null: nothing is under way
  double time = 0;
  Reading what{};
  std::size_t fluid = 0, walls = 0;  // particles

  template <class T>
  const T* part(Part which) const {
    return static_cast<const T*>(copy.part(static_cast<std::size_t>(which)));
  }
  void put(FluidSnapshot& out) const;
  void put(WallSnapshot& out) const;

  struct End {
    Data& data;
    ~End() {
      data.of = nullptr;
      data.copy.forget();
    }
  };
};

StateTransfer::StateTransfer() : data_(std::make_unique<Data>()) {}
StateTransfer::~StateTransfer() = default;

bool StateTransfer::under_way() const { return data_->of != nullptr; }

void StateTransfer::finish(FluidSnapshot& fluid_out, WallSnapshot& walls_out) {
  const Data::End end{*data_};
  data_->copy.wait();
  data_->put(fluid_out);
  if (data_->what == Reading::fluid_and_walls) data_->put(walls_out);
}

void StateTransfer::Data::put(FluidSnapshot& out) const {
  const std::size_t n = fluid;
  const auto* ids = part<Index>(Part::id);
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });

  out.time = time;
  out.position.resize(n), out.velocity.resize(n), out.pressure.resize(n), out.density.resize(n);
  out.viscosity.resize(n), out.shear_rate.resize(n), out.shear_stress.resize(n), out.yielded.resize(n),
      out.fluid.resize(n), out.id.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    const Quad m = part<Quad>(Part::motion)[i];
    const std::uint8_t kind = part<std::uint8_t>(Part::fluid)[i];
    out.position[k] = part<Vec3d>(Part::position)[i] + of->setup.domain.lower;
    out.velocity[k] = {static_cast<float>(m.x), static_cast<float>(m.y), static_cast<float>(m.z)};
    out.pressure[k] = static_cast<float>(part<Real>(Part::pressure)[i]);
    out.density[k] = static_cast<float>(of->setup.fluids[kind].rest_density + static_cast<double>(m.w));
    out.viscosity[k] = static_cast<float>(part<Quad>(Part::state)[i].y);
    out.shear_rate[k] = static_cast<float>(part<Real>(Part::shear_rate)[i]);
    out.shear_stress[k] = static_cast<float>(part<Real>(Part::shear_stress)[i]);
    out.yielded[k] = part<std::uint8_t>(Part::flags)[i];
    out.fluid[k] = kind;
    out.id[k] = ids[i];
  }
}

void StateTransfer::Data::put(WallSnapshot& out) const {
  const WallParticles& w = of->setup.walls;
  std::vector<float> by_id(w.body.size());
  for (std::size_t i = 0; i < walls; ++i)
    by_id[static_cast<std::size_t>(part<Index>(Part::wall_id)[i])] =
        static_cast<float>(part<Real>(Part::wall_pressure)[i]);
  out.time = time;
  out.moves = of->walls.any();
  out.position.clear(), out.pressure.clear(), out.body.clear();
  for (std::size_t k = 0; k < by_id.size(); ++k) {
    const std::uint8_t body = w.body[k];
    if (of->walls.removed(body, time)) continue;
    out.position.push_back(of->walls.position_at(w.position[k], body, time));
    out.pressure.push_back(by_id[k]), out.body.push_back(body);
  }
}

void Simulation::start_reading(StateTransfer& transfer, Reading what) {
  State& s = *state_;
  const Index n = s.fluid.count;
  s.scratch.resize(n), s.yielded.resize(n);
  s.measure_stress(s.scratch.span());
  launch(s.context, "yielded", n,
         FlagYielded{s.fluids.span(), s.fluid.fluid.span(), s.scratch.span(), s.yielded.span(),
                     s.exact_yield() ? s.viscous.exact_yield().held() : Span<const Real>{}});
  const FluidArrays& f = s.fluid;
  std::vector<SideCopy::Part> parts{all_of(f.position), all_of(f.motion),     all_of(f.state),
                                    all_of(f.pressure), all_of(f.shear_rate), all_of(s.scratch),
                                    all_of(f.id),       all_of(f.fluid),      all_of(s.yielded)};
  StateTransfer::Data& data = *transfer.data_;
  data.what = what, data.time = s.time, data.fluid = static_cast<std::size_t>(n);
  if (what == Reading::fluid_and_walls) {
    parts.push_back(all_of(s.wall.id)), parts.push_back(all_of(s.wall.pressure));
    data.walls = static_cast<std::size_t>(s.wall.id.size());
  }
  data.copy.start(s.side_stream, parts);
  data.of = state_.get();
}

void Simulation::read(FluidSnapshot& fluid) {
  WallSnapshot none;
  start_reading(state_->own_transfer, Reading::fluid);
  state_->context.synchronize();
  state_->own_transfer.finish(fluid, none);
}

void Simulation::read(FluidSnapshot& fluid, WallSnapshot& walls) {
  start_reading(state_->own_transfer, Reading::fluid_and_walls);
  state_->context.synchronize();
  state_->own_transfer.finish(fluid, walls);
}

}  // namespace slagflow
