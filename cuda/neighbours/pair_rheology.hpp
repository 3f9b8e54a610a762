// The viscosity that acts between two particles, and how they share what it dissipates.
#pragma once

#include "fluid/lane_math.hpp"
#include "fluid/melt.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

// Share of i of the square of the strain rate of a pair in series, by the viscosities or what they grow with.
HOST_DEVICE inline Lanes own_side(Lanes own, Lanes other) { return square(Real(2) * other / (own + other)); }

// Within one fluid whose particles differ in temperature: eta = v + y, y the part of the yield stress. What
// heat does is in series, so that a crust glues no melt to itself: a crust is there or not from one particle
// to the next. The yield stress's part has the mean, as without heat: a plug does not melt at its rim.
//   eta_ij = v_ij + (y_i + y_j)/2,   v_ij = (v_i + v_j)/2 4 K_i K_j/(K_i + K_j)^2,
// K the rheology's parameter that temperature sets; where just one of the two is solid v_ij is the harmonic
// mean. Particles of one temperature have the mean of their viscosities.
struct MeltPair {
  Lanes own_viscous, other_viscous;
  Lanes series;  // own_side() of i in v

  HOST_DEVICE MeltPair(const PairContext& c, Index i, const Entries& j) {
    const Melt own(c.fluid.melt[i]);
    const QuadLanes other = gather(c.fluid.melt, j);
    own_viscous = own.viscous, other_viscous = other.w;
    const LaneMask one_solid = Lanes(Real(0.5)) < square(other.z - Lanes(own.solid));
    own_key_ = select(one_solid, own_viscous, Lanes(own.viscosity));
    other_key_ = select(one_solid, other_viscous, other.x);
    series = own_side(own_key_, other_key_);
  }
  HOST_DEVICE Lanes viscosity(Lanes own, Lanes other) const {
    const Lanes viscous = own_viscous + other_viscous;
    const Lanes in_series =
        Real(4) * (own_key_ / (own_key_ + other_key_)) * (other_key_ / (own_key_ + other_key_));
    return Real(0.5) * (viscous * in_series + ((own - own_viscous) + (other - other_viscous)));
  }

 private:
  Lanes own_key_, other_key_;
};

// Share of i of the square of the strain rate of a pair of one fluid with heat. `own` [Pa s].
HOST_DEVICE inline Lanes share_of_strain(const PairContext& c, Index i, Lanes own, const Entries& j) {
  const MeltPair pair(c, i, j);
  return (pair.own_viscous * pair.series + (own - pair.own_viscous)) / own;
}

}  // namespace slagflow
