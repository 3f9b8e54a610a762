#include "host/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "backend/error.hpp"

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

std::string format(const char* pattern, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string name_of(int axis, int sign) { return std::string(sign > 0 ? "+" : "-") + "xyz"[axis]; }

// The classes of a jet by number, 0 being unknown.
constexpr std::array<const char*, 3> flow_classes{"", "wall-flow", "free-jet"};
constexpr std::size_t numbers_of_measure = std::tuple_size_v<ArrivalClock::State> + 5;

const char* type_name(MeasureType type) { return type == MeasureType::jet ? "jet" : "front"; }

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

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
  double sum = 0, count = 0;
  std::vector<double> inner;
  for (const Vec3d& p : positions) {
    const double fallen = jet.fallen(p);
    if (fallen > drop) {
      sum += jet.outward_of(p);
      ++count;
    }
    if (std::abs(fallen - 2 * drop / 3) <= jet.spacing) inner.push_back(jet.outward_of(p));
  }
  JetShape shape;
  if (count > 0) shape.tan_theta = sum / count / drop;
  if (!inner.empty()) shape.inner_offset = percentile(std::move(inner), 0.02);
  const double offset = std::isnan(shape.inner_offset) ? shape.tan_theta * drop : shape.inner_offset;
  if (!std::isnan(offset)) shape.flow_class = flow_classes[offset <= 2 * jet.spacing ? 1 : 2];
  return shape;
}

Measures::Measures(const Case& c, const std::vector<FrontSetup>& fronts, std::int64_t particles)
    : particles_(static_cast<double>(std::max<std::int64_t>(particles, 1))), spacing_(c.spacing) {
  for (std::size_t k = 0; k < c.measures.size(); ++k)
    measures_.push_back({c.measures[k], fronts.at(k), ArrivalClock(c.measures[k].fraction), {}});
}

std::vector<std::string> Measures::columns() const {
  std::vector<std::string> names;
  for (const Measure& m : measures_) {
    names.push_back(m.spec.name + "_front_m");
    names.push_back(m.spec.name + "_passed");
  }
  return names;
}

std::vector<double> Measures::update(double time, const Totals& totals, const ReadSnapshot& read) {
  std::vector<double> values;
  for (std::size_t k = 0; k < measures_.size(); ++k) {
    Measure& m = measures_[k];
    const FrontState& state = totals.fronts.at(k);
    if (totals.particles > 0) m.leading = state.extreme;
    m.passed = static_cast<double>(state.passed) / particles_;
    const bool arrived = m.clock.update(time, m.passed);
    if (arrived && m.spec.type == MeasureType::jet) m.shape = measure_jet(jet_of(m), read().position);
    values.insert(values.end(), {m.leading, m.passed});
  }
  return values;
}

std::vector<double> Measures::state() const {
  std::vector<double> state;
  for (const Measure& m : measures_) {
    const ArrivalClock::State clock = m.clock.state();
    state.insert(state.end(), clock.begin(), clock.end());
    const auto found = std::find(flow_classes.begin(), flow_classes.end(), m.shape.flow_class);
    state.insert(state.end(), {m.shape.tan_theta, m.shape.inner_offset,
                               static_cast<double>(found - flow_classes.begin()), m.leading, m.passed});
  }
  return state;
}

void Measures::restore(const std::vector<double>& state) {
  if (state.size() != numbers_of_measure * measures_.size())
    throw Error("checkpoint: " + std::to_string(state.size()) + " numbers for " +
                std::to_string(measures_.size()) + " measures");
  const double* next = state.data();
  for (Measure& m : measures_) {
    ArrivalClock::State clock{};
    std::copy_n(next, clock.size(), clock.begin());
    m.clock.restore(clock);
    next += clock.size();
    const double flow_class = next[2] > 0 && next[2] < flow_classes.size() ? next[2] : 0;
    m.shape = {next[0], next[1], flow_classes[static_cast<std::size_t>(flow_class)]};
    m.leading = next[3];
    m.passed = next[4];
    next += numbers_of_measure - clock.size();
  }
}

JetGeometry Measures::jet_of(const Measure& m) const {
  return {m.spec.lip, m.spec.outward, m.front, spacing_};
}

Json Measures::summary_of(const Measure& m) const {
  Json result = Json::object();
  result.set("type", type_name(m.spec.type)).set("direction", name_of(m.front.axis, m.front.sign));
  result.set("position", m.front.position).set("fraction", m.spec.fraction);
  result.set("travelling_time", or_null(m.clock.arrival()));
  result.set("front_position", m.leading).set("passed_fraction", m.passed);
  if (m.spec.type == MeasureType::jet) {
    result.set("outward", name_of(m.spec.outward.axis, m.spec.outward.sign)).set("drop", jet_of(m).drop());
    result.set("tan_theta", m.shape.tan_theta).set("inner_offset", m.shape.inner_offset);
    result.set("class", m.shape.flow_class.empty() ? Json() : Json(m.shape.flow_class));
  }
  return result;
}

Json Measures::summary() const {
  Json all = Json::object();
  for (const Measure& m : measures_) all.set(m.spec.name, summary_of(m));
  return all;
}

std::vector<std::string> Measures::lines() const {
  std::vector<std::string> lines;
  for (const Measure& m : measures_) {
    std::string line = m.spec.name + " (" + type_name(m.spec.type) + "): ";
    if (const auto arrival = m.clock.arrival()) {
      line += "arrived after " + format("%.4g s", *arrival);
    } else {
      line += "not arrived, front at " + format("%.4g m", m.leading) + ", passed " +
              format("%.3g %%", 100 * m.passed);
    }
    if (!m.shape.flow_class.empty())
      line += ", " + m.shape.flow_class + ", tan theta " + format("%.3g", m.shape.tan_theta);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace slagflow
