#include "host/output/history.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
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

std::string header(const std::vector<std::string>& columns) {
  std::string line;
  for (const std::string& column : columns) line += (line.empty() ? "" : ",") + column;
  return line + '\n';
}

// Throws Error unless the file has this header and at least the bytes up to the end.
void require_begins_with(const std::string& path, const std::string& header, const HistoryEnd& end) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Error("cannot read " + path + ": " + std::strerror(errno));
  const auto size = static_cast<std::int64_t>(file.tellg());
  if (size < end.bytes || end.bytes < static_cast<std::int64_t>(header.size()))
    throw Error(path + ": holds " + std::to_string(size) + " bytes where the checkpoint knows of " +
                std::to_string(end.bytes));
  std::string present(header.size(), '\0');
  file.seekg(0).read(present.data(), static_cast<std::streamsize>(present.size()));
  if (present != header) throw Error(path + ": has other columns than the run");
}

}  // namespace

HistoryFile::HistoryFile(std::string path, const std::vector<std::string>& columns)
    : path_(std::move(path)), columns_(columns.size()), file_(path_, std::ios::trunc) {
  put(header(columns));
}

HistoryFile::HistoryFile(std::string path, const std::vector<std::string>& columns, const HistoryEnd& end)
    : path_(std::move(path)), columns_(columns.size()), end_(end) {
  require_begins_with(path_, header(columns), end);
  std::error_code failed;
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(end.bytes), failed);
  if (failed) throw Error("cannot cut " + path_ + ": " + failed.message());
  file_.open(path_, std::ios::app);
  if (!file_) throw Error("cannot write to " + path_ + ": " + std::strerror(errno));
}

void HistoryFile::write(const std::vector<double>& values) {
  if (values.size() != columns_)
    throw Error(path_ + ": " + std::to_string(values.size()) + " values for " + std::to_string(columns_) +
                " columns");
  std::string line;
  for (std::size_t k = 0; k < values.size(); ++k) line += (k > 0 ? "," : "") + number(values[k]);
  put(line + '\n');
  ++end_.lines;
}

void HistoryFile::put(const std::string& line) {
  file_ << line << std::flush;
  if (!file_) {
    const std::string reason = std::strerror(errno);
    std::error_code ignored;  // a line is there as a whole or not at all
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(end_.bytes), ignored);
    throw Error("cannot write to " + path_ + ": " + reason);
  }
  end_.bytes += static_cast<std::int64_t>(line.size());
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
          "in_thin_sheets",
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
          static_cast<double>(totals.in_thin_sheets),
          static_cast<double>(solve.iterations),
          solve.residual};
}

}  // namespace slagflow
