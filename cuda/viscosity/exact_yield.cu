#include <limits>

#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "fluid/lane_math.hpp"
#include "viscosity/exact_yield.hpp"
#include "viscosity/particle_yield.hpp"

namespace slagflow {

namespace {

constexpr Real over_relaxation = Real(1.6);

HOST_DEVICE inline Real held_share(Real stress_squared, Real yield) {
  return stress_squared > square(yield) ? yield / std::sqrt(stress_squared) : Real(1);
}

// How a pair of two fluids shares what it carries: one stress in both halves, whose shear rates differ. With
// the stiffness k = eta + a of its particles the halves have the shares 2 k_j / (k_i + k_j) of the shear rate
// and of the force of the stresses s, and slip by (s_j - s_i) / (k_i + k_j).
struct Halves {
  Lanes own = 1, other = 1, slip = 0;
};

// The pairs of one particle, with the root of C (d+2) w for each.
template <class Box>
struct PairLoop {
  PairContext c;
  Box box;

  // visit(at, j, V_j, direction of the viscous force, root)
  template <class Visit>
  HOST_DEVICE void over_fluid(Index i, Visit visit) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Offset at = row.at(k);
      const Entries j = row[k];
      const QuadLanes there = gather(c.fluid.place, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      const Lanes weight = c.flow.shear_factor * c.flow.smoothing.viscous(r2);
      visit(at, j, there.w, d, select(near, root(weight), Lanes(0)));
    }
  }

  HOST_DEVICE Halves halves(Index i, const Entries& j) const {
    Halves h;
    if (c.fluids.size == 1) return h;
    const Lanes own = c.fluid.state[i].y, other = gather(c.fluid.state, j).y, one = 1;
    const LaneMask alike = same(c.fluid.fluid, j, c.fluid.fluid[i]);
    h.slip = select(alike, Lanes(0), one / (own + other));
    h.own = select(alike, one, Real(2) * other * h.slip),
    h.other = select(alike, one, Real(2) * own * h.slip);
    return h;
  }

  // visit(at, velocity of the wall, d, g) for the pairs that stick.
  template <class Visit>
  HOST_DEVICE void over_walls(Index i, Visit visit) const {
    const Vec3 x = xyz(c.fluid.place[i]);
    const ListRow row = c.wall_list.entries(i);
    for (Index k = 0; k < c.wall_list.length[i]; ++k) {
      const Offset at = row.at(k);
      const Index j = row.one(k);
      const Vec3 d = box.separation(x, xyz(c.wall.place[j]));
      const Real r2 = dot(d, d);
      const Quad motion = c.wall.velocity[j];
      Real g = 0;
      if (r2 < square(c.flow.support) && motion.w >= 0) {
        const Real stick = no_slip_factor(WallPairGeometry<Real, Quad>{d, c.wall.normal[j], c.wall.back[j]},
                                          c.flow.spacing, motion.w);
        g = wall_strain_factor(c.flow, stick, c.flow.smoothing.viscous(r2));
      }
      visit(at, xyz(motion), d, g);
    }
  }
};

// The forces -dt F of the stresses between pairs.
template <class Box>
struct YieldForces {
  PairLoop<Box> loop;
  Span<const Real> own, other, wall, held;

  // visit(j, d, F)
  template <class Visit>
  HOST_DEVICE void over_fluid(Index i, Visit visit) const {
    const Real volume = loop.c.fluid.place[i].w, share = 2 * held[i] - 1;
    const Lanes own_factor = volume * share, root_volume = std::sqrt(volume);
    loop.over_fluid(i, [&](Offset at, const Entries& j, Lanes their, LaneVec3 d, Lanes g) {
      const Halves half = loop.halves(i, j);
      const Lanes other_factor = their * (Real(2) * gather(held, j) - Real(1));
      const Lanes stress = half.own * own_factor * (root(their) * load_lanes(&own[at])) +
                           half.other * other_factor * (root_volume * load_lanes(&other[at]));
      visit(j, (g * stress) * d);
    });
  }
  // visit(velocity of the wall, F)
  template <class Visit>
  HOST_DEVICE void over_walls(Index i, Visit visit) const {
    const Real volume = loop.c.fluid.place[i].w, share = 2 * held[i] - 1;
    loop.over_walls(
        i, [&](Offset at, Vec3 there, Vec3 d, Real g) { visit(there, (volume * g * share * wall[at]) * d); });
  }
};

// w of the result: the size of what was added up, for its rounding.
template <class Box>
struct AddForce {
  YieldForces<Box> forces;
  Real dt;
  Span<const Quad> base;
  Span<Quad> result;

