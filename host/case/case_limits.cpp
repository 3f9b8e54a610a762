// When the watch ends a run.
#include "host/case/case_sections.hpp"

namespace slagflow {

void read_limits(CaseTable& top, Case& c) {
  CaseTable t = top.table("limits");
  LimitSetup& limits = c.limits;
  t.read_integer("interval", limits.interval, 1, 1000);
  if (!t.says("max_speed", "auto")) t.read("max_speed", limits.max_speed, above(0, "m/s, or \"auto\""));
  Range compression = between(0, 1, "");
  compression.lower_bound = Bound::open;
  t.read("max_compression", limits.max_compression, compression);
  t.read("max_lost_fraction", limits.max_lost_fraction, between(0, 1, ""));
  t.read("min_time_step_ratio", limits.min_time_step_ratio, between(0, 1, ""));
  t.read("max_energy_growth", limits.max_energy_growth, above(0, ""));
  t.finish();
}

std::string limits_text(const LimitSetup& limits) {
  return "[limits]\ninterval = " + std::to_string(limits.interval) +
         "\nmax_speed = " + (limits.max_speed > 0 ? show(limits.max_speed) : "\"auto\"") +
         "\nmax_compression = " + show(limits.max_compression) +
         "\nmax_lost_fraction = " + show(limits.max_lost_fraction) +
         "\nmin_time_step_ratio = " + show(limits.min_time_step_ratio) +
         "\nmax_energy_growth = " + show(limits.max_energy_growth) + "\n\n";
}

}  // namespace slagflow
