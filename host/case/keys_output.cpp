// [limits]: when the watch ends a run; and [output].
#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"

namespace slagflow {

void describe(CaseVisitor& v, LimitSetup& l) {
  v.integer(key("interval", "steps between looks"), l.interval, {1, 1000});
  v.number(key("max_speed", "auto: three times the sound speed").or_word("auto", 0), l.max_speed,
           above(0, "m/s"));
  v.number(
      key("max_compression",
          "(ρ − ρ₀)/ρ₀ of any step. A flat blow at a tenth of the sound speed has 0.22; the message tells "
          "the sound_speed to take"),
      l.max_compression, above_to(0, 1, ""));
  v.number(key("max_lost_fraction", "of the particles, through all faces of the domain"), l.max_lost_fraction,
           between(0, 1, ""));
  v.number(key("min_time_step_ratio", "of the time step by equation (13)"), l.min_time_step_ratio,
           between(0, 1, ""));
  v.number(key("max_energy_growth",
               "growth of kinetic, potential, elastic and dissipated energy together, less the work of "
               "moving walls and "
               "what close pairs and walls gave by pressure, over kinetic and dissipated energy, three times "
               "the work of "
               "walls and that of lifting the fluid by one spacing; of the same measure what viscosity may "
               "give the "
               "fluid, and, between two looks and with a twentieth of Σ|p|V, what close pairs and walls at "
               "rest may"),
           l.max_energy_growth, above(0, ""));
}

void describe(CaseVisitor& v, OutputSpec& o) {
  const bool timed = v.number(required("end_time",
                                       "steps are no longer than half of it, and the last two before it "
                                       "share what is left, so that one ends there"),
                              o.end_time, above(0, "s"));
  v.number(key("until",
               "the run ends with the first step at or after it, short of end_time or beyond, where steps "
               "are whole again; --until sets it")
               .or_word("end_time", 0),
           o.until, above(0, "s"));
  const auto interval = [&](double most) {
    return timed ? at_least(o.end_time / most, "s, end_time / " + show(most)) : above(0, "s");
  };
  if (v.takes_defaults()) o.interval = o.end_time / 50;
  v.number(key("interval", "between snapshots").by_default("end_time/50"), o.interval,
           interval(most_snapshots));
  if (v.takes_defaults()) o.history_interval = o.interval / 10;
  v.number(key("history_interval", "between lines of history.csv").by_default("interval/10"),
           o.history_interval, interval(most_history_lines));
  v.flag(key("walls", "write walls.vtkhdf"), o.walls);
  v.number(key("checkpoint_interval",
               "of wall time, between checkpoints, the first at the start; 0: only at the end "
               "and on signals"),
           o.checkpoint_interval, at_least(0, "s"));
  v.text(key("stop_after",
             "name of a front or jet: the run ends when it has arrived, at end_time at the latest"),
         o.stop_after);
  Range until = above(0, "s, or \"end_time\"");
  until.upper = longest_run(o);
  if (timed && o.until > until.upper)
    v.problem("until", "value " + show(o.until) + " is out of range: allowed: " + until.text());
}

}  // namespace slagflow
