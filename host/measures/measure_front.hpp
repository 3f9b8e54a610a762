// The measures `front` and `jet`.
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
//                  (the side of the flow that faces the wall; linear between neighbouring values), or where
//                  there are none, of the particles beyond `bottom`
//   class        = "wall-flow" if inner_offset <= 2 spacings, else "free-jet"
#pragma once

#include <array>
#include <optional>

#include "host/measures/measures.hpp"

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
  double tan_theta = unknown;
  double inner_offset = unknown;  // [m]
  std::string flow_class;         // empty if neither is known
};

JetShape measure_jet(const JetGeometry& jet, const std::vector<Vec3d>& positions);

class FrontMeasure : public Measure {
 public:
  // `front`: Totals::fronts[index]; `particles`: fluid ones at the start.
  FrontMeasure(const MeasureSpec& spec, const FrontSetup& front, std::size_t index, double particles);

  std::vector<std::string> columns() const override { return {"front_m", "passed"}; }
  std::vector<double> update(const MeasureMoment&) override;
  std::vector<double> state() const override;
  void restore(const double* state) override;
  bool arrived() const override { return clock_.arrival().has_value(); }
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "front"; }

 protected:
  const FrontSetup& front() const { return front_; }
  static constexpr std::size_t numbers = std::tuple_size_v<ArrivalClock::State> + 2;

 private:
  virtual void arrive(const MeasureMoment&) {}

  FrontSetup front_;
  std::size_t index_;
  double particles_, fraction_;
  ArrivalClock clock_;
  double leading_ = unknown, passed_ = 0;
};

class JetMeasure : public FrontMeasure {
 public:
  JetMeasure(const MeasureSpec& spec, const FrontSetup& front, std::size_t index, double particles,
             double spacing);

  std::vector<double> state() const override;
  void restore(const double* state) override;
  Json summary() const override;
  std::string line() const override;
  const char* type() const override { return "jet"; }

 private:
  void arrive(const MeasureMoment& moment) override;

  JetGeometry jet_;
  JetShape shape_;
};

}  // namespace slagflow
