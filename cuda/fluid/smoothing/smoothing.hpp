// The table of smoothing functions. A new one is a header here and one entry in the three places below.
#pragma once

#include <array>

#include "fluid/smoothing/level.hpp"
#include "fluid/smoothing/lucy.hpp"
#include "fluid/smoothing/quintic_spline.hpp"
#include "fluid/smoothing/wendland.hpp"

namespace slagflow {

enum class SmoothingKind : int { level, lucy, wendland_c2, wendland_c4, quintic_spline };
inline constexpr std::array<const char*, 5> smoothing_names{"level", "lucy", "wendland-c2", "wendland-c4",
                                                            "quintic-spline"};

// What weights the velocity differences of the viscous operator, w: LatticeWeight, A W, or -F/r^2 as in
// equation (2), of which a lattice sees more or less than the viscosity, by its direction.
enum class ViscousWeight : int { lattice, value, gradient };

// Calls f with the law as its own type.
template <class F>
HOST_DEVICE auto visit(SmoothingKind kind, F f) {
  switch (kind) {
    case SmoothingKind::lucy:
      return f(Lucy());
    case SmoothingKind::wendland_c2:
      return f(WendlandC2());
    case SmoothingKind::wendland_c4:
      return f(WendlandC4());
    case SmoothingKind::quintic_spline:
      return f(QuinticSpline());
    default:
      return f(Level());
  }
}

// A law with its support radius, as the device bodies use it; all its sums are zero from the support on. T:
// Real or Lanes; r2 is the squared distance.
struct Smoothing {
  SmoothingKind kind = SmoothingKind::level;
  ViscousWeight viscous_weight = ViscousWeight::lattice;
  Real support = 0;          // h [m]
  Real inverse_squared = 0;  // 1/h^2
  Real of_value = 0;         // sigma / h^d
  Real of_slope = 0;         // sigma / h^(d+2)
  Real of_tension = 0;       // -24 s / h^(d+2), of tension_gradient()
  Real of_crowding = 0;      // -36 s / h^(d+2), of crowding_gradient()
  Real of_viscous = 0;       // 1 / (h^(d+4) (d + 2) integral of w x^2 y^2), in units of h
  Real softening = 0;        // 1e-6 h^2 [m^2], keeps coincident pairs finite

  Smoothing() = default;
  Smoothing(SmoothingKind which, double h, int dimensions, ViscousWeight weight = ViscousWeight::lattice);

  // W [1/m^2, 1/m^3], zero from the support on.
  template <class T>
  HOST_DEVICE T value(T r2) const {
    return of_value * law_value(r2);
  }
  // F = (1/r) dW/dr, so that grad W = F x_ij. Finite at r = 0.
  template <class T>
  HOST_DEVICE T gradient(T r2) const {
    const T q2 = within(r2);
    return of_slope * visit(kind, [=](auto law) { return decltype(law)::slope(q2); });
  }
  // F of s (4 t^3 - 3 t^4), t = 1 - (r/h)^2, whatever the law: flat about r = 0, its Fourier transform is
  // negative for waves of two spacings, so that particles under tension spread instead of clumping.
  template <class T>
  HOST_DEVICE T tension_gradient(T r2) const {
    const T q2 = within(r2);
    return of_tension * square(T(1) - q2) * q2;
  }
  // F of s t^18, t = 1 - (r/h)^2, whatever the law: little but the nearest neighbours count.
  template <class T>
  HOST_DEVICE T crowding_gradient(T r2) const {
    const T t = T(1) - within(r2), t4 = square(square(t));
    return of_crowding * square(square(t4)) * t;
  }
  // w >= 0 with (d + 2) times the integral of w x^2 y^2 = 1 [1/m^(d+4)].
  template <class T>
  HOST_DEVICE T viscous(T r2) const {
    if (viscous_weight == ViscousWeight::gradient) return -gradient(r2) / (r2 + softening);
    if (viscous_weight == ViscousWeight::value) return of_viscous * law_value(r2);
    return of_viscous * LatticeWeight::value(within(r2));
  }

 private:
  // q^2; beyond the support that of its edge, where every law vanishes: polynomials would grow to infinity.
  template <class T>
  HOST_DEVICE T within(T r2) const {
    return smaller(r2 * inverse_squared, T(1));
  }
  template <class T>
  HOST_DEVICE T law_value(T r2) const {
    const T q2 = within(r2);
    return visit(kind, [=](auto law) { return decltype(law)::value(q2); });
  }
};

// The integral of W r^n over the support, for a support of 1: 1 for n = 0.
double moment(SmoothingKind, int dimensions, int n);

}  // namespace slagflow
