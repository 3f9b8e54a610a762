#include "host/rheometry/rheometry_columns.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "host/text/number_text.hpp"

namespace slagflow {
namespace {

constexpr double rate_spread = 1.3;  // largest over least, within a series over temperature

const std::string& field(const Record& row, int k) { return row.fields[static_cast<std::size_t>(k)]; }

}  // namespace

bool is_zero(const Block& block, int k) {
  return !block.rows.empty() && std::all_of(block.rows.begin(), block.rows.end(), [k](const Record& row) {
    return stands_for_no_number(field(row, k)) || number_of(field(row, k), DecimalSign::point) == 0.0 ||
           number_of(field(row, k), DecimalSign::comma) == 0.0;
  });
}

std::pair<double, double> range_of(const Block& block, int k) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Record& row : block.rows)
    for (const DecimalSign sign : {DecimalSign::point, DecimalSign::comma})
      if (const std::optional<double> x = number_of(field(row, k), sign)) {
        low = std::min(low, *x), high = std::max(high, *x);
        break;
      }
  return low <= high ? std::pair{low, high} : std::pair{0.0, 0.0};
}

bool is_series(const Block& block, bool wanted) {
  const int t = block.column_of(Quantity::temperature);
  if (t < 0 || !block.columns[static_cast<std::size_t>(t)].meaning.unit_known) return false;
  if (wanted || !block.has_flow_pair()) return true;
  const auto [low, high] = range_of(block, t);
  if (high - low <= temperature_spread) return false;
  for (const Quantity q : {Quantity::shear_rate, Quantity::rotation})
    if (const int k = block.column_of(q); k >= 0 && !is_zero(block, k)) {
      const auto [slowest, fastest] = range_of(block, k);
      return fastest <= rate_spread * slowest;
    }
  return false;
}

}  // namespace slagflow
