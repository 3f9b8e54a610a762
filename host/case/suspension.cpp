#include "host/case/suspension.hpp"

#include <algorithm>

namespace slagflow {
namespace {

using Rows = std::vector<std::array<double, 2>>;

constexpr const char* rows_allowed =
    "rows [solid fraction from 0 to below 1, yield stress >= 0 in Pa], the fraction increasing";

// The solid fractions for which the law holds.
Range fractions(const Suspension& law) {
  if (law.law == SuspensionLaw::thomas) return between(0, thomas_limit, "");
  Range range = between(0, law.critical_fraction, "");
  range.upper_bound = Bound::open;
  return range;
}

// The law and its constants; false where something is missing or wrong.
bool read_law(CaseTable& t, Suspension& law) {
  std::vector<std::string> names;
  for (const SuspensionInfo& info : suspension_laws) names.push_back(info.name);
  if (!t.read_enum("suspension", law.law, names, Need::required)) {
    t.accept("critical_fraction"), t.accept("exponent");
    return false;
  }
  bool fine = true;
  const auto optional = [&](const char* key, double& value, Range range) {
    range.lower_bound = Bound::open;
    if (!t.read(key, value, range) && t.has(key)) fine = false;
  };
  law.critical_fraction = law.info().critical_fraction;
  if (law.critical_fraction > 0) optional("critical_fraction", law.critical_fraction, between(0, 1, ""));
  if (law.law == SuspensionLaw::einstein_roscoe) optional("exponent", law.exponent, between(0, 10, ""));
  return fine;
}

// The first row that is out of range or does not follow the one before; rows.size() if all is well.
std::size_t wrong_row(const Rows& rows) {
  double before = -1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto [fraction, stress] = rows[r];
    const bool follows = fraction > before && fraction >= 0 && fraction < 1;
    if (!follows || !(stress >= 0 && stress <= Range::largest)) return r;
    before = fraction;
  }
  return rows.size();
}

// At most the last row's fraction.
double interpolated(const Rows& rows, double fraction) {
  const auto above =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row[0] >= fraction; });
  const auto [x, y] = *above;
  if (x == fraction) return y;
  if (above == rows.begin()) return 0;
  const auto [x0, y0] = *(above - 1);
  return y0 + (y - y0) * (fraction - x0) / (x - x0);
}

}  // namespace

Range range_of(const ParameterInfo& parameter) {
  Range range = between(parameter.lower, parameter.upper, parameter.unit);
  range.lower_bound = parameter.lower_allowed ? Bound::closed : Bound::open;
  return range;
}

bool is_suspension(const CaseTable& fluid) {
  const auto keys = {"solid_fraction",   "suspension",        "liquid_density", "solid_density",
                     "liquid_viscosity", "critical_fraction", "exponent"};
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return fluid.has(key); });
}

SuspensionSpec read_suspension(CaseTable& t, FluidSpec& fluid) {
  SuspensionSpec s;
  t.refuse("density", "a suspension has liquid_density and solid_density instead");
  const bool law = read_law(t, s.law);
  const bool fraction =
      t.read("solid_fraction", s.solid_fraction, law ? fractions(s.law) : between(0, 1, ""), Need::required);
  const bool liquid = t.read("liquid_density", s.liquid_density, above(0, "kg/m^3"), Need::required);
  const bool solid = t.read("solid_density", s.solid_density, above(0, "kg/m^3"), Need::required);
  const bool viscous = t.read("liquid_viscosity", s.liquid_viscosity, above(0, "Pa s"), Need::required);
  s.complete = law && fraction && liquid && solid && viscous;
  fluid.density = (1 - s.solid_fraction) * s.liquid_density + s.solid_fraction * s.solid_density;
  return s;
}

void read_raised(CaseTable& t, const SuspensionSpec& suspension, const ParameterInfo& parameter,
                 double& value) {
  t.refuse(parameter.key, "a suspension has liquid_viscosity instead");
  if (!suspension.complete) return;
  value = suspension.liquid_viscosity * relative_viscosity(suspension.law, suspension.solid_fraction);
  if (!range_of(parameter).holds(value))
    t.problem("solid_fraction", "value " + show(suspension.solid_fraction) + " gives the parameter '" +
                                    parameter.key + "' the value " + show(value) +
                                    ": allowed: " + range_of(parameter).text());
}

void read_yield_stress(CaseTable& t, const SuspensionSpec& suspension, const ParameterInfo& parameter,
                       double& value) {
  if (!t.is_list(parameter.key)) {
    t.read(parameter.key, value, range_of(parameter), Need::required);
    return;
  }
  Rows rows;
  if (!t.read(parameter.key, rows, rows_allowed)) return;
  const double fraction = suspension.solid_fraction;
  const std::size_t wrong = wrong_row(rows);
  if (rows.empty())
    t.problem(parameter.key, std::string("value [] is empty: allowed: ") + rows_allowed);
  else if (wrong < rows.size())
    t.problem(parameter.key, "row [" + show(rows[wrong][0]) + ", " + show(rows[wrong][1]) +
                                 "] is out of range or order: allowed: " + rows_allowed);
  else if (suspension.complete && fraction > rows.back()[0])
    t.problem(parameter.key, "the table ends at the solid fraction " + show(rows.back()[0]) +
                                 ": allowed: rows up to solid_fraction = " + show(fraction));
  else if (suspension.complete)
    value = interpolated(rows, fraction);
}

}  // namespace slagflow
