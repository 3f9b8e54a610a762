#include "host/measures/measure_force.hpp"

#include "host/measures/measure_text.hpp"

namespace slagflow {
namespace {

void append(std::vector<double>& values, const Vec3d& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

Vec3d vector_at(const double* values) { return {values[0], values[1], values[2]}; }

Json json_of(const Vec3d& v) { return Json::object().set("x", v.x).set("y", v.y).set("z", v.z); }

}  // namespace

std::vector<std::string> ForceMeasure::columns() const {
  const std::string width = dimensions_ == 2 ? "_m" : "";
  std::vector<std::string> names;
  for (const char* part : {"pressure_", "viscous_", "torque_"})
    for (const char* axis : {"x", "y", "z"})
      names.push_back(std::string(part) + axis + (part[0] == 't' ? "_Nm" : "_N") + width);
  names.push_back("work_J" + width);
  return names;
}

std::vector<double> ForceMeasure::update(const MeasureMoment& moment) {
  const WallLoad& load = moment.totals.walls.at(body_);
  const Vec3d force = load.pressure + load.viscous;
  const Load now{load.pressure, load.viscous,
                 load.pressure_torque + load.viscous_torque - cross(about_, force)};
  const double until = moment.totals.impulse_time;
  if (until > time_) {
    const double per_second = 1 / (until - time_);
    mean_ = {per_second * (now.pressure - impulse_.pressure), per_second * (now.viscous - impulse_.viscous),
             per_second * (now.torque - impulse_.torque)};
    const double size = norm(mean_.pressure + mean_.viscous);
    if (!(size <= largest_)) largest_ = size, largest_time_ = moment.time;
  }
  time_ = until, impulse_ = now, work_ = load.work;
  std::vector<double> values;
  append(values, mean_.pressure), append(values, mean_.viscous), append(values, mean_.torque);
  values.push_back(work_);
  return values;
}

std::vector<double> ForceMeasure::state() const {
  std::vector<double> state{time_, work_, largest_, largest_time_};
  for (const Load& load : {impulse_, mean_})
    append(state, load.pressure), append(state, load.viscous), append(state, load.torque);
  return state;
}

void ForceMeasure::restore(const double* state) {
  time_ = state[0], work_ = state[1], largest_ = state[2], largest_time_ = state[3];
  const double* next = state + 4;
  for (Load* load : {&impulse_, &mean_}) {
    load->pressure = vector_at(next), load->viscous = vector_at(next + 3), load->torque = vector_at(next + 6);
    next += 9;
  }
}

Json ForceMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("wall", wall_).set("about", json_of(about_));
  result.set("pressure_force", json_of(mean_.pressure)).set("viscous_force", json_of(mean_.viscous));
  result.set("torque", json_of(mean_.torque));
  result.set("impulse", json_of(impulse_.pressure + impulse_.viscous)).set("work", work_);
  return result.set("largest_force", largest_).set("largest_force_time", largest_time_);
}

std::string ForceMeasure::line() const {
  const Vec3d f = mean_.pressure + mean_.viscous;
  return "on " + wall_ + ", at last (" + format("%.4g, ", f.x) + format("%.4g, ", f.y) +
         format("%.4g) N", f.z) + (dimensions_ == 2 ? "/m" : "") + format(", largest %.4g N", largest_) +
         (dimensions_ == 2 ? "/m" : "");
}

}  // namespace slagflow
