// The tables that a case has once, and the order of all.
#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"
#include "host/case/keys_thermal.hpp"

namespace slagflow {
namespace {

const Words departure_names{"remove", "stop"};

void describe_domain(CaseVisitor& v, Case& c) {
  const bool low = v.vector(required("min", "lower corner"), c.domain.lower, any_number("m"));
  const bool high = v.vector(required("max", "upper corner"), c.domain.upper, any_number("m"));
  for (int k = 0; low && high && k < 3; ++k) {
    if (c.domain.lower[k] < c.domain.upper[k]) continue;
    v.problem("max", "value " + show(c.domain.upper[k]) + " along " +
                         axis_names[static_cast<std::size_t>(k)] + " is not above domain.min: allowed: > " +
                         show(c.domain.lower[k]) + " [m]");
    break;
  }
  v.choices(
      key("periodic", "such as [\"y\"]; the extent along it is a whole number of spacings and at least 3 h"),
      c.domain.periodic.data(), axis_names, "an axis");
  v.choice(key("departure", "what happens to a particle that leaves; stop: the run ends with an error"),
           c.domain.departure, departure_names);
  v.choices(key("exits",
                "such as [\"-z\", \"+x\"]: the faces through which fluid is meant to leave, of axes that are "
                "not periodic, with departure = \"remove\". More than 0.1 % of the particles through "
                "another face is a warning, see Losses"),
            c.exits.data(), direction_names, "a face");
}

}  // namespace

bool describe_name(CaseVisitor& v, const Key& k, std::string& name) {
  if (!v.text(k, name)) return false;
  if (is_plain_name(name)) return true;
  v.problem("name", "value " + in_quotes(name) +
                        " is not a name: allowed: up to 100 of letters, digits, _ - . ; " +
                        "the first a letter, digit or _");
  return false;
}

void check_count(CaseVisitor& v, const char* k, std::size_t count, const std::string& of) {
  constexpr std::size_t most = 255;  // particles keep the index of their fluid or wall in one byte
  if (count > most)
    v.problem(k, std::to_string(count) + " entries" + of + ": allowed: up to " + std::to_string(most));
}

void describe_frame(CaseVisitor& v, Case& c) {
  v.table(required("case", "name of the case"), [&] {
    describe_name(v, required("name", "letters, digits, _ - . ; names the default folder runs/NAME"), c.name);
    v.text(key("description", "what it shows"), c.description);
  });
  v.table(required("resolution", "how fine the particles are, and in how many dimensions"), [&] {
    v.number(required("spacing",
                      "distance of the particles at the start; 2e-6 to 1e4, with yield = \"exact\" 5e-6 to "
                      "1e3: single precision does not hold the powers of other lengths"),
             c.spacing, above(0, "m"));
    v.number(key("support_ratio", "support radius h over the spacing; see Limits"), c.support_ratio,
             between(1.5, 4, ""));
    v.integer(key("dimensions",
                  "2: one layer of particles in the plane y = 0, which shapes must hold: give boxes y "
                  "from -1 to 1; y of the domain is ignored"),
              c.dimensions, {2, 3});
    v.vector(key("origin", "particles start at origin + (i + 1/2) spacing"), c.origin, any_number("m"));
  });
  v.table(key("gravity", "what all fluid weighs"),
          [&] { v.vector(key("acceleration", "of gravity"), c.gravity, any_number("m/s^2")); });
  v.table(key("body_force", "a further force on all fluid"), [&] {
    v.vector(
        key("acceleration", "acts as gravity does, but has no hydrostatic pressure: drives periodic flows"),
        c.body_force, any_number("m/s^2"));
  });
  v.table(required("domain", "the box in which particles are"), [&] { describe_domain(v, c); });
}

void describe(CaseVisitor& v, Case& c) {
  describe_frame(v, c);
  describe_thermal(v, c);
  describe_fluids(v, c);
  describe_regions(v, c);
  describe_walls(v, c);
  describe_openings(v, c);
  describe_numerics(v, c);
  v.table(key("limits", "what ends a run, see Stopping, resuming, failing"), [&] { describe(v, c.limits); });
  v.table(required("output", "how long, and what is written"), [&] { describe(v, c.output); });
  describe_measures(v, c);
}

}  // namespace slagflow
