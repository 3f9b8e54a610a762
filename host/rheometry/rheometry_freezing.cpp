#include "host/rheometry/rheometry_freezing.hpp"

#include <algorithm>
#include <cmath>

#include "backend/error.hpp"
#include "heat/material_table.hpp"
#include "host/rheometry/rheometry_output.hpp"

namespace slagflow {
namespace {

constexpr double largest_fall = 0.05;  // of the solid fraction while it cools: more is refused
constexpr double unseen_fall = 1e-6;
constexpr double trace = 5e-4;          // a fraction that is none
constexpr double farthest_end = 0.2;    // of the solid fraction that the table may leave out
constexpr double fair_solids = 0.002;   // how near the rows are to the table
constexpr double fair_capacity = 0.01;  // the same, as a share
constexpr std::size_t most_rows = 40;

// Distance of row k from the line between two others.
double distance(const ValueRows& rows, std::size_t from, std::size_t to, std::size_t k) {
  const double span = rows[to][0] - rows[from][0];
  const double share = span > 0 ? (rows[k][0] - rows[from][0]) / span : 0;
  return std::abs(rows[k][1] - rows[from][1] - share * (rows[to][1] - rows[from][1]));
}

std::string at(const std::string& file, int line) { return file + ":" + std::to_string(line) + ": "; }

// From the hottest row on, so that the fraction never falls while it cools.
ValueRows rising_solids(const PhaseTable& table, const std::string& file,
                        std::vector<std::string>& warnings) {
  ValueRows rows;
  for (const PhaseRow& row : table.rows) {
    const bool solid = row.solids > 1 - trace, liquid = row.solids < trace;
    rows.push_back({row.temperature, solid ? 1 : liquid ? 0 : row.solids});
  }
  double largest = 0;
  int count = 0;
  std::size_t worst = 0;
  for (std::size_t k = rows.size() - 1; k-- > 0;) {
    const double fall = rows[k + 1][1] - rows[k][1];
    if (fall <= 0) continue;
    count += fall > unseen_fall;
    if (fall > largest) largest = fall, worst = k;
    rows[k][1] = rows[k + 1][1];
  }
  const std::string where = at(file, table.rows[worst].line);
  if (largest > largest_fall)
    throw InputError(where + print("the solid fraction falls to %.4g from %.4g while it cools to %.6g K: "
                                   "allowed: up to %.2g; other conditions in one file?",
                                   table.rows[worst].solids, rows[worst][1], rows[worst][0], largest_fall));
  if (count > 0)
    warnings.push_back(where +
                       print("the solid fraction falls while it cools, in %d of the rows, here the most, by "
                             "%.2g: it is held there",
                             count, largest));
  return rows;
}

// A row before the first or after the last, on the line through the outer two that differ.
void add_end(ValueRows& rows, bool cold, const std::string& file, std::vector<std::string>& warnings) {
  const double wanted = cold ? 1 : 0;
  const std::array<double, 2> end = cold ? rows.front() : rows.back();
  if (end[1] == wanted) return;
  if (std::abs(end[1] - wanted) > farthest_end)
    throw InputError(file +
                     print(": at its %s temperature, %.6g K, the solid fraction is %.4g: allowed: a table "
                           "from where all is solid to where all is liquid",
                           cold ? "lowest" : "highest", end[0], end[1]));
  std::size_t inner = cold ? 1 : rows.size() - 2;
  while (rows[inner][1] == end[1] && inner > 0 && inner + 1 < rows.size()) cold ? ++inner : --inner;
  const double slope = (rows[inner][1] - end[1]) / (rows[inner][0] - end[0]);
  const double reach = slope < 0 ? std::clamp((wanted - end[1]) / slope, -200.0, 200.0) : (cold ? -1 : 1);
  const std::array<double, 2> added{end[0] + (cold ? std::min(reach, -1.0) : std::max(reach, 1.0)), wanted};
  rows.insert(cold ? rows.begin() : rows.end(), added);
  warnings.push_back(file +
                     print(": the table ends at %.6g K with a solid fraction of %.4g: a row [%.6g, %g] is "
                           "added, which is a guess",
                           end[0], end[1], added[0], wanted));
}

// Without what is solid or liquid for sure.
void trim(ValueRows& rows) {
  std::size_t first = 0, last = rows.size() - 1;
  while (first + 1 < rows.size() && rows[first + 1][1] >= 1) ++first;
  while (last > 0 && rows[last - 1][1] <= 0) --last;
  rows.assign(rows.begin() + static_cast<std::ptrdiff_t>(first),
              rows.begin() + static_cast<std::ptrdiff_t>(last) + 1);
}

// Of H over T outside of the freezing range; the slope between two rows stands at their middle.
ValueRows slopes(const PhaseTable& table, double from, double to) {
  constexpr double least_step = 0.5;  // [K]
  ValueRows found;
  const PhaseRow* last = nullptr;
  for (const PhaseRow& row : table.rows) {
    if (!row.enthalpy || row.temperature < from || row.temperature > to) continue;
    if (last && row.temperature - last->temperature < least_step) continue;
    if (last)
      found.push_back({(row.temperature + last->temperature) / 2,
                       (*row.enthalpy - *last->enthalpy) / (row.temperature - last->temperature)});
    last = &row;
  }
  return found;
}

// c of the solid and of the liquid, and between them as the solids have it.
ValueRows capacity_by_enthalpy(const PhaseTable& table, const ValueRows& solids, const std::string& file) {
  const double solidus = solids.front()[0], liquidus = solids.back()[0];
  const ValueRows cold = slopes(table, 0, solidus), hot = slopes(table, liquidus, 1e9);
  if (cold.empty() && hot.empty())
    throw InputError(file +
                     ": no two rows below the solidus or above the liquidus tell the heat capacity: allowed: "
                     "further rows with an enthalpy, or a column of the heat capacity");
  const double of_solid = cold.empty() ? hot.front()[1] : cold.back()[1],
               of_liquid = hot.empty() ? cold.back()[1] : hot.front()[1];
  ValueRows rows = cold;
  for (const auto& row : solids)
    if (rows.empty() || row[0] > rows.back()[0])
      rows.push_back({row[0], of_liquid + (of_solid - of_liquid) * row[1]});
  rows.insert(rows.end(), hot.begin(), hot.end());
  return rows;
}

ValueRows capacity_by_column(const PhaseTable& table) {
  ValueRows rows;
  for (const PhaseRow& row : table.rows)
    if (row.heat_capacity && (rows.empty() || row.temperature > rows.back()[0]))
      rows.push_back({row.temperature, *row.heat_capacity});
  return rows;
}

// H at a temperature, beyond the rows as c has it.
double enthalpy_at(const ValueRows& enthalpies, const ValueRows& capacity, double t) {
  const double nearest = std::clamp(t, enthalpies.front()[0], enthalpies.back()[0]);
  return value_at(enthalpies, nearest) + integral(capacity, nearest, t);
}

// L from what c leaves of the enthalpy between solidus and liquidus, and how far (H2) is off.
void take_latent_heat(MeltHeat& heat, const PhaseTable& table, const ValueRows& solids) {
  ValueRows enthalpies;
  for (const PhaseRow& row : table.rows)
    if (row.enthalpy) enthalpies.push_back({row.temperature, *row.enthalpy});
  if (enthalpies.size() < 2) return;
  const ValueRows& c = heat.heat_capacity;
  const double solidus = solids.front()[0], liquidus = solids.back()[0];
  const double at_solidus = enthalpy_at(enthalpies, c, solidus);
  heat.latent_heat =
      std::max(0.0, enthalpy_at(enthalpies, c, liquidus) - at_solidus - integral(c, solidus, liquidus));
  for (const auto& row : enthalpies) {
    const double here =
        at_solidus + integral(c, solidus, row[0]) + *heat.latent_heat * (1 - value_at(solids, row[0]));
    heat.off = std::max(heat.off, std::abs(here - row[1]));
  }
}

}  // namespace

ValueRows thinned(const ValueRows& rows, double within, std::size_t most, double& off) {
  std::vector<std::size_t> kept{0, rows.size() - 1};
  while (true) {
    std::size_t worst = 0, place = 0;
    off = 0;
    for (std::size_t k = 0; k + 1 < kept.size(); ++k)
      for (std::size_t i = kept[k] + 1; i < kept[k + 1]; ++i)
        if (const double d = distance(rows, kept[k], kept[k + 1], i); d > off)
          off = d, worst = i, place = k + 1;
    if (off <= within || kept.size() >= most) break;
    kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(place), worst);
  }
  ValueRows few;
  for (const std::size_t k : kept) few.push_back(rows[k]);
  return few;
}

