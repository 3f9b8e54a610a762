// The two parts of each particle's rheology; with heat, those of its temperature.
#pragma once

#include "fluid/melt.hpp"
#include "fluid/yield_rheology.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

struct ParticleYield {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<const Quad> melt;  // empty where heat is off

  explicit ParticleYield(const PairContext& c) : fluids(c.fluids), fluid(c.fluid.fluid), melt(c.fluid.melt) {}

  // [Pa]; solid fluid has none.
  HOST_DEVICE Real stress(Index i) const {
    const Rheology& own = fluids[fluid[i]].rheology;
    if (melt.size == 0) return yield_stress(own);
    return yield_parameter(own.kind) < 0 ? Real(0) : Melt(melt[i]).yield_stress;
  }
  // [Pa s] of the part that is no yield stress.
  HOST_DEVICE Real viscous_part(Index i, Real shear_rate) const {
    if (melt.size == 0) return viscous_part_of(fluids[fluid[i]].rheology, shear_rate);
    return Melt(melt[i]).viscous;
  }
};

}  // namespace slagflow
