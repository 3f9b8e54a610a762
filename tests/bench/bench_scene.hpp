// The dam of the discharge, filled, for benchmarks of single parts of a step: the lattice is shaken and
// moves, so that the pairs are those of a flow.
#pragma once

#include <benchmark/benchmark.h>

#include <random>

#include "backend/device.hpp"
#include "fluid/constants.hpp"
#include "host/geometry/setup_builder.hpp"
#include "neighbours/neighbours.hpp"
#include "neighbours/ordering.hpp"
#include "observation/diagnostics.hpp"
#include "pressure/density.hpp"
#include "tests/source_folder.hpp"
#include "viscosity/viscous.hpp"

namespace slagflow::bench {

// Spacings [um] that give the case 12 500, 100 000, 409 600 and 1 562 500 fluid particles, or on a GPU
// 12 500, 100 000, 10^6 and 10^7; parts of a step are timed apart from whole steps at all but the last there.
#if defined(SLAGFLOW_CUDA)
inline constexpr std::int64_t spacings[] = {2000, 1000, 464, 215};
inline constexpr std::int64_t finest_of_parts = 464, most_threads = 1;
#else
inline constexpr std::int64_t spacings[] = {2000, 1000, 625, 400};
inline constexpr std::int64_t finest_of_parts = 400, most_threads = 2;
#endif

// The case at one of them.
inline BuiltCase dam(std::int64_t spacing, const std::vector<std::string>& also = {}) {
  std::vector<std::string> set{"resolution.spacing=" + std::to_string(1e-6 * static_cast<double>(spacing))};
  set.insert(set.end(), also.begin(), also.end());
  return build_setup(load_case(testing_tools::source_file("cases/dam_discharge_2mm.toml"), set));
}

class Scene {
 public:
  explicit Scene(std::int64_t spacing)
      : built(dam(spacing)),
        fluid(context),
        wall(context),
        ordering(context, extent(), setup().domain.periodic,
                 CellGrid::cover(extent(), setup().domain.periodic, fluid_reach())),
        fluid_list(context, "fluid neighbours"),
        wall_list(context, "wall neighbours"),
        wall_to_fluid(context, "fluid neighbours of walls"),
        scratch(context, "scratch"),
        fluids(context, "fluids"),
        departed(setup().fluids.size()) {
    fluids.upload(fluid_constants(setup()));
    upload_fluid();
    upload_walls();
    ordering.sort(wall);
    build_neighbours();
    update_density(context, pairs(), fluid, scratch, 0);
  }

  const SimulationSetup& setup() const { return built.setup; }
  double support() const { return setup().support_ratio * setup().spacing; }
  double fluid_reach() const { return support() * (1 + setup().numerics.skin); }
  double wall_reach() const { return fluid_reach(); }

  // All that a rebuild does.
  void build_neighbours() {
    ordering.sort(fluid, departed);
    const auto reach = static_cast<Real>(fluid_reach()), far = static_cast<Real>(wall_reach());
    const SourceView sources = ordering.fluid_sources(fluid);
    const PeriodicBox open;
    fluid_list.build(sources, fluid.place.span(), open, reach, NeighbourList::Pairs::self);
    wall_list.build(ordering.wall_sources(wall), fluid.place.span(), open, far, NeighbourList::Pairs::other);
    wall_to_fluid.build(sources, wall.place.span(), open, far, NeighbourList::Pairs::other);
  }

  PairContext pairs() const {
    return {fluid_list.view(), wall_list.view(),        view(fluid), view(wall),
            fluids.span(),     flow_constants(setup()), {}};
  }
  RowCells rows() const {
    const SourceView s = ordering.fluid_sources(fluid);
    return {s.grid, s.cell_start};
  }

  BuiltCase built;
  Context context;
  FluidArrays fluid;
  WallArrays wall;
  Ordering ordering;
  NeighbourList fluid_list, wall_list, wall_to_fluid;
  Buffer<Real> scratch;
  Buffer<FluidConstants> fluids;
  DepartureCounts departed;

