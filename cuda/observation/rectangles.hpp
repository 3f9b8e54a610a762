// Counts the particles that go through rectangles, each way.
#pragma once

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/setup.hpp"
#include "neighbours/ordering.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// A particle goes from where it was at the last count to where it is at the next, or now. What goes and comes
// back in between does not count, and what goes round an edge must not be taken for what goes through.
class FluxCounters {
 public:
  // Positions on the device are relative to setup.domain.lower.
  FluxCounters(Context&, const SimulationSetup&);
  bool any() const { return !rectangles_.empty(); }

  // Particles have been sorted: from here on they go.
  void start(const FluidArrays&);
  // Before particles are sorted and dropped.
  void count(Context&, const FluidArrays&, DiagnosticScratch&);
  // After a step in which no particle went farther than `way` [m]: counts when they may have gone `most`.
  void follow(Context&, const FluidArrays&, double way, double most, DiagnosticScratch&);
  void states(const FluidArrays&, GatheredSums&, std::vector<FluxState>&) const;

  template <class Visitor>
  void save(Visitor& v) {
    if (!any()) return;
    v.as_many("rectangles", counts_), v.number(way_), v.of_fluid("rectangles_before", before_);
  }

 private:
  std::vector<RectangleSetup> rectangles_;  // relative to the domain
  PeriodicBox box_;
  std::size_t fluids_;
  std::vector<std::int64_t> counts_;  // by rectangle, by fluid: forward, backward
  Buffer<Quad> before_;               // places at the last count
  double way_ = 0;                    // [m] since then, of any particle at most
};

}  // namespace slagflow
