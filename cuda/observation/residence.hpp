// How long fluid stays: the ages of the particles that come to outlets.
#pragma once

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// Ids rise with the time at which particles come in, so a row for each time at which some did tells the age
// of any: nothing is carried along. Times are those at which the neighbour lists were built.
class Residence {
 public:
  explicit Residence(Context&);

  void start(const SimulationSetup&);
  bool any() const { return !outlets_.empty(); }

  // From this id on particles have come in now.
  void enter(Index first_id, double now);
  // Before particles are dropped: notes the ages of those in outlets.
  void leave(const FluidArrays&, Span<const OutletBox>, double now, DiagnosticScratch&);
  void states(const FluidArrays&, double now, GatheredSums&, std::vector<ResidenceState>&);

  template <class Visitor>
  void save(Visitor& v) {
    if (!any()) return;
    v.values("entry_id", first_), v.values("entry_time", time_);
    v.values("ages", age_), v.values("age_outlets", left_by_);
  }

 private:
  Context& context_;
  std::vector<std::size_t> outlets_;
  std::vector<Index> first_;           // ascending
  std::vector<double> time_;           // [s] of those
  std::vector<float> age_;             // [s] of all that have left
  std::vector<std::uint8_t> left_by_;  // index of the outlet
  Buffer<Index> first_on_device_;
  Buffer<double> time_on_device_;
  Buffer<Offset> leaving_, rank_;
  Buffer<Index> id_;
  Buffer<std::uint8_t> outlet_;
};

}  // namespace slagflow
