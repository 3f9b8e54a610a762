// Pressure part of a pair of particles: p_i + p_j + pairing_ij [Pa]. Times V_i V_j it is what goes with the
// continuity equation, which counts volumes, so that fluids of different density balance.
#pragma once

#include "backend/lanes.hpp"
#include "fluid/params.hpp"

namespace slagflow {

// pairing_ij: both signs of pressure keep a pair apart when it is closer than the spacing. T: Real or Lanes;
// r2 is the squared distance.
template <class T>
HOST_DEVICE_INLINED T pairing_pressure(const FlowConstants& flow, T own, T other, T r2) {
  if (!(flow.anti_pairing > 0)) return T(0);
  const auto close = r2 < T(square(flow.spacing));
  if (!bits(close)) return T(0);
  const T ratio = flow.smoothing.value(r2) * flow.pairing_reference;
  const T apart = flow.anti_pairing * (square(square(ratio)) - Real(1));
  return select(close, apart * (magnitude(own) + magnitude(other)), T(0));
}

// Share of the function for tension in the continuity of fluid below zero, of this density and viscosity. All
// of it goes with the forces, and thick fluid keeps the energy; in thin fluid that splashes each pair would
// gain some whenever its pressure changes its sign.
HOST_DEVICE inline Real tension_share(const FlowConstants& flow, Real density, Real viscosity) {
  return 1 / (1 + square(flow.tension_reference * density / viscosity));
}

// (p_i + p_j) F, each pressure below zero with the slope of the function for tension instead. T: Real or
// Lanes.
template <class T>
HOST_DEVICE_INLINED T pressure_slope(const FlowConstants& flow, T own, T other, T r2) {
  const T slope = flow.smoothing.gradient(r2), both = (own + other) * slope, none = Real(0);
  if (!flow.flat_tension) return both;
  const T tension = smaller(own, none) + smaller(other, none);
  if (!bits(tension < none)) return both;
  return both + tension * (flow.smoothing.tension_gradient(r2) - slope);
}

// The same with the pairing term.
template <class T>
HOST_DEVICE_INLINED T pair_pressure_slope(const FlowConstants& flow, T own, T other, T r2) {
  return pressure_slope(flow, own, other, r2) +
         pairing_pressure(flow, own, other, r2) * flow.smoothing.gradient(r2);
}

}  // namespace slagflow
