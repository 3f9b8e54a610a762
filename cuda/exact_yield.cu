#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "exact_yield.hpp"
#include "lane_math.hpp"
#include "smoothing/lucy.hpp"

namespace slagflow {

namespace {

constexpr Real over_relaxation = Real(1.6);

// Which parameter of a rheology is its yield stress; -1: it has none.
HOST_DEVICE inline int yield_parameter(RheologyKind kind) {
  if (kind == RheologyKind::bingham) return 1;
  return kind == RheologyKind::herschel_bulkley ? 2 : -1;
}

HOST_DEVICE inline Real yield_stress(const Rheology& r) {
  const int k = yield_parameter(r.kind);
  return k < 0 ? Real(0) : r.parameters[k];
}

HOST_DEVICE inline Real held_share(Real stress_squared, Real yield) {
  return stress_squared > square(yield) ? yield / std::sqrt(stress_squared) : Real(1);
}

// [Pa s] of the part that is no yield stress.
HOST_DEVICE inline Real viscous_part_of(Rheology r, Real shear_rate) {
  const int k = yield_parameter(r.kind);
  if (k >= 0) r.parameters[k] = 0;
  return viscosity(r, shear_rate);
}

struct ViscousPart {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<const Real> shear_rate;
  Span<const Quad> from;
  Span<Quad> state;
  HOST_DEVICE void operator()(Index i) const {
    const Quad s = from[i];
    state[i] = {s.x, viscous_part_of(fluids[fluid[i]].rheology, shear_rate[i]), s.z, s.w};
  }
};

// The pairs of one particle, with the root of C (d+2) |F| / r^2 for each.
template <class Smoothing, class Box>
struct PairLoop {
  PairContext c;
  Smoothing smoothing;
  Box box;

  // visit(at, j, root of the volumes V_j, d, root)
  template <class Visit>
  HOST_DEVICE void over_fluid(Index i, Visit visit) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    const Offset first = c.fluid_list.row(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Offset at = first + k * ListView::stride();
      const Index* j = &c.fluid_list.entry[at];
      const QuadLanes there = gather(c.fluid.place, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      const Lanes weight = (-c.flow.shear_factor * smoothing.gradient(root(r2))) / (r2 + c.flow.softening);
      visit(at, j, there.w, d, select(near, root(weight), Lanes(0)));
    }
  }

  // visit(at, velocity of the wall, d, g) for the pairs that stick.
  template <class Visit>
  HOST_DEVICE void over_walls(Index i, Visit visit) const {
    const Vec3 x = xyz(c.fluid.place[i]);
    const Offset first = c.wall_list.row(i);
    for (Index k = 0; k < c.wall_list.length[i]; ++k) {
      const Offset at = first + k * ListView::stride();
      const Index j = c.wall_list.entry[at];
      const Vec3 d = box.separation(x, xyz(c.wall.place[j]));
      const Real r2 = dot(d, d);
      const Quad motion = c.wall.velocity[j];
      Real g = 0;
      if (r2 < square(c.flow.support) && motion.w >= 0) {
        const Real stick = no_slip_factor(WallPairGeometry<Real, Quad>{d, c.wall.normal[j], c.wall.back[j]},
                                          c.flow.spacing, motion.w);
        g = wall_strain_factor(c.flow, stick, smoothing.gradient(std::sqrt(r2)), r2);
      }
      visit(at, xyz(motion), d, g);
    }
  }
};

template <class Smoothing, class Box>
struct AddForce {
  PairLoop<Smoothing, Box> loop;
  Span<const Real> own, other, wall, held;
  Real dt;
  Span<const Quad> base;
  Span<Quad> result;

  HOST_DEVICE void operator()(Index i) const {
    const Real volume = loop.c.fluid.place[i].w, share = 2 * held[i] - 1;
    const Lanes own_factor = volume * share, root_volume = std::sqrt(volume);
    LaneVec3 sum;
    loop.over_fluid(i, [&](Offset at, const Index* j, Lanes their, LaneVec3 d, Lanes g) {
      const Lanes other_factor = their * (Real(2) * gather(held, j) - Real(1));
      const Lanes stress = own_factor * (root(their) * load_lanes(&own[at])) +
                           other_factor * (root_volume * load_lanes(&other[at]));
      sum += (g * stress) * d;
    });
    Vec3 walls;
    loop.over_walls(i, [&](Offset at, Vec3, Vec3 d, Real g) { walls += (g * share * wall[at]) * d; });
    result[i] = quad(xyz(base[i]) - dt * (total(sum) + volume * walls), 0);
  }
};

template <class Smoothing, class Box>
struct Update {
  PairLoop<Smoothing, Box> loop;
  Span<const Quad> velocity;
  Span<const Real> held;
  Span<Real> own, other, wall, new_held;
  Span<double> gap, change, shear;