  HOST_DEVICE void operator()(Index i) const {
    LaneVec3 sum;
    Lanes squares = 0;
    forces.over_fluid(i, [&](const Entries&, LaneVec3 force) { sum += force, squares += dot(force, force); });
    Vec3 walls;
    Real wall_squares = 0;
    forces.over_walls(i, [&](Vec3, Vec3 force) { walls += force, wall_squares += dot(force, force); });
    const Real size = dt * std::sqrt(total(squares) + wall_squares);
    result[i] = quad(xyz(base[i]) - dt * (total(sum) + walls), size);
  }
};

// What these forces take of the motion: by pairs dt F.(u + u*)_ij/2, half to each, at walls whole.
template <class Box>
struct WorkOfYield {
  YieldForces<Box> forces;
  Real dt;
  Span<const Quad> predicted, solved;
  Span<double> result;  // [J]

  HOST_DEVICE void operator()(Index i) const {
    const Vec3 mean = Real(0.5) * (xyz(predicted[i]) + xyz(solved[i]));
    Lanes sum = 0;
    forces.over_fluid(i, [&](const Entries& j, LaneVec3 force) {
      const LaneVec3 there = Lanes(Real(0.5)) * (xyz(gather(predicted, j)) + xyz(gather(solved, j)));
      sum += dot(force, in_lanes(mean) - there);
    });
    Real walls = 0;
    forces.over_walls(i, [&](Vec3 there, Vec3 force) { walls += dot(force, mean - there); });
    result[i] = static_cast<double>(dt) * static_cast<double>(Real(0.5) * total(sum) + walls);
  }
};

// The velocities as u* and what the solve adds to it: their differences keep the digits that a common speed
// would take from those of the sum.
struct Velocities {
  Span<const Quad> predicted, increment;
  HOST_DEVICE LaneVec3 predicted_difference(Index i, const Entries& j) const {
    return in_lanes(xyz(predicted[i])) - xyz(gather(predicted, j));
  }
  HOST_DEVICE LaneVec3 increment_difference(Index i, const Entries& j) const {
    return in_lanes(xyz(increment[i])) - xyz(gather(increment, j));
  }
};

// Sums over the entries of a row: of p, of G u, of what d is between G u and the last (1 - f)/a of p, so that
// small differences keep their digits; and the squared size of the terms of G u.
template <class T>
struct RowSums {
  T pp = 0, gg = 0, dd = 0, dp = 0, size = 0;
  HOST_DEVICE void add(T p, T rate, T last) {
    const T d = rate - last * p;
    pp += p * p, gg += rate * rate, dd += d * d, dp += d * p;
  }
};

HOST_DEVICE inline RowSums<Real> sum_of(const RowSums<Lanes>& a, const RowSums<Real>& b) {
  return {total(a.pp) + b.pp, total(a.gg) + b.gg, total(a.dd) + b.dd, total(a.dp) + b.dp,
          total(a.size) + b.size};
}

template <class Box>
struct Update {
  PairLoop<Box> loop;
  ParticleYield yield;
  Velocities velocity;
  Span<const Real> held, augmentation;
  Span<Real> own, other, wall, new_held;
  Chords chords;
  Real scale;  // a velocity for a stress [m/(s Pa)]
  Span<double> gap, shear, rounding, stress;

  template <class T>
  HOST_DEVICE static T kept(T f) {
    return f + T(1 - over_relaxation) * (T(1) - f);
  }

  HOST_DEVICE Real sheared(Index i, Real f) const {
    return augmentation[i] > 0 ? (1 - f) / augmentation[i] : Real(0);
  }

