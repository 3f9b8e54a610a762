// Whole steps of the discharge: fluid particles x steps per second, against copying memory in the same run.
#include <benchmark/benchmark.h>

#include <cstring>

#include "host/setup_builder.hpp"
#include "simulation.hpp"

namespace slagflow {
namespace {

// Bytes per second that one thread copies: what a pass over the pairs can hope for.
void copy(benchmark::State& state) {
  const auto bytes = static_cast<std::size_t>(state.range(0));
  std::vector<char> from(bytes, 1), to(bytes);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(2 * static_cast<std::int64_t>(state.iterations()) * state.range(0));
}
BENCHMARK(copy)->Arg(256 << 20)->Unit(benchmark::kMillisecond);

// Steps after the first 50, which are stiff and start cold. range: spacing [um].
void step(benchmark::State& state, const char* case_file) {
  const std::string spacing =
      "resolution.spacing=" + std::to_string(1e-6 * static_cast<double>(state.range(0)));
  const BuiltCase built =
      build_setup(load_case(std::string(SLAGFLOW_SOURCE_DIR "/cases/") + case_file, {spacing}));
  Simulation simulation(built.setup);
  const auto particles = static_cast<double>(built.setup.particles.position.size());
  for (int warm = 0; warm < 50; ++warm) simulation.step();
  const SolverTotals before = simulation.solver_totals();
  for (auto _ : state) simulation.step();
  const SolverTotals after = simulation.solver_totals();
  state.counters["particles"] = particles;
  state.counters["particle_steps_per_s"] =
      benchmark::Counter(particles * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["iterations"] = static_cast<double>(after.iterations - before.iterations) /
                                 static_cast<double>(after.steps - before.steps);
  state.counters["bytes_per_particle"] = static_cast<double>(simulation.device_bytes()) / particles;
}
BENCHMARK_CAPTURE(step, bingham, "dam_discharge_2mm.toml")
    ->Arg(2000)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(step, oil, "oil_a.toml")->Arg(2000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace slagflow

BENCHMARK_MAIN();
