// Looks at the state every few steps and ends a run that cannot be true any more.
#pragma once

#include "diagnostics.hpp"
#include "setup.hpp"

namespace slagflow {

struct WatchMoment {
  double time, time_step, dissipated;
  std::int64_t step, departed;
};

class Watch {
 public:
  Watch(Context&, const SimulationSetup&, std::int64_t particles);

  // Throws Error that names the limit, its value, the particle concerned with its state, and what to try.
  void look(const FluidArrays&, Span<const FluidConstants>, const WatchMoment&, DiagnosticScratch&);

  // Lowest total energy seen since the last departure [J]; kept in checkpoints.
  struct Memory {
    double lowest_energy;
    std::int64_t departed;
  };
  Memory memory{1e300, 0};

 private:
  void check_energy(const Vitals&, const WatchMoment&);
  [[noreturn]] void fail(const WatchMoment&, const std::string& what, const std::string& advice) const;
  [[noreturn]] void fail_at_worst(const FluidArrays&, const WatchMoment&, const std::string& what,
                                  double (*badness)(Quad motion), const std::string& advice) const;

  Context& context_;
  SimulationSetup setup_;
  double particles_, mass_;
};

}  // namespace slagflow
