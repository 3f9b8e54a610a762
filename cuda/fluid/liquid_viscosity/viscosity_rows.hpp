// Viscosity of a liquid as measured, or from thermodynamics software: between rows its logarithm is linear in
// 1/T; beyond the first and the last row it stays as there.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace slagflow {

// Natural logarithm of the viscosity [Pa s] at a temperature [K]; rows [K], [Pa s], the temperatures rising.
inline double log_viscosity_rows(const std::vector<std::array<double, 2>>& rows, double temperature) {
  if (temperature <= rows.front()[0]) return std::log(rows.front()[1]);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (temperature > rows[k][0]) continue;
    const auto [t0, eta0] = rows[k - 1];
    const auto [t1, eta1] = rows[k];
    const double share = (1 / t0 - 1 / temperature) / (1 / t0 - 1 / t1);
    return (1 - share) * std::log(eta0) + share * std::log(eta1);
  }
  return std::log(rows.back()[1]);
}

}  // namespace slagflow
