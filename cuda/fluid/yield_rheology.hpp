// The two parts of a rheology with a yield stress.
#pragma once

#include "fluid/models.hpp"

namespace slagflow {

// Which parameter of a rheology is its yield stress; -1: it has none.
HOST_DEVICE inline int yield_parameter(RheologyKind kind) {
  if (kind == RheologyKind::bingham) return 1;
  return kind == RheologyKind::herschel_bulkley ? 2 : -1;
}

HOST_DEVICE inline Real yield_stress(const Rheology& r) {
  const int k = yield_parameter(r.kind);
  return k < 0 ? Real(0) : r.parameters[k];
}

// [Pa s] of the part that is no yield stress.
HOST_DEVICE inline Real viscous_part_of(Rheology r, Real shear_rate) {
  const int k = yield_parameter(r.kind);
  if (k >= 0) r.parameters[k] = 0;
  return viscosity(r, shear_rate);
}

}  // namespace slagflow
