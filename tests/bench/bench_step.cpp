// Whole steps of the discharge, and snapshots.
#include <chrono>
#include <map>

#include "bench_scene.hpp"
#include "simulation/simulation.hpp"

namespace slagflow::bench {
namespace {

// Milliseconds a step of each part that is timed, over some steps.
void report_parts(benchmark::State& state, SimulationSetup setup) {
  constexpr int warm = 10, steps = 20;
  setup.time_parts = true;
  Simulation simulation(setup);
  for (int k = 0; k < warm; ++k) simulation.step();
  const std::map<std::string, double> before = simulation.timings();
  for (int k = 0; k < steps; ++k) simulation.step();
  for (const auto& [part, seconds] : simulation.timings()) {
    const auto found = before.find(part);
    const double earlier = found == before.end() ? 0 : found->second;
    state.counters["ms " + part] = 1e3 * (seconds - earlier) / steps;
  }
}

// Steps after the first 50, which are stiff and start cold.
void time_steps(benchmark::State& state, const SimulationSetup& setup) {
  Simulation simulation(setup);
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

void step(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const BuiltCase built = dam(state.range(0));
  time_steps(state, built.setup);
  report_parts(state, built.setup);
}
BENCHMARK(step)->Apply(all_sizes);

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
BENCHMARK(snapshot)->Apply(sizes_of_parts);

}  // namespace
}  // namespace slagflow::bench

BENCHMARK_MAIN();