  HOST_DEVICE static Real kept(Real f) { return f + (1 - over_relaxation) * (1 - f); }

  HOST_DEVICE void operator()(Index i) const {
    const Vec3 u = xyz(velocity[i]);
    const LaneVec3 here = in_lanes(u);
    const Real augmentation = loop.c.flow.augmentation, step = over_relaxation * augmentation;
    const Real keep = kept(held[i]), root_volume = std::sqrt(loop.c.fluid.place[i].w);
    Lanes pp = 0, pg = 0, gg = 0, po = 0, oo = 0;
    loop.over_fluid(i, [&](Offset at, const Index* j, Lanes their, LaneVec3 d, Lanes g) {
      const Lanes rate = g * dot(here - xyz(gather(velocity, j)), d), mine = rate * root(their);
      const Lanes their_held = gather(held, j);
      const Lanes their_keep = their_held + (1 - over_relaxation) * (Lanes(1) - their_held);
      const LaneMask near = g > Lanes(0);
      const Lanes old = select(near, load_lanes(&own[at]), Lanes(0)), p = keep * old + step * mine;
      const Lanes q =
          select(near, their_keep * load_lanes(&other[at]) + step * (rate * root_volume), Lanes(0));
      store_lanes(&own[at], p), store_lanes(&other[at], q);
      pp += p * p, pg += p * mine, gg += mine * mine, po += p * old, oo += old * old;
    });
    Real stress = total(pp), work = total(pg), rates = total(gg), both = total(po), before = total(oo);
    loop.over_walls(i, [&](Offset at, Vec3 there, Vec3 d, Real g) {
      const Real rate = g * dot(u - there, d);
      const Real old = g > 0 ? wall[at] : Real(0), p = keep * old + step * rate;
      wall[at] = p;
      stress += p * p, work += p * rate, rates += rate * rate, both += p * old, before += old * old;
    });
    const Rheology& r = loop.c.fluids[loop.c.fluid.fluid[i]].rheology;
    const Real f = held_share(stress, yield_stress(r)), sheared = (1 - f) / augmentation,
               last = (1 - held[i]) / augmentation;
    new_held[i] = f;
    gap[i] = larger(0.0, static_cast<double>(rates - 2 * sheared * work + square(sheared) * stress));
    change[i] = larger(0.0, static_cast<double>(square(sheared) * stress - 2 * sheared * last * both +
                                                square(last) * before));
    shear[i] = static_cast<double>(rates);
  }
};

// p for another augmentation, `ratio` times the old one: the stress f p stays, and the sheared strain rate.
struct Rescale {
  ListView fluid_list, wall_list;
  Span<const Real> held;
  Real ratio;
  Span<Real> own, other, wall, new_held;

  HOST_DEVICE Real factor(Real f) const { return f + ratio * (1 - f); }

