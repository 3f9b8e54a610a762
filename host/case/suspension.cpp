#include "host/case/suspension.hpp"

#include <algorithm>

namespace slagflow {
namespace {

// The first row that is out of range or does not follow the one before; rows.size() if all is well.
std::size_t wrong_row(const YieldRows& rows) {
  double before = -1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto [fraction, stress] = rows[r];
    const bool follows = fraction > before && fraction >= 0 && fraction < 1;
    if (!follows || !(stress >= 0 && stress <= Range::largest)) return r;
    before = fraction;
  }
  return rows.size();
}

}  // namespace

Range range_of(const ParameterInfo& parameter) {
  Range range = between(parameter.lower, parameter.upper, parameter.unit);
  range.lower_bound = parameter.lower_allowed ? Bound::closed : Bound::open;
  return range;
}

Range fractions(const Suspension& law) {
  if (law.law == SuspensionLaw::thomas) return between(0, thomas_limit, "");
  Range range = between(0, law.critical_fraction, "");
  range.upper_bound = Bound::open;
  return range;
}

double most_fraction(const Suspension& law) {
  return law.law == SuspensionLaw::thomas ? thomas_limit : law.critical_fraction;
}

std::string fault_of(const YieldRows& rows) {
  const std::size_t wrong = wrong_row(rows);
  if (wrong == rows.size()) return "";
  return "row [" + show(rows[wrong][0]) + ", " + show(rows[wrong][1]) +
         "] is out of range or order: allowed: " + yield_rows_allowed;
}

std::string fault_of(const YieldRows& rows, const SuspensionSpec& suspension) {
  std::string fault = fault_of(rows);
  if (!fault.empty()) return fault;
  if (suspension.complete && suspension.solid_fraction > rows.back()[0])
    return "the table ends at the solid fraction " + show(rows.back()[0]) +
           ": allowed: rows up to solid_fraction = " + show(suspension.solid_fraction);
  return "";
}

double yield_stress_at(double solid_fraction, const YieldRows& rows) {
  const auto above =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row[0] >= solid_fraction; });
  const auto [x, y] = *above;
  if (x == solid_fraction) return y;
  if (above == rows.begin()) return 0;
  const auto [x0, y0] = *(above - 1);
  return y0 + (y - y0) * (solid_fraction - x0) / (x - x0);
}

}  // namespace slagflow
