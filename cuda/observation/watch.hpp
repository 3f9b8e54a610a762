// Looks at the state every few steps and ends a run that cannot be true any more.
#pragma once

#include "fluid/setup.hpp"
#include "observation/diagnostics.hpp"

namespace slagflow {

struct WatchMoment {
  double time, time_step;  // [s]
  // [J] dissipated; done by moving walls and surface tension; given by pairing and the pressure of walls,
  // which the elastic energy knows nothing of, and of that in the last step
  double dissipated, work, given, just_given;
  std::int64_t step, departed, fed;
  double fed_mass;  // [kg]
};

class Watch {
 public:
  // The setup must outlive the watch; its particles are needed here alone.
  Watch(Context&, const SimulationSetup& setup);

  // Remembers the energy of the start.
  void begin(const FluidArrays&, Span<const FluidConstants>, DiagnosticScratch&);

  // Throws Error that names the limit, its value, the particle concerned with its state, and what to try.
  void look(const FluidArrays&, const Vitals&, const WatchMoment&);

  // What it remembers from look to look [J]; kept in checkpoints.
  struct Seen {
    double lowest_energy = 1e300;  // the total less what was given
    double given = 0;
    double recent_energy = 0;  // highest total, what was given included, that is half forgotten in five looks
  } seen;
  template <class Visitor>
  void save(Visitor& v) {
    v.number(seen.lowest_energy), v.number(seen.given), v.number(seen.recent_energy);
  }

 private:
  void check_energy(const Vitals&, const WatchMoment&);
  void check_dissipated(const WatchMoment&, double scale) const;
  void check_given(const Vitals&, const WatchMoment&, double scale);
  [[noreturn]] void fail(const WatchMoment&, const std::string& what, const std::string& advice) const;
  [[noreturn]] void fail_at_worst(const FluidArrays&, const WatchMoment&, const std::string& what,
                                  double (*badness)(Quad motion), const std::string& advice) const;

  Context& context_;
  const SimulationSetup& setup_;
  double particles_, mass_, max_speed_;
};

}  // namespace slagflow
