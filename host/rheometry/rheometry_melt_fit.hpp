// Fits laws of temperature to viscosities of a melt.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid/material.hpp"
#include "host/rheometry/rheometry_fit.hpp"

namespace slagflow {

// In ascending order of the temperature.
struct ViscositySeries {
  std::vector<double> temperature;  // [K]
  std::vector<double> viscosity;    // [Pa s]

  std::size_t count() const { return temperature.size(); }
  bool empty() const { return temperature.empty(); }
};

inline constexpr std::array<LiquidLaw, 3> melt_laws{LiquidLaw::arrhenius, LiquidLaw::weymann, LiquidLaw::vft};
inline const char* name_of(LiquidLaw law) { return liquid_laws[static_cast<std::size_t>(law)].name; }

struct MeltFit {
  LiquidLaw law = LiquidLaw::weymann;
  Estimate a, b, t0;  // as in LiquidViscosity
  int free_parameters = 0;
  double residual = 0;  // root of the mean squared residual of ln eta
  double aicc = 0;

  LiquidViscosity liquid() const { return {law, a.value, b.value, t0.value, {}}; }
  double viscosity(double temperature) const;  // [K] -> [Pa s]
};

// The least number of readings with which a law can be fitted and compared, as of flow curves.
int points_needed(LiquidLaw law);

// Least squares of ln eta by Levenberg and Marquardt; intervals and AICc as of flow curves, that of A from
// ln A. Throws InputError with too few readings, Error when the iteration fails or leaves what a case allows.
MeltFit fit(LiquidLaw law, const ViscositySeries& series);

// All laws for which there are enough readings and that converge, best first by AICc.
std::vector<MeltFit> fit_all(const ViscositySeries& series);

// Where the viscosity begins to rise above the trend of the hot readings: two straight lines of ln eta over
// 1/T, which fit the readings far better than any of the laws. Nothing: there is no such place.
struct Kink {
  double temperature = 0;  // [K] the coldest reading of the hot part
  double excess = 0;       // viscosity of the coldest reading over the trend
};
std::optional<Kink> find_kink(const ViscositySeries& series, const std::vector<MeltFit>& fits);

}  // namespace slagflow
