// Whole steps of the discharge, and snapshots.
#include <chrono>

#include "bench_scene.hpp"
#include "simulation/simulation.hpp"

namespace slagflow::bench {
namespace {

// Steps after the first 50, which are stiff and start cold.
void step(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const BuiltCase built = dam(state.range(0));
  Simulation simulation(built.setup);
  for (int warm = 0; warm < 50; ++warm) simulation.step();
  const auto particles = static_cast<double>(simulation.totals().particles);
  const SolverTotals before = simulation.solver_totals();
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) simulation.step();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const SolverTotals after = simulation.solver_totals();
  report(state, particles, {}, static_cast<double>(state.iterations()), seconds);
  state.counters["iterations"] = static_cast<double>(after.iterations - before.iterations) /
                                 static_cast<double>(after.steps - before.steps);
  state.counters["device_bytes_per_particle"] = static_cast<double>(simulation.device_bytes()) / particles;
}
BENCHMARK(step)->Apply(sizes);

// Copying the state to the host, in the order of ids.
void snapshot(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const BuiltCase built = dam(state.range(0));
  Simulation simulation(built.setup);
  FluidSnapshot out;
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) simulation.read(out);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report(state, static_cast<double>(out.id.size()), {}, static_cast<double>(state.iterations()), seconds);
}
BENCHMARK(snapshot)->Apply(sizes);

}  // namespace
}  // namespace slagflow::bench

BENCHMARK_MAIN();
