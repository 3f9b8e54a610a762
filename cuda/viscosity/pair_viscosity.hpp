// The viscosity that acts between two particles.
#pragma once

#include "fluid/lane_math.hpp"
#include "neighbours/pair_rheology.hpp"

namespace slagflow {

// Within a fluid the mean: then the operator dissipates exactly sum V eta gamma^2 of the shear rates (3),
// and a plug does not melt at its rim. Between two fluids the harmonic mean, which carries one stress
// through both. Where temperatures differ see MeltPair. `own`, `other` [Pa s] of particle i and of those at
// `j`.
HOST_DEVICE inline Lanes pair_viscosity(const PairContext& c, Index i, Lanes own, Lanes other,
                                        const Entries& j) {
  const Lanes mean = Real(0.5) * (own + other);
  const Lanes within = c.fluid.melt.size > 0 ? MeltPair(c, i, j).viscosity(own, other) : mean;
  if (c.fluids.size == 1) return within;
  return select(same(c.fluid.fluid, j, c.fluid.fluid[i]), within, own * other / mean);
}

}  // namespace slagflow
