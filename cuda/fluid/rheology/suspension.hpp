// Viscosity of a suspension of solid particles over that of its liquid, as a function of the solid fraction
// phi. The host layer works it out once; the device knows only the result.
//   R. Roscoe, Br. J. Appl. Phys. 3 (1952) 267: (1 - phi/phi_c)^(-n), equation (8)
//   I. M. Krieger and T. J. Dougherty, Trans. Soc. Rheol. 3 (1959) 137: (1 - phi/phi_c)^(-2.5 phi_c)
//   S. H. Maron and P. E. Pierce, J. Colloid Sci. 11 (1956) 80: (1 - phi/phi_c)^(-2)
//   D. G. Thomas, J. Colloid Sci. 20 (1965) 267: 1 + 2.5 phi + 10.05 phi^2 + 0.00273 exp(16.6 phi)
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace slagflow {

enum class SuspensionLaw : int { einstein_roscoe, krieger_dougherty, maron_pierce, thomas };

struct SuspensionInfo {
  const char* name;  // in the case file
  const char* formula;
  double critical_fraction;  // default of phi_c; 0: the law has none
};

inline constexpr std::array<SuspensionInfo, 4> suspension_laws{{
    {"einstein-roscoe", "(1 - phi/phi_c)^-n", 0.74},
    {"krieger-dougherty", "(1 - phi/phi_c)^(-2.5 phi_c)", 0.64},
    {"maron-pierce", "(1 - phi/phi_c)^-2", 0.64},
    {"thomas", "1 + 2.5 phi + 10.05 phi^2 + 0.00273 exp(16.6 phi)", 0},
}};

// The largest solid fraction of the measurements that Thomas fitted.
inline constexpr double thomas_limit = 0.6;

struct Suspension {
  SuspensionLaw law = SuspensionLaw::einstein_roscoe;
  double critical_fraction = 0.74;  // phi_c, where the viscosity diverges
  double exponent = 2;              // n of Einstein-Roscoe

  const SuspensionInfo& info() const { return suspension_laws[static_cast<std::size_t>(law)]; }
};

// Viscosity over that of the liquid, for 0 <= phi < phi_c.
inline double relative_viscosity(const Suspension& s, double phi) {
  const double free_share = 1 - phi / s.critical_fraction;
  switch (s.law) {
    case SuspensionLaw::krieger_dougherty:
      return std::pow(free_share, -2.5 * s.critical_fraction);
    case SuspensionLaw::maron_pierce:
      return std::pow(free_share, -2);
    case SuspensionLaw::thomas:
      return 1 + 2.5 * phi + 10.05 * phi * phi + 0.00273 * std::exp(16.6 * phi);
    default:
      return std::pow(free_share, -s.exponent);
  }
}

}  // namespace slagflow