  HOST_DEVICE void operator()(Index i) const {
    const Real mine = factor(held[i]);
    const Offset first = fluid_list.row(i), first_wall = wall_list.row(i);
    for (Index k = 0; k < fluid_list.length[i]; ++k) {
      const Offset at = first + k * ListView::stride();
      own[at] *= mine, other[at] *= factor(held[fluid_list.entry[at]]);
    }
    for (Index k = 0; k < wall_list.length[i]; ++k) wall[first_wall + k * ListView::stride()] *= mine;
    new_held[i] = held[i] / mine;
  }
};

struct StressLength {
  ListView fluid_list, wall_list;
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<const Real> own, wall, held, shear_rate;
  Span<Real> result;
  HOST_DEVICE void operator()(Index i) const {
    Real squares = 0;
    for (Index k = 0; k < fluid_list.length[i]; ++k)
      squares += square(own[fluid_list.row(i) + k * ListView::stride()]);
    for (Index k = 0; k < wall_list.length[i]; ++k)
      squares += square(wall[wall_list.row(i) + k * ListView::stride()]);
    const Real viscous = viscous_part_of(fluids[fluid[i]].rheology, shear_rate[i]) * shear_rate[i];
    result[i] = held[i] * std::sqrt(squares) + viscous;
  }
};

template <class Run>
void with_box(const PairContext& c, Run run) {
  const Lucy smoothing(c.flow.support, c.flow.dimensions);
  if (c.box.any())
    run(PairLoop<Lucy, PeriodicBox>{c, smoothing, c.box});
  else
    run(PairLoop<Lucy, OpenBox>{c, smoothing, {}});
}

}  // namespace

ExactYield::ExactYield(Context& c)
    : context_(c),
      own_(c, "yield stresses"),
      other_(c, "yield stresses"),
      wall_(c, "yield stresses of walls"),
      held_(c, "held shares"),
      spare_own_(c, "yield stresses"),
      spare_other_(c, "yield stresses"),
      spare_wall_(c, "yield stresses of walls"),
      spare_held_(c, "held shares"),
      state_(c, "viscous states"),
      gap_(c, "yield sums"),
      change_(c, "yield sums"),
      shear_(c, "yield sums"),
      row_of_id_(c, "rows of ids"),
      fluid_layout_(c, "yield pairs"),
      wall_layout_(c, "yield pairs of walls") {}

void ExactYield::begin(const PairContext& c, const FluidArrays& fluid, Real augmentation) {
  const Index n = c.fluid.count;
  if (augmentation_ > 0 && augmentation != augmentation_) {
    spare_held_.resize(n);
    launch(context_, "rescale yield stresses", n,
           Rescale{c.fluid_list, c.wall_list, held_.span(), augmentation / augmentation_, own_.span(),
                   other_.span(), wall_.span(), spare_held_.span()});
    held_.swap(spare_held_);
  }
  augmentation_ = augmentation;
  state_.resize(n);
  launch(context_, "viscous part", n,
         ViscousPart{c.fluids, c.fluid.fluid, fluid.shear_rate.span(), c.fluid.state, state_.span()});
}

PairContext ExactYield::viscous_part(const PairContext& c) const {
  PairContext result = c;
  result.fluid.state = state_.span();
  result.flow.augmentation = augmentation_;
  return result;
}

void ExactYield::add_force(const PairContext& c, Real dt, Span<const Quad> base, Span<Quad> force) {
  with_box(c, [&](const auto& loop) {
    launch(context_, "yield forces", c.fluid.count,
           AddForce<decltype(loop.smoothing), decltype(loop.box)>{
               loop, own_.span(), other_.span(), wall_.span(), held_.span(), dt, base, force});
  });
}

void ExactYield::measure_stress(const PairContext& c, Span<const Real> shear_rate, Span<Real> result) {
  launch(context_, "shear stress", c.fluid.count,
         StressLength{c.fluid_list, c.wall_list, c.fluids, c.fluid.fluid, own_.span(), wall_.span(),
                      held_.span(), shear_rate, result});
}

ExactYield::Rates ExactYield::update(const PairContext& c, Span<const Quad> velocity) {
  const Index n = c.fluid.count;
  gap_.resize(n), change_.resize(n), shear_.resize(n), spare_held_.resize(n);
  with_box(c, [&](const auto& loop) {
    launch(context_, "yield stresses", n,
           Update<decltype(loop.smoothing), decltype(loop.box)>{
               loop, velocity, held_.span(), own_.span(), other_.span(), wall_.span(), spare_held_.span(),
               gap_.span(), change_.span(), shear_.span()});
  });
  held_.swap(spare_held_);
  auto rms = [&](Buffer<double>& v) { return std::sqrt(sum(context_, v.span()) / n); };
  return {rms(gap_), rms(change_), rms(shear_)};
}

void ExactYield::balance(double gap, double change) {
  constexpr double factor = 1.5, least = 0.3, most = 100;
  balanced_ = gap > change ? smaller(most, factor * balanced_) : larger(least, balanced_ / factor);
}

}  // namespace slagflow
