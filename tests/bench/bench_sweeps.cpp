// The neighbour lists and the sweeps over the pairs.
#include <chrono>

#include "bench_scene.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow::bench {
namespace {

constexpr double quad_bytes = sizeof(Quad), real_bytes = sizeof(Real);
constexpr double row_bytes = sizeof(Offset) + sizeof(Index);

// Pairs per fluid particle, walls included.
struct PairCounts {
  double listed, within;
  explicit PairCounts(Scene& s) {
    DiagnosticScratch scratch(s.context);
    const auto n = static_cast<double>(s.fluid.count);
    listed = static_cast<double>(s.fluid_list.capacity() + s.wall_list.capacity()) / n;
    within = mean_neighbours(s.context, s.pairs(), scratch);
  }
};

// Times `part` round by round.
template <class Part>
void measure(benchmark::State& state, Scene& scene, Work work, Part part) {
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) {
    part();
    scene.context.synchronize();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report(state, scene.fluid.count, work, static_cast<double>(state.iterations()), seconds);
}

void neighbours(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  Scene scene(state.range(0));
  const PairCounts pairs(scene);
  // 27 cells of one reach; a test of a distance has 8 operations.
  const double candidates = 27 * std::pow(scene.fluid_reach() / scene.setup().spacing, 3);
  const Work work{11 * quad_bytes + 4 * pairs.listed, 8 * candidates};
  measure(state, scene, work, [&] { scene.build_neighbours(); });
}
BENCHMARK(neighbours)->Apply(sizes_of_parts);

void density(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  Scene scene(state.range(0));
  const PairCounts pairs(scene);
  const Work work{4 * pairs.listed + 2 * row_bytes + 8 * quad_bytes + 7 * real_bytes,
                  8 * pairs.listed + 33 * pairs.within};
  measure(state, scene, work,
          [&] { update_density(scene.context, scene.pairs(), scene.fluid, scene.scratch, 0); });
}
BENCHMARK(density)->Apply(sizes_of_parts);

void wall_pressure(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  Scene scene(state.range(0));
  measure(state, scene, {}, [&] {
    extrapolate_wall_pressure(scene.context, scene.pairs(), scene.wall_to_fluid.view(), scene.wall);
  });
}
BENCHMARK(wall_pressure)->Apply(sizes_of_parts);

// Predictor, assembly and `iterations` iterations of a solver that never converges. The time of one part of
// it, by its label, is what counts.
void viscous(benchmark::State& state, ViscousSolver solver, const char* part) {
  constexpr int iterations = 10;
  set_threads(static_cast<int>(state.range(1)));
  Scene scene(state.range(0));
  NumericsSetup numerics = scene.setup().numerics;
  numerics.solver = solver, numerics.max_iterations = iterations, numerics.tolerance = 1e-30;
  ViscousStep step(scene.context, numerics);
  const double dt = stable_time_step(scene.setup());
  const bool solves = std::string(part) == "viscous solve";
  double seconds = 0, rounds = 0;
  const std::vector<Quad> no_increment(static_cast<std::size_t>(scene.fluid.count));
  for (auto _ : state) {
    scene.fluid.increment.upload(no_increment);  // a cold start
    const double before = scene.context.timings()[part];
    const SolveResult result =
        step.advance(scene.pairs(), scene.rows(), {dt, 9.81 * dt, particle_mass(scene.setup(), 0)},
                     scene.fluid_list.capacity(), scene.fluid);
    const double took = scene.context.timings()[part] - before, times = solves ? result.iterations : 1;
    state.SetIterationTime(took / times);
    seconds += took, rounds += times;
  }
  const PairCounts pairs(scene);
  Work work{4 * pairs.listed + 2 * row_bytes + 9 * quad_bytes + (4 + real_bytes) * pairs.within,
            8 * pairs.listed + 34 * pairs.within};
  if (solves)
    work = {(4 + real_bytes) * pairs.within + 2 * row_bytes + 12 * quad_bytes, 17 * pairs.within + 60};
  report(state, scene.fluid.count, work, rounds, seconds);
}
void manual_sizes(benchmark::internal::Benchmark* b) { add_sizes(b, finest_of_parts), b->UseManualTime(); }
BENCHMARK_CAPTURE(viscous, assembly, ViscousSolver::conjugate_gradient, "predictor and assembly")
    ->Apply(manual_sizes);
BENCHMARK_CAPTURE(viscous, conjugate_gradient, ViscousSolver::conjugate_gradient, "viscous solve")
    ->Apply(manual_sizes);
BENCHMARK_CAPTURE(viscous, jacobi, ViscousSolver::jacobi, "viscous solve")->Apply(manual_sizes);
BENCHMARK_CAPTURE(viscous, sor, ViscousSolver::sor, "viscous solve")->Apply(manual_sizes);

}  // namespace
}  // namespace slagflow::bench
