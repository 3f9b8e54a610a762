// The viscosity that acts between two particles.
#pragma once

#include "fluid/lane_math.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

// Within a fluid the mean: then the operator dissipates exactly sum V eta gamma^2 of the shear rates (3),
// and a plug does not melt at its rim. Between two fluids the harmonic mean, which carries one stress
// through both. `own`, `other` [Pa s] of particle i and of those at `j`.
HOST_DEVICE inline Lanes pair_viscosity(const PairContext& c, Index i, Lanes own, Lanes other,
                                        const Index* j) {
  const Lanes mean = Real(0.5) * (own + other);
  if (c.fluids.size == 1) return mean;
  return select(same(c.fluid.fluid, j, c.fluid.fluid[i]), mean, own * other / mean);
}

}  // namespace slagflow
