// What the machine's memory gives: the measure for everything else.
#include <algorithm>
#include <chrono>
#include <map>

#include "bench_scene.hpp"

namespace slagflow::bench {
namespace {

// Copies 256 MiB, which no cache holds.
class Copy {
 public:
  Copy() : from_(context_, "from"), to_(context_, "to", length) {
    from_.upload(std::vector<char>(static_cast<std::size_t>(length), 1));
    run();  // touches the memory
  }
  void run() {
    to_.copy_from(from_);
    context_.synchronize();
  }
  static constexpr Offset length = Offset(256) << 20;
  static constexpr double bytes = 2.0 * static_cast<double>(length);  // read and written

 private:
  Context context_;
  Buffer<char> from_, to_;
};

void copy(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  Copy copy;
  for (auto _ : state) copy.run();
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(Copy::bytes));
}
BENCHMARK(copy)
    ->ArgNames({"none", "threads"})
    ->Args({0, 1})
    ->Args({0, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

double measure(int threads) {
  set_threads(threads);
  Copy copy;
  double best = 1e300;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    copy.run();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return Copy::bytes / best;
}

}  // namespace

double copy_bandwidth(int threads) {
  static std::map<int, double> measured;
  if (!measured.count(threads)) measured[threads] = measure(threads);
  return measured[threads];
}

}  // namespace slagflow::bench
