#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/constants.hpp"
#include "fluid/smoothing/smoothing.hpp"
#include "fluid/yield_rheology.hpp"
#include "viscosity/pair_weights.hpp"

namespace slagflow {

double middle_weight(const SimulationSetup& s) {
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::min();
  for (const FluidSetup& f : s.fluids) {
    const auto eta = static_cast<double>(viscosity(f.rheology, Real(1)));  // with heat: of the hottest fluid
    if (eta > 0 && std::isfinite(eta)) least = std::min(least, eta), most = std::max(most, eta);
  }
  const double eta = least > most ? 1 : std::sqrt(least) * std::sqrt(most);
  const FlowConstants flow = flow_constants(s);
  const double volume = std::pow(s.spacing, s.dimensions);
  const auto slope = static_cast<double>(flow.smoothing.viscous(square(flow.spacing)));
  return stable_time_step(s) * static_cast<double>(flow.operator_factor) * volume * volume * eta * slope;
}

double short_weight_unit(double middle) {
  constexpr int below_top = 33, top = -63;  // exponents
  constexpr int least = -120, most = 120;   // of what single precision holds, and one over it
  int exponent = 0;
  std::frexp(middle, &exponent);
  return std::ldexp(1.0, std::clamp(exponent + below_top - top, least, most));
}

}  // namespace slagflow
