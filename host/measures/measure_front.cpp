#include "host/measures/measure_front.hpp"

#include <algorithm>
#include <cmath>

#include "host/measures/measure_text.hpp"

namespace slagflow {
namespace {

// Linear between neighbouring values, as is usual; of at least one value.
double percentile(std::vector<double> values, double fraction) {
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

// The classes of a jet by number, 0 being unknown.
constexpr std::array<const char*, 3> flow_classes{"", "wall-flow", "free-jet"};

}  // namespace

bool ArrivalClock::update(double time, double passed) {
  const bool now = !arrival_ && passed >= fraction_;
  if (now) {
    const double rise = passed - last_passed_;
    arrival_ =
        begun_ && rise > 0 ? last_time_ + (fraction_ - last_passed_) / rise * (time - last_time_) : time;
  }
  last_time_ = time;
  last_passed_ = passed;
  begun_ = true;
  return now;
}

ArrivalClock::State ArrivalClock::state() const {
  return {arrival_.value_or(std::numeric_limits<double>::quiet_NaN()), last_time_, last_passed_,
          begun_ ? 1.0 : 0.0};
}

void ArrivalClock::restore(const State& state) {
  arrival_.reset();
  if (!std::isnan(state[0])) arrival_ = state[0];
  last_time_ = state[1];
  last_passed_ = state[2];
  begun_ = state[3] > 0;
}

double JetGeometry::drop() const { return front.sign * (front.position - lip[front.axis]); }

double JetGeometry::outward_of(Vec3d position) const {
  return outward.sign * (position[outward.axis] - lip[outward.axis]);
}

double JetGeometry::fallen(Vec3d position) const {
  return front.sign * (position[front.axis] - lip[front.axis]);
}

JetShape measure_jet(const JetGeometry& jet, const std::vector<Vec3d>& positions) {
  const double drop = jet.drop();
  double sum = 0;
  std::vector<double> inner, beyond;
  for (const Vec3d& p : positions) {
    const double fallen = jet.fallen(p);
    if (fallen > drop) {
      sum += jet.outward_of(p);
      beyond.push_back(jet.outward_of(p));
    }
    if (std::abs(fallen - 2 * drop / 3) <= jet.spacing) inner.push_back(jet.outward_of(p));
  }
  JetShape shape;
  if (!beyond.empty()) shape.tan_theta = sum / static_cast<double>(beyond.size()) / drop;
  if (inner.empty()) inner = std::move(beyond);  // a sheet with a gap, a lump that tore off
  if (inner.empty()) return shape;
  shape.inner_offset = percentile(std::move(inner), 0.02);
  shape.flow_class = flow_classes[shape.inner_offset <= 2 * jet.spacing ? 1 : 2];
  return shape;
}

FrontMeasure::FrontMeasure(const MeasureSpec& spec, const FrontSetup& front, std::size_t index,
                           double particles)
    : Measure(spec.name),
      front_(front),
      index_(index),
      particles_(particles),
      fraction_(spec.fraction),
      clock_(spec.fraction) {}

std::vector<double> FrontMeasure::update(const MeasureMoment& moment) {
  const FrontState& state = moment.totals.fronts.at(index_);
  if (moment.totals.particles > 0) leading_ = state.extreme;
  passed_ = static_cast<double>(state.passed) / particles_;
  if (clock_.update(moment.time, passed_)) arrive(moment);
  return {leading_, passed_};
}

std::vector<double> FrontMeasure::state() const {
  const ArrivalClock::State clock = clock_.state();
  std::vector<double> state(clock.begin(), clock.end());
  state.insert(state.end(), {leading_, passed_});
  return state;
}

void FrontMeasure::restore(const double* state) {
  ArrivalClock::State clock{};
  std::copy_n(state, clock.size(), clock.begin());
  clock_.restore(clock);
  leading_ = state[clock.size()];
  passed_ = state[clock.size() + 1];
}

Json FrontMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("direction", direction_name(front_));
  result.set("position", front_.position).set("fraction", fraction_);
  const auto arrival = clock_.arrival();
  result.set("travelling_time", arrival ? Json(*arrival) : Json());
  return result.set("front_position", leading_).set("passed_fraction", passed_);
}

std::string FrontMeasure::line() const {
  if (const auto arrival = clock_.arrival()) return "arrived after " + format("%.4g s", *arrival);
  return "not arrived, front at " + format("%.4g m", leading_) + ", passed " +
         format("%.3g %%", 100 * passed_);
}

JetMeasure::JetMeasure(const MeasureSpec& spec, const FrontSetup& front, std::size_t index, double particles,
                       double spacing)
    : FrontMeasure(spec, front, index, particles), jet_{spec.lip, spec.outward, front, spacing} {}

void JetMeasure::arrive(const MeasureMoment& moment) { shape_ = measure_jet(jet_, moment.read().position); }

std::vector<double> JetMeasure::state() const {
  std::vector<double> state = FrontMeasure::state();
  const auto found = std::find(flow_classes.begin(), flow_classes.end(), shape_.flow_class);
  state.insert(state.end(),
               {shape_.tan_theta, shape_.inner_offset, static_cast<double>(found - flow_classes.begin())});
  return state;
}

void JetMeasure::restore(const double* state) {
  FrontMeasure::restore(state);
  const double* const shape = state + numbers;
  const double flow_class = shape[2] > 0 && shape[2] < flow_classes.size() ? shape[2] : 0;
  shape_ = {shape[0], shape[1], flow_classes[static_cast<std::size_t>(flow_class)]};
}

Json JetMeasure::summary() const {
  Json result = FrontMeasure::summary();
  result.set("outward", direction_name(jet_.outward)).set("drop", jet_.drop());
  result.set("tan_theta", shape_.tan_theta).set("inner_offset", shape_.inner_offset);
  return result.set("class", shape_.flow_class.empty() ? Json() : Json(shape_.flow_class));
}

std::string JetMeasure::line() const {
  if (shape_.flow_class.empty()) return FrontMeasure::line();
  return FrontMeasure::line() + ", " + shape_.flow_class + ", tan theta " + format("%.3g", shape_.tan_theta);
}

}  // namespace slagflow