  HOST_DEVICE Lanes along_chord(Index i, const Entries& j) const {
    if (!(chords.turn > 0)) return 0;
    return chords.added(in_lanes(xyz(chords.velocity[i])) - xyz(gather(chords.velocity, j)));
  }

  HOST_DEVICE RowSums<Lanes> fluid_row(Index i) const {
    const Real volume = loop.c.fluid.place[i].w, share = 2 * held[i] - 1;
    const Lanes keep = kept(held[i]), step = over_relaxation * augmentation[i],
                root_volume = std::sqrt(volume), last = sheared(i, held[i]);
    RowSums<Lanes> sums;
    loop.over_fluid(i, [&](Offset at, const Entries& j, Lanes their, LaneVec3 d, Lanes g) {
      const LaneVec3 before = velocity.predicted_difference(i, j),
                     added = velocity.increment_difference(i, j);
      const Halves half = loop.halves(i, j);
      const Lanes their_held = gather(held, j), their_step = over_relaxation * gather(augmentation, j);
      const LaneMask near = g > Lanes(0);
      const Lanes old = select(near, load_lanes(&own[at]), Lanes(0));
      const Lanes their_old = select(near, load_lanes(&other[at]), Lanes(0));
      const Lanes rate = g * ((dot(before, d) + dot(added, d)) + along_chord(i, j)), root_their = root(their);
      // As entries of either row: the stress of one half is that of the other after the slip.
      const Lanes ratio = root_their / root_volume, own_stress = share * old,
                  their_stress = (Real(2) * their_held - Real(1)) * their_old;
      const Lanes mine = half.own * rate * root_their + half.slip * (ratio * their_stress - own_stress);
      const Lanes theirs = half.other * rate * root_volume + half.slip * (own_stress / ratio - their_stress);
      const Lanes p = keep * old + step * mine;
      store_lanes(&own[at], p);
      store_lanes(&other[at], kept(their_held) * their_old + their_step * theirs);
      sums.add(p, mine, last);
      sums.size += square(g) * their * dot(d, d) * (dot(before, before) + dot(added, added));
    });
    return sums;
  }

  HOST_DEVICE RowSums<Real> wall_row(Index i) const {
    const Vec3 predicted = xyz(velocity.predicted[i]), added = xyz(velocity.increment[i]);
    const Real keep = kept(held[i]), step = over_relaxation * augmentation[i], last = sheared(i, held[i]);
    RowSums<Real> sums;
    loop.over_walls(i, [&](Offset at, Vec3 there, Vec3 d, Real g) {
      const Vec3 before = predicted - there;
      const Real rate = g * (dot(before, d) + dot(added, d));
      const Real old = g > 0 ? wall[at] : Real(0), p = keep * old + step * rate;
      wall[at] = p;
      sums.add(p, rate, last);
      sums.size += square(g) * dot(d, d) * (dot(before, before) + dot(added, added));
    });
    return sums;
  }

  // What a strain rate counts as [m]: a of it as a stress. With heat a crust creeps for ever, at rates that
  // are nothing as velocities over a spacing, while the stresses of a plug at its side would take thousands
  // of iterations to yield.
  HOST_DEVICE Real velocity_over_rate(Index i) const {
    const Real as_stress = scale * augmentation[i];
    return loop.c.fluid.melt.size > 0 ? smaller(as_stress, loop.c.flow.spacing) : as_stress;
  }

