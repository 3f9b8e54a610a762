// Looks at the state every few steps and ends a run that cannot be true any more.
#pragma once

#include "diagnostics.hpp"
#include "setup.hpp"

namespace slagflow {

struct WatchMoment {
  double time, time_step, dissipated, work;  // work: done by moving walls and surface tension [J]
  std::int64_t step, departed;
};

class Watch {
 public:
  // The setup must outlive the watch; its particles are needed here alone.
  Watch(Context&, const SimulationSetup& setup);

  // Remembers the energy of the start.
  void begin(const FluidArrays&, Span<const FluidConstants>, DiagnosticScratch&);

  // Throws Error that names the limit, its value, the particle concerned with its state, and what to try.
  void look(const FluidArrays&, Span<const FluidConstants>, const WatchMoment&, DiagnosticScratch&);

  // Lowest total energy seen so far [J]; kept in checkpoints.
  double lowest_energy = 1e300;

 private:
  void check_energy(const Vitals&, const WatchMoment&);
  [[noreturn]] void fail(const WatchMoment&, const std::string& what, const std::string& advice) const;
  [[noreturn]] void fail_at_worst(const FluidArrays&, const WatchMoment&, const std::string& what,
                                  double (*badness)(Quad motion), const std::string& advice) const;

  Context& context_;
  const SimulationSetup& setup_;
  double particles_, mass_, max_speed_;
};

}  // namespace slagflow
