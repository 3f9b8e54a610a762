// Counts the particles that go through rectangles, each way.
#pragma once

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/setup.hpp"
#include "neighbours/ordering.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// A particle goes from where it was when the neighbour lists were built to where it is at the next time, or
// now: a step costs nothing. What goes and comes back in between does not count.
class FluxCounters {
 public:
  // Positions on the device are relative to setup.domain.lower.
  explicit FluxCounters(const SimulationSetup&);

  // Before particles are sorted and dropped. `before`: their places at the last rebuild.
  void advance(Context&, const FluidArrays&, Span<const Quad> before, DiagnosticScratch&);
  // Now, between two rebuilds.
  std::vector<FluxState> states(Context&, const FluidArrays&, Span<const Quad> before,
                                DiagnosticScratch&) const;

  template <class Visitor>
  void save(Visitor& v) {
    if (!counts_.empty()) v.as_many("rectangles", counts_);
  }

 private:
  std::vector<RectangleSetup> rectangles_;  // relative to the domain
  PeriodicBox box_;
  std::size_t fluids_;
  std::vector<std::int64_t> counts_;  // by rectangle, by fluid: forward, backward
};

}  // namespace slagflow
