// Pressure part of a pair of particles: p_i + p_j + pairing_ij [Pa]. Times V_i V_j it is what goes with the
// continuity equation, which counts volumes, so that fluids of different density balance.
#pragma once

#include "backend/lanes.hpp"
#include "fluid/params.hpp"

namespace slagflow {

// pairing_ij: both signs of pressure keep a pair apart when it is closer than the spacing. T: Real or Lanes.
template <class Smoothing, class T>
HOST_DEVICE T pairing_pressure(const FlowConstants& flow, const Smoothing& smoothing, T own, T other, T r) {
  const auto close = r < T(flow.spacing);
  if (!bits(close)) return T(0);
  const T ratio = smoothing.value(r) * flow.pairing_reference;
  const T apart = flow.anti_pairing * (square(square(ratio)) - Real(1));
  return select(close, apart * (magnitude(own) + magnitude(other)), T(0));
}

template <class Smoothing, class T>
HOST_DEVICE T pair_pressure(const FlowConstants& flow, const Smoothing& smoothing, T own, T other, T r) {
  return own + other + pairing_pressure(flow, smoothing, own, other, r);
}

}  // namespace slagflow