  HOST_DEVICE void operator()(Index i) const {
    const RowSums<Real> row = sum_of(fluid_row(i), wall_row(i));
    if (augmentation[i] == 0) {  // a fluid without a yield stress has nothing to agree upon
      new_held[i] = 0, gap[i] = shear[i] = rounding[i] = stress[i] = 0;
      return;
    }
    const Real f = held_share(row.pp, yield.stress(i));
    const Real more = sheared(i, f) - sheared(i, held[i]);
    new_held[i] = f;
    const double unit = square(static_cast<double>(velocity_over_rate(i)));
    gap[i] = unit * larger(0.0, static_cast<double>(row.dd - 2 * more * row.dp + square(more) * row.pp));
    shear[i] = unit * static_cast<double>(row.gg);
    rounding[i] = unit * static_cast<double>(row.size + row.pp / square(augmentation[i]));
    stress[i] = static_cast<double>(square(scale * f) * row.pp);
  }
};

struct StressLength {
  ListView fluid_list, wall_list;
  ParticleYield yield;
  Span<const Real> own, wall, held, shear_rate;
  Span<Real> result;
  HOST_DEVICE void operator()(Index i) const {
    Real squares = 0;
    for (Index k = 0; k < fluid_list.length[i]; ++k)
      squares += square(own[fluid_list.row(i) + k * ListView::stride()]);
    for (Index k = 0; k < wall_list.length[i]; ++k)
      squares += square(wall[wall_list.row(i) + k * ListView::stride()]);
    const Real viscous = yield.viscous_part(i, shear_rate[i]) * shear_rate[i];
    result[i] = held[i] * std::sqrt(squares) + viscous;
  }
};

template <class Run>
void with_box(const PairContext& c, Run run) {
  if (c.box.any())
    run(PairLoop<PeriodicBox>{c, c.box});
  else
    run(PairLoop<OpenBox>{c, {}});
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
      relative_(c, "relative augmentations"),
      spare_relative_(c, "relative augmentations"),
      state_(c, "viscous states"),
      augmentations_(c, "augmentations"),
      gap_(c, "yield sums"),
      shear_(c, "yield sums"),
      rounding_(c, "yield sums"),
      stress_(c, "yield sums"),
      row_of_id_(c, "rows of ids"),
      room_(c, "room of rows"),
      ordered_(c, "rows in order"),
      fluid_layout_(c, "yield pairs"),
      wall_layout_(c, "yield pairs of walls") {}

void ExactYield::add_force(const PairContext& c, Real dt, Span<const Quad> base, Span<Quad> force) {
  with_box(c, [&](const auto& loop) {
    launch(context_, "yield forces", c.fluid.count,
           AddForce<decltype(loop.box)>{
               {loop, own_.span(), other_.span(), wall_.span(), held_.span()}, dt, base, force});
  });
}

Span<const double> ExactYield::measure_work(const PairContext& c, Real dt, Span<const Quad> predicted,
                                            Span<const Quad> solved, const SolveState* solve) {
  gap_.resize(c.fluid.count);
  with_box(c, [&](const auto& loop) {
    launch(context_, "yield work", c.fluid.count,
           if_converged(solve, WorkOfYield<decltype(loop.box)>{
                                   {loop, own_.span(), other_.span(), wall_.span(), held_.span()},
                                   dt,
                                   predicted,
                                   solved,
                                   gap_.span()}));
  });
  return gap_.span();
}

void ExactYield::measure_stress(const PairContext& c, Span<const Real> shear_rate, Span<Real> result) {
  launch(context_, "shear stress", c.fluid.count,
         StressLength{c.fluid_list, c.wall_list, ParticleYield(c), own_.span(), wall_.span(), held_.span(),
                      shear_rate, result});
}

ExactYield::Misfit ExactYield::update(const PairContext& c, Span<const Quad> predicted,
                                      Span<const Quad> increment, const Chords& chords) {
  // Of many terms the roundings cancel for the most part.
  constexpr auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
  const Rows n = c.fluid.count;
  gap_.resize(n), shear_.resize(n), rounding_.resize(n), stress_.resize(n), spare_held_.resize(n);
  with_box(c, [&](const auto& loop) {
    launch(context_, "yield stresses", n,
           Update<decltype(loop.box)>{loop,
                                      ParticleYield(c),
                                      {predicted, increment},
                                      held_.span(),
                                      augmentations_.span(),
                                      own_.span(),
                                      other_.span(),
                                      wall_.span(),
                                      spare_held_.span(),
                                      chords,
                                      c.flow.spacing / unit_,
                                      gap_.span(),
                                      shear_.span(),
                                      rounding_.span(),
                                      stress_.span()});
  });
  held_.swap(spare_held_);
  auto rms = [&](Buffer<double>& v) { return std::sqrt(sum(context_, v.span(), n) / n); };
  return {rms(gap_), rms(shear_), epsilon / 8 * rms(rounding_), rms(stress_)};
}

}  // namespace slagflow
