#include "host/measures/measure_contact.hpp"

#include <algorithm>

#include "host/measures/measure_text.hpp"

namespace slagflow {

ContactMeasure::ContactMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index)
    : Measure(spec.name),
      index_(index),
      wall_(setup.bodies.at(setup.contacts.at(index)).name),
      unit_(setup.dimensions == 2 ? "m" : "m2") {}

std::vector<std::string> ContactMeasure::columns() const {
  return {"wetted_share", "wetted_" + unit_, "mean_pressure_Pa", "largest_pressure_Pa",
          "largest_x_m",  "largest_y_m",     "largest_z_m"};
}

std::vector<double> ContactMeasure::update(const MeasureMoment& moment) {
  now_ = moment.totals.contacts.at(index_);
  largest_share_ = std::max(largest_share_, share());
  const double p = now_.largest_pressure;
  if (p > largest_.pressure || (largest_.pressure != largest_.pressure && p == p))
    largest_ = {p, moment.time, now_.place};
  return {share(), now_.wetted, now_.mean_pressure, p, now_.place.x, now_.place.y, now_.place.z};
}

std::vector<double> ContactMeasure::state() const {
  return {now_.area,        now_.wetted,      now_.mean_pressure, now_.largest_pressure, now_.place.x,
          now_.place.y,     now_.place.z,     largest_.pressure,  largest_.time,         largest_.place.x,
          largest_.place.y, largest_.place.z, largest_share_};
}

void ContactMeasure::restore(const double* s) {
  now_ = {s[0], s[1], s[2], s[3], {s[4], s[5], s[6]}};
  largest_ = {s[7], s[8], {s[9], s[10], s[11]}};
  largest_share_ = s[12];
}

Json ContactMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("wall", wall_).set("area", now_.area).set("wetted_area", now_.wetted);
  result.set("wetted_share", share()).set("largest_wetted_share", largest_share_);
  result.set("mean_pressure", now_.mean_pressure).set("largest_pressure", largest_.pressure);
  result.set("largest_pressure_time", largest_.time);
  const Vec3d& at = largest_.place;
  return result.set("largest_pressure_place", Json::object().set("x", at.x).set("y", at.y).set("z", at.z));
}

std::string ContactMeasure::line() const {
  if (!(largest_.pressure == largest_.pressure)) return "no fluid came to " + wall_;
  const Vec3d& at = largest_.place;
  return "fluid on " + format("%.3g %% of ", 100 * share()) + wall_ + format(", %.4g ", now_.wetted) + unit_ +
         format(", at most on %.3g %%", 100 * largest_share_) +
         format("; largest pressure %.4g Pa", largest_.pressure) + format(" at %.4g s", largest_.time) +
         format(" at (%.4g, ", at.x) + format("%.4g, ", at.y) + format("%.4g) m", at.z);
}

}  // namespace slagflow
