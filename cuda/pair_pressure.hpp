// Pressure part of a pair of particles.
#pragma once

#include "backend/lanes.hpp"
#include "params.hpp"

namespace slagflow {

// p_i/rho_i^2 + p_j/rho_j^2 + pairing_ij of two particles at distance r; both signs of pressure keep a pair
// apart when it is closer than the spacing. T: Real or Lanes.
template <class Smoothing, class T>
HOST_DEVICE T pair_pressure(const FlowConstants& flow, const Smoothing& smoothing, T own, T other, T r) {
  const T sum = own + other;
  const auto close = r < T(flow.spacing);
  if (!bits(close)) return sum;
  const T ratio = smoothing.value(r) * flow.pairing_reference;
  const T apart = flow.anti_pairing * (square(square(ratio)) - Real(1));
  return sum + select(close, apart * (magnitude(own) + magnitude(other)), T(0));
}

// p/rho^2 of a wall particle of the given pressure, to a fluid of the given density at rest.
HOST_DEVICE inline Real wall_pressure_share(const FlowConstants& flow, Real pressure, Real rest_density) {
  return pressure / square(rest_density + pressure / flow.sound_speed_squared);
}

}  // namespace slagflow
