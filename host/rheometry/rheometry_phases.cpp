#include "host/rheometry/rheometry_phases.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "heat/material_table.hpp"
#include "host/case/toml_reader.hpp"
#include "host/rheometry/rheometry_freezing.hpp"

namespace slagflow {
namespace {

constexpr double ice = 273.15;  // [K]

std::string both_scales(double kelvin) { return print("%.2f K (%.2f C)", kelvin, kelvin - ice); }

// Where the fraction falls through a value.
double temperature_at(const ValueRows& solids, double fraction) {
  for (std::size_t k = 1; k < solids.size(); ++k)
    if (solids[k][1] < fraction)
      return solids[k - 1][0] + (solids[k - 1][1] - fraction) / (solids[k - 1][1] - solids[k][1]) *
                                    (solids[k][0] - solids[k - 1][0]);
  return solids.back()[0];
}

// Rows of a key, six to a line; of equal temperatures the first where they must rise.
std::string rows_text(const std::string& name, const ValueRows& rows, bool rising) {
  constexpr int in_line = 6;
  std::string text = name + " = [";
  double last = -1;
  int count = 0;
  for (const auto& row : rows) {
    const double t = rounded(row[0]);
    if (rising && t <= last) continue;
    text += (count > 0 ? "," : "") + std::string(count % in_line == 0 ? "\n  " : " ") + "[" + show(t) + ", " +
            print("%.4g", row[1]) + "]";
    last = t, ++count;
  }
  return text + "\n]\n";
}

std::string to_text(const PhaseTable& table, const Freezing& freezing, const std::optional<MeltHeat>& heat) {
  const ValueRows& s = freezing.solids;
  std::string text = "read as " + table.how + "\n";
  text += "liquidus " + both_scales(s.back()[0]) + ", half solid at " + both_scales(temperature_at(s, 0.5)) +
          ", solidus " + both_scales(s.front()[0]) + "\n";
  text += std::to_string(s.size()) +
          print(" rows of the solid fraction, within %.2g of the file\n", freezing.off);
  if (!heat) return text + "no enthalpy and no heat capacity in the file\n";
  text += std::to_string(heat->heat_capacity.size()) + " rows of the heat capacity";
  if (heat->latent_heat)
    text += print(", latent heat %.4g J/kg; with them the enthalpy of the file is met within %.2g J/kg",
                  *heat->latent_heat, heat->off);
  else
    text += ", no enthalpy that tells the latent heat";
  return text + "\n";
}

std::string to_table(const PhaseTable& table, const Freezing& freezing, const std::optional<MeltHeat>& heat,
                     const RheometryOptions& options) {
  std::string text = first_line(std::filesystem::path(options.file).filename().string(),
                                std::to_string(table.rows.size()) + " rows of phases");
  text += "# For a case with [thermal].\n[fluid." + fluid_name(table.facts, options.file) + "]\n" +
          density_line(table.facts) +
          "rheology = \"newtonian\"\n# liquid_viscosity = ...  # must be added, as of viscosities over "
          "temperature or of a composition\n" +
          rows_text("solid_fraction", freezing.solids, false);
  text += heat ? rows_text("heat_capacity", heat->heat_capacity, true)
               : "# heat_capacity = ...  # [J/kg K] must be added, rows over temperature or a number\n";
  text += heat && heat->latent_heat ? "latent_heat = " + show(rounded(*heat->latent_heat)) + "\n"
                                    : "# latent_heat = ...  # [J/kg] 0 unless it is added\n";
  return text + "# conductivity = ...  # [W/m K] must be added\n";
}

std::string to_curves(const PhaseTable& table, const ValueRows& solids) {
  std::string text = std::string("temperature_K") + curves_mark + "solid_fraction,rows_solid_fraction\n";
  for (const PhaseRow& row : table.rows)
    text += print("%.9g,%.6g,%.6g\n", row.temperature, row.solids, value_at(solids, row.temperature));
  for (const auto& row : solids) text += print("%.9g,,%.6g\n", row[0], row[1]);
  return text;
}

}  // namespace

Answer phases_answer(const RheometryOptions& options) {
  const PhaseTable table =
      parse_phases(read_whole_file(options.file), options.file, options.facts, options.mass);
  Answer answer;
  answer.warnings = table.warnings;
  const Freezing freezing = freezing_of(table, options.file, answer.warnings);
  const std::optional<MeltHeat> heat = heat_of(table, freezing.solids, options.file, answer.warnings);
  if (!table.facts.density)
    answer.warnings.push_back(options.file +
                              ": no density, which the fluid table needs: a line `# density_kg/m3 = ...` or "
                              "the option --density");
  answer.text = to_text(table, freezing, heat);
  answer.table = to_table(table, freezing, heat, options);
  answer.curves = to_curves(table, freezing.solids);
  return answer;
}

}  // namespace slagflow