 private:
  Vec3d extent() const { return setup().domain.upper - setup().domain.lower; }

  void upload_fluid() {
    const auto& p = setup().particles;
    const std::size_t n = p.position.size();
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double shake = 0.15 * setup().spacing;
    const auto constants = fluid_constants(setup());
    std::vector<Vec3d> position(n);
    std::vector<Quad> place(n), motion(n);
    std::vector<Index> id(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3d jitter{uniform(engine), uniform(engine), uniform(engine)};
      position[i] = p.position[i] - setup().domain.lower + shake * jitter;
      place[i] = quad(to_real(position[i]), constants[0].mass / constants[0].rest_density);
      motion[i] = quad({static_cast<Real>(position[i].z), 0, 0}, static_cast<Real>(uniform(engine)));
      id[i] = static_cast<Index>(i);
    }
    fluid.resize(static_cast<Index>(n));
    fluid.position.upload(position), fluid.place.upload(place), fluid.motion.upload(motion);
    fluid.id.upload(id), fluid.fluid.upload(p.fluid);
    fluid.packing.upload(std::vector<Real>(n, Real(1))), fluid.hollow.upload(std::vector<Real>(n));
    fluid.last_increment.upload(std::vector<Quad>(n)), fluid.by_pressure.upload(std::vector<Quad>(n));
    fluid.increment.upload(std::vector<Quad>(n)), fluid.state.upload(std::vector<Quad>(n));
    fluid.pressure.upload(std::vector<Real>(n)), fluid.shear_rate.upload(std::vector<Real>(n));
  }

  void upload_walls() {
    const auto& w = setup().walls;
    const std::size_t n = w.position.size();
    std::vector<Quad> place(n), normal(n), velocity(n, Quad{0, 0, 0, 1});
    std::vector<Index> id(n);
    for (std::size_t i = 0; i < n; ++i) {
      place[i] = quad(to_real(w.position[i] - setup().domain.lower), 0);
      normal[i] = quad(to_real(w.normal[i]), static_cast<Real>(w.depth[i]));
      id[i] = static_cast<Index>(i);
    }
    wall.resize(static_cast<Index>(n));
    wall.place.upload(place), wall.normal.upload(normal), wall.velocity.upload(velocity), wall.id.upload(id);
    wall.back.upload(std::vector<Quad>(n)), wall.pressure.upload(std::vector<Real>(n));
  }
};

// Sizes and threads of every benchmark. range(0): spacing [um], range(1): threads.
inline void add_sizes(benchmark::internal::Benchmark* b, std::int64_t finest) {
  b->ArgNames({"spacing_um", "threads"})->Unit(benchmark::kMillisecond);
  for (const std::int64_t spacing : spacings)
    for (std::int64_t threads = 1; threads <= most_threads && spacing >= finest; ++threads)
      b->Args({spacing, threads});
}
inline void sizes_of_parts(benchmark::internal::Benchmark* b) {
  add_sizes(b, finest_of_parts), b->UseRealTime();
}
inline void all_sizes(benchmark::internal::Benchmark* b) { add_sizes(b, 0), b->UseRealTime(); }

// Bytes per second that the given number of threads reads and writes in a copy of memory; measured once.
double copy_bandwidth(int threads);

// What one fluid particle costs in one run of a benchmark; bytes as if each array came once from memory.
struct Work {
  double bytes = 0, flops = 0;
};

// The figures of a benchmark that handled all particles `rounds` times in `seconds`.
inline void report(benchmark::State& state, double particles, Work work, double rounds, double seconds) {
  state.counters["particles"] = particles;
  state.counters["particle_steps_per_s"] = particles * rounds / seconds;
  if (work.bytes > 0) {
    state.counters["bytes_per_particle"] = work.bytes;
    state.counters["flops_per_particle"] = work.flops;
    const double rate = particles * rounds * work.bytes / seconds;
    state.counters["of_copy_bandwidth"] = rate / copy_bandwidth(static_cast<int>(state.range(1)));
  }
}

}  // namespace slagflow::bench
