// What is measured of the fluid during a run.
//
// Travelling time. A front has arrived at its line when the fraction f of all fluid particles of the start is
// beyond the line (those that left through the face beyond it included). Between two lines of the history the
// passed fraction is taken as linear in time; the travelling time is when it equals f. If it is reached at
// the first line already, the travelling time is the time of that line.
//
// Jet. The line is the level `bottom`; D is the drop from the lip to it along the front's axis. At the first
// line of the history at or after the arrival, o being the coordinate along `outward` from the lip:
//   tan_theta    = mean o of the particles in the domain beyond `bottom` / D
//   inner_offset = 2nd percentile of o of the particles within one spacing of the level 2 D / 3 below the lip
//                  (the side of the flow that faces the wall; linear between neighbouring values)
//   class        = "wall-flow" if inner_offset <= 2 spacings, else "free-jet"; without particles at that
//   level
//                  tan_theta D takes the place of inner_offset.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/case.hpp"
#include "host/summary_json.hpp"
#include "simulation.hpp"

namespace slagflow {

// Finds when the passed fraction reaches a limit.
class ArrivalClock {
 public:
  explicit ArrivalClock(double fraction) : fraction_(fraction) {}

  // Takes the fraction at a time [s]; times come in ascending order.
  // Returns true at the first time at or after the arrival, once.
  bool update(double time, double passed);
  std::optional<double> arrival() const { return arrival_; }  // [s]

  // What it has seen so far, and back: a clock of the same fraction goes on as this one would.
  using State = std::array<double, 4>;
  State state() const;
  void restore(const State& state);

 private:
  double fraction_;
  std::optional<double> arrival_;
  double last_time_ = 0, last_passed_ = 0;
  bool begun_ = false;
};

struct JetGeometry {
  Vec3d lip;           // [m]
  Direction outward;   // away from the wall
  FrontSetup front;    // the level that the jet arrives at, beyond the lip
  double spacing = 0;  // [m]

  double drop() const;                      // [m] from the lip to the level
  double outward_of(Vec3d position) const;  // [m] from the lip
  double fallen(Vec3d position) const;      // [m] from the lip towards the level
};

struct JetShape {
  double tan_theta = std::numeric_limits<double>::quiet_NaN();     // of no particles: not-a-number
  double inner_offset = std::numeric_limits<double>::quiet_NaN();  // [m]
  std::string flow_class;                                          // empty if neither is known
};

JetShape measure_jet(const JetGeometry& jet, const std::vector<Vec3d>& positions);

// All measures of a case.
class Measures {
 public:
  // `fronts`: those of the setup, one for each measure of the case; `particles`: fluid ones at the start.
  Measures(const Case& c, const std::vector<FrontSetup>& fronts, std::int64_t particles);

  // NAME_front_m and NAME_passed (fraction) for each measure.
  std::vector<std::string> columns() const;

  // The values of the columns now. Reads a snapshot only where a measure needs one.
  using ReadSnapshot = std::function<const FluidSnapshot&()>;
  std::vector<double> update(double time, const Totals& totals, const ReadSnapshot& read);

  // What they have seen so far, and back: measures of the same case go on as these would.
  // Throws Error when the state is one of other measures.
  std::vector<double> state() const;
  void restore(const std::vector<double>& state);

  // Name of each measure -> {type, ...}.
  Json summary() const;
  // For people: a line for each measure.
  std::vector<std::string> lines() const;

 private:
  struct Measure {
    MeasureSpec spec;
    FrontSetup front;
    ArrivalClock clock;
    JetShape shape;
    double leading = std::numeric_limits<double>::quiet_NaN();
    double passed = 0;
  };
  JetGeometry jet_of(const Measure& m) const;
  Json summary_of(const Measure& m) const;

  double particles_, spacing_;
  std::vector<Measure> measures_;
};

}  // namespace slagflow