double integral(const ValueRows& rows, double from, double to) {
  if (to < from) return -integral(rows, to, from);
  double sum = 0, x = from;
  const auto add = [&](double next) {
    sum += (next - x) * (value_at(rows, x) + value_at(rows, next)) / 2;
    x = next;
  };
  for (const auto& row : rows)
    if (row[0] > x && row[0] < to) add(row[0]);
  add(to);
  return sum;
}

Freezing freezing_of(const PhaseTable& table, const std::string& file, std::vector<std::string>& warnings) {
  if (table.rows.size() < 3)
    throw InputError(file + ": " + std::to_string(table.rows.size()) + " rows: allowed: at least 3");
  ValueRows rows = rising_solids(table, file, warnings);
  if (rows.front()[0] == rows.back()[0] || rows.front()[1] == rows.back()[1])
    throw InputError(file +
                     ": nothing freezes over its temperatures: allowed: a table from where all is solid "
                     "to where all is liquid");
  add_end(rows, true, file, warnings);
  add_end(rows, false, file, warnings);
  trim(rows);
  Freezing result;
  result.solids = thinned(rows, fair_solids, most_rows, result.off);
  if (result.off > fair_solids)
    warnings.push_back(file + print(": %d rows leave the solid fraction off by up to %.2g",
                                    static_cast<int>(most_rows), result.off));
  return result;
}

std::optional<MeltHeat> heat_of(const PhaseTable& table, const ValueRows& solids, const std::string& file,
                                std::vector<std::string>& warnings) {
  MeltHeat heat;
  heat.heat_capacity = capacity_by_column(table);
  const bool enthalpy = std::any_of(table.rows.begin(), table.rows.end(),
                                    [](const PhaseRow& row) { return row.enthalpy.has_value(); });
  if (heat.heat_capacity.empty() && !enthalpy) return {};
  if (heat.heat_capacity.empty()) heat.heat_capacity = capacity_by_enthalpy(table, solids, file);
  double mean = 0, off = 0;
  for (const auto& row : heat.heat_capacity) {
    if (!(row[1] > 0))
      throw InputError(file + print(": the heat capacity is %.4g J/kg K at %.6g K: allowed: > 0; is the "
                                    "enthalpy one that rises with the temperature, and its mass right?",
                                    row[1], row[0]));
    mean += row[1] / static_cast<double>(heat.heat_capacity.size());
  }
  heat.heat_capacity = thinned(heat.heat_capacity, fair_capacity * mean, most_rows, off);
  take_latent_heat(heat, table, solids);
  if (heat.latent_heat && *heat.latent_heat == 0)
    warnings.push_back(file +
                       ": the enthalpy rises by no more than the heat capacity has it: latent_heat = 0");
  return heat;
}

}  // namespace slagflow
