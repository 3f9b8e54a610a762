// Pressure part of a pair of particles: p_i + p_j + pairing_ij [Pa]. Times V_i V_j it is what goes with the
// continuity equation, which counts volumes, so that fluids of different density balance.
#pragma once

#include "backend/lanes.hpp"
#include "fluid/params.hpp"

namespace slagflow {

// pairing_ij: both signs of pressure keep a pair apart when it is closer than the spacing. T: Real or Lanes;
// r2 is the squared distance.
template <class T>
HOST_DEVICE T pairing_pressure(const FlowConstants& flow, T own, T other, T r2) {
  if (!(flow.anti_pairing > 0)) return T(0);
  const auto close = r2 < T(square(flow.spacing));
  if (!bits(close)) return T(0);
  const T ratio = flow.smoothing.value(r2) * flow.pairing_reference;
  const T apart = flow.anti_pairing * (square(square(ratio)) - Real(1));
  return select(close, apart * (magnitude(own) + magnitude(other)), T(0));
}

// Share that the function for tension has below zero, of fluid of this density and viscosity. All of it
// spreads thick fluid instead of clumping it; in thin fluid that splashes each pair would gain energy
// whenever its pressure changes its sign. T: Real or Lanes.
template <class T>
HOST_DEVICE T tension_share(const FlowConstants& flow, T density, T viscosity) {
  const T ratio = flow.tension_reference * density / viscosity;
  return Real(1) / (T(1) + square(ratio));
}

// A pressure, and the share of its slope that the function for tension has.
template <class T>
struct PressureSide {
  T pressure, in_tension;
};

// Of a particle: pressure, viscosity, volume, mass.
template <class T, class State>  // Real and Quad, or Lanes and QuadLanes
HOST_DEVICE PressureSide<T> pressure_side(const FlowConstants& flow, const State& s) {
  if (!flow.flat_tension || !bits(s.x < T(0))) return {s.x, T(0)};
  return {s.x, tension_share<T>(flow, s.w / s.z, s.y)};
}

// p_i F + p_j F, of pressures below zero with the share of the function for tension.
template <class T>
HOST_DEVICE T pressure_slope(const FlowConstants& flow, const PressureSide<T>& own,
                             const PressureSide<T>& other, T r2) {
  const T slope = flow.smoothing.gradient(r2), none = Real(0);
  const T both = (own.pressure + other.pressure) * slope;
  if (!flow.flat_tension) return both;
  const T tension =
      smaller(own.pressure, none) * own.in_tension + smaller(other.pressure, none) * other.in_tension;
  if (!bits(tension < none)) return both;
  return both + tension * (flow.smoothing.tension_gradient(r2) - slope);
}

// The same with the pairing term.
template <class T>
HOST_DEVICE T pair_pressure_slope(const FlowConstants& flow, const PressureSide<T>& own,
                                  const PressureSide<T>& other, T r2) {
  return pressure_slope(flow, own, other, r2) +
         pairing_pressure(flow, own.pressure, other.pressure, r2) * flow.smoothing.gradient(r2);
}

}  // namespace slagflow
