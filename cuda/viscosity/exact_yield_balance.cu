// The augmentation of each particle, balanced against the flow.
#include "backend/launch.hpp"
#include "viscosity/exact_yield.hpp"
#include "viscosity/particle_yield.hpp"

namespace slagflow {

namespace {

// The augmentation that suits a particle is tau / q, its stress over its sheared strain rate: then f is a
// half. A plug takes the most, which in sheared fluid would hold back the velocities.
struct Balance {
  ParticleYield yield;
  Span<const Real> held, last;
  Real last_unit;
  Augmentation given;
  Span<Real> relative, augmentation;

  HOST_DEVICE Real balanced(Real before, Real f) const {
    constexpr Real least = Real(0.3), most_sheared = 3, most = 100;
    const Real kept = before > 0 ? before : Real(1), bound = given.largest_factor;
    const Real wanted = f < 1 ? smaller(most_sheared, kept * (last_unit / given.unit) * f / (1 - f)) : most;
    return larger(least, smaller(most, larger(kept / bound, smaller(kept * bound, wanted))));
  }
  HOST_DEVICE void operator()(Index i) const {
    const bool yields = yield.stress(i) > 0;
    const Real own = given.fixed > 0 ? given.fixed : balanced(last[i], held[i]);
    relative[i] = yields ? own : Real(0);
    augmentation[i] = relative[i] * given.unit;
  }
};

// The viscosity without the yield stress, plus the augmentation.
struct Augment {
  ParticleYield yield;
  Span<const Real> shear_rate, augmentation;
  Span<const Quad> from;
  Span<Quad> state;
  HOST_DEVICE void operator()(Index i) const {
    const Quad s = from[i];
    state[i] = {s.x, yield.viscous_part(i, shear_rate[i]) + augmentation[i], s.z, s.w};
  }
};

// p for other augmentations: the stress f p stays, and the sheared strain rate. Where a yield stress has
// gone, as where fluid melts, nothing stays.
struct Rescale {
  ListView fluid_list, wall_list;
  Span<const Real> held, last, augmentation;
  Real last_unit;
  Span<Real> own, other, wall, new_held;

  HOST_DEVICE Real factor(Index i) const {
    if (!(augmentation[i] > 0)) return 0;
    const Real before = last[i] * last_unit;
    return before > 0 ? held[i] + (augmentation[i] / before) * (1 - held[i]) : Real(1);
  }

  HOST_DEVICE void operator()(Index i) const {
    const Real mine = factor(i);
    const ListRow row = fluid_list.entries(i);
    const Offset first_wall = wall_list.row(i);
    for (Index k = 0; k < fluid_list.length[i]; ++k) {
      const Offset at = row.at(k);
      own[at] *= mine, other[at] *= factor(row.one(k));
    }
    for (Index k = 0; k < wall_list.length[i]; ++k) wall[first_wall + k * ListView::stride()] *= mine;
    new_held[i] = mine > 0 ? held[i] / mine : Real(0);
  }
};

}  // namespace

void ExactYield::begin(const PairContext& c, const FluidArrays& fluid, const Augmentation& given) {
  const Index n = c.fluid.count;
  spare_held_.resize(n), spare_relative_.resize(n), augmentations_.resize(n), state_.resize(n);
  launch(context_, "balance", n,
         Balance{ParticleYield(c), held_.span(), relative_.span(), unit_, given, spare_relative_.span(),
                 augmentations_.span()});
  launch(context_, "rescale yield stresses", n,
         Rescale{c.fluid_list, c.wall_list, held_.span(), relative_.span(), augmentations_.span(), unit_,
                 own_.span(), other_.span(), wall_.span(), spare_held_.span()});
  held_.swap(spare_held_), relative_.swap(spare_relative_);
  unit_ = given.unit;
  launch(context_, "augmented viscosity", n,
         Augment{ParticleYield(c), fluid.shear_rate.span(), augmentations_.span(), c.fluid.state,
                 state_.span()});
}

PairContext ExactYield::augmented(const PairContext& c) const {
  PairContext result = c;
  result.fluid.state = state_.span();
  return result;
}

}  // namespace slagflow
