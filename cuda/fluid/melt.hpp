// What temperature makes of a particle's rheology.
#pragma once

#include "fluid/models.hpp"

namespace slagflow {

// Which parameter of a rheology is its yield stress, regularised or not; -1: it has none.
HOST_DEVICE inline int yield_stress_parameter(RheologyKind kind) {
  switch (kind) {
    case RheologyKind::newtonian:
    case RheologyKind::carreau_yasuda:
      return -1;
    case RheologyKind::herschel_bulkley:
      return 2;
    default:
      return 1;
  }
}

// Of a particle, as one Quad in `FluidArrays::melt`.
struct Melt {
  Real viscosity = 0;     // K(T): the first parameter of the rheology
  Real yield_stress = 0;  // [Pa]
  Real solid = 0;         // 1 or 0
  Real viscous = 0;       // [Pa s] of the viscosity, without the yield stress's part

  HOST_DEVICE explicit Melt(Quad q) : viscosity(q.x), yield_stress(q.y), solid(q.z), viscous(q.w) {}

  HOST_DEVICE bool is_solid() const { return solid > Real(0.5); }
  HOST_DEVICE Rheology of(const Rheology& r) const {
    Rheology melted = r;
    if (is_solid()) melted.kind = RheologyKind::newtonian;
    melted.parameters[0] = viscosity;
    const int k = yield_stress_parameter(melted.kind);
    if (k >= 0) melted.parameters[k] = yield_stress;
    return melted;
  }
};

}  // namespace slagflow
