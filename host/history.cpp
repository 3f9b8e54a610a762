#include "host/history.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>

#include "backend/error.hpp"

namespace slagflow {
namespace {

std::string number(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 40> text{};
  const bool whole = std::abs(value) < 1e15 && value == std::floor(value);
  std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.9g", value);
  return text.data();
}

}  // namespace

HistoryFile::HistoryFile(std::string path, std::vector<std::string> columns)
    : path_(std::move(path)), columns_(columns.size()), file_(path_, std::ios::trunc) {
  for (std::size_t k = 0; k < columns.size(); ++k) file_ << (k > 0 ? "," : "") << columns[k];
  file_ << '\n';
  require_written();
}

void HistoryFile::write(const std::vector<double>& values) {
  if (values.size() != columns_)
    throw Error(path_ + ": " + std::to_string(values.size()) + " values for " + std::to_string(columns_) +
                " columns");
  for (std::size_t k = 0; k < values.size(); ++k) file_ << (k > 0 ? "," : "") << number(values[k]);
  file_ << '\n';
  require_written();
}

void HistoryFile::require_written() {
  file_.flush();
  if (!file_) throw Error("cannot write to " + path_ + ": " + std::strerror(errno));
}

std::vector<std::string> history_columns() {
  return {"time_s",
          "step",
          "dt_s",
          "particles_in",
          "particles_out",
          "max_speed_m_s",
          "kinetic_energy_J",
          "potential_energy_J",
          "dissipated_energy_J",
          "max_density_error",
          "mass_in_kg",
          "mass_left_kg",
          "iterations",
          "residual"};
}

std::vector<double> history_values(const Simulation& simulation, const Totals& totals) {
  const SolveReport solve = simulation.last_solve();
  const auto out = std::accumulate(totals.departed.begin(), totals.departed.end(), std::int64_t{0});
  return {simulation.time(),
          static_cast<double>(simulation.steps()),
          simulation.time_step(),
          static_cast<double>(totals.particles),
          static_cast<double>(out),
          totals.max_speed,
          totals.kinetic_energy,
          totals.potential_energy,
          totals.dissipated_energy,
          totals.max_density_error,
          totals.mass_in,
          totals.mass_left,
          static_cast<double>(solve.iterations),
          solve.residual};
}

}  // namespace slagflow
