// Yield stresses without regularisation: the implicit step with a plug that is truly rigid. It is the minimum
// of a convex energy,
//   1/2 sum_i m_i |u_i - u*_i|^2 + dt sum_i V_i [eta_i gamma_i^2 / 2 + tau_i gamma_i],  gamma_i = |(G u)_i|,
//   (G u)_ij = g_ij x_ij.(u_i - u_j),  g_ij = sqrt(C (d+2) V_j |F_ij| / r^2)  [1/(m s) per m/s],
// with the shear rate of density.hpp as the length of a row of G u. The rows q of sheared strain rates and
// their stresses are separated from u by an augmented Lagrangian (ALG2 in M. Fortin, R. Glowinski, Augmented
// Lagrangian Methods, North-Holland 1983; over-relaxed as in J. Eckstein, D. P. Bertsekas, Math. Program. 55
// (1992) 293):
//   (M + dt (eta + a) K) u = M u* + walls - dt G^T V s,   s_i = (2 f_i - 1) p_i
//   p_i <- [f_i + (1 - w)(1 - f_i)] p_i + w a (G u)_i,    f_i = min(1, tau_i / |p_i|)
// a [Pa s]: the augmentation, each particle's own, w: the over-relaxation. p [Pa] is all there is to keep:
// the stress is f p, the sheared strain rate (1 - f) p / a, which is zero to the bit in a plug.
//   G u is taken of u* and of what the solve adds to it, each by differences: it must not depend on the speed
//   of
// the frame. A pair of two fluids has halves with strain rates x.(u_i - u_j) +- y of which y is where their
// stresses are equal; it is eliminated, so that their viscosities with a have the harmonic mean.
#pragma once

#include "fluid/solve_state.hpp"
#include "neighbours/pairs.hpp"
#include "viscosity/linear_system.hpp"

namespace slagflow {

// g of the pair with a wall particle, w its viscous weight; `stick`: what no_slip_factor says.
HOST_DEVICE inline Real wall_strain_factor(const FlowConstants& flow, Real stick, Real w) {
  return std::sqrt(2 * stick * flow.shear_factor * flow.wall_volume * w);
}

// p of the entries of the wall list and f of the particles; without data where no yield stress is exact.
struct WallYield {
  Span<const Real> stress, held;
};

// a = rho spacing^2 / dt times a number of each particle: `fixed`, or where that is 0 what suits the flow,
// changed by `largest_factor` at most.
struct Augmentation {
  Real unit, fixed, largest_factor;  // [Pa s]
};

// Rows of a list that was, by the ids of its particles.
struct IdLists : RowLayout {
  Span<const Index> id;
};

class ExactYield {
 public:
  explicit ExactYield(Context&);

  struct Lists {
    const NeighbourList& fluid;
    const NeighbourList& wall;
    const Buffer<Index>& fluid_id;
    const Buffer<Index>& wall_id;
  };
  // After the lists were built anew: p goes with its pair. `ids`: more than any fluid particle's id.
  void follow(const Lists&, Index ids);
  // After restoring, when the lists of that moment have been built again; throws Error when what was restored
  // cannot belong to them.
  void take_restored(const Lists&, Index ids);

  // Begins a step, or goes on with one, with other augmentations; the stresses and sheared strain rates stay.
  void begin(const PairContext&, const FluidArrays&, const Augmentation&);
  // The pairs with the part of the viscosities that is no yield stress, at the shear rate of the step's
  // start, plus the augmentation of fluids with a yield stress.
  PairContext augmented(const PairContext&) const;

  // force_i = base_i - dt (G^T V s)_i  [kg m/s], of the augmented pairs; w: the size of its terms.
  void add_force(const PairContext&, Real dt, Span<const Quad> base, Span<Quad> force);
  // p and f from the velocities u = u* + increment, of the augmented pairs. Returns the rms over the
  // particles of dt/(rho spacing) times: a times what is between G u and the strain rates q, a G u, a times
  // its rounding, and the stress f p.
  struct Misfit {
    double gap = 0, shear = 0, rounding = 0, stress = 0;  // [m/s]
  };
  Misfit update(const PairContext&, Span<const Quad> predicted, Span<const Quad> increment, const Chords&);

  // What the forces of add_force() take of the motion of each particle between u* and u [J]; until update().
  // Idle unless the solve has converged.
  Span<const double> measure_work(const PairContext&, Real dt, Span<const Quad> predicted,
                                  Span<const Quad> solved, const SolveState* solve);

  // |tau| [Pa] of each particle: f |p| and that of the viscous part at these shear rates.
  void measure_stress(const PairContext&, Span<const Real> shear_rate, Span<Real> result);

  // f of each particle: 1 where it has not yielded.
  Span<const Real> held() const { return held_.span(); }
  WallYield walls() const { return {wall_.span(), held_.span()}; }

  // p of a row's own pairs, p of the same pairs in the other particle's row, p of wall pairs, and f. Rows in
  // the order of the particles: on the CPU threads put them wherever there is room, and another time
  // elsewhere. What is restored waits for take_restored().
  template <class Visitor>
  void save(Visitor& v) {
    put_in_order();
    v.array("yield_own", spare_own_), v.array("yield_other", spare_other_);
    v.array("yield_wall", spare_wall_);
    v.array("yield_held", held_);
    v.array("yield_augmentation", relative_);
    std::vector<double> unit{static_cast<double>(unit_)};
    v.values("yield_augmentation_unit", unit);
    unit.resize(1);
    unit_ = static_cast<Real>(unit[0]);
  }

 private:
  // Whose pairs the entries of a list were, for the next list.
  struct Layout {
    Layout(Context& c, const char* name) : slice(c, name), length(c, name), id(c, name) {}
    Buffer<Offset> slice;
    Buffer<Index> length, id;
    IdLists view() const { return {{slice.span(), length.span()}, id.span()}; }
  };
  void remember(const Lists&, Index ids);
  void record(const NeighbourList&, Span<const Index> id, Layout&);
  Span<const Offset> ordered_rows(const Layout&);
  void put_in_order();

  Context& context_;
  Real unit_ = 0;  // [Pa s] of the augmentations that p belongs to
  Buffer<Real> own_, other_, wall_, held_, spare_own_, spare_other_, spare_wall_, spare_held_;
  Buffer<Real> relative_, spare_relative_;  // augmentations in that unit, 0 without a yield stress
  Buffer<Quad> state_;
  Buffer<Real> augmentations_;  // [Pa s]
  Buffer<double> gap_, shear_, rounding_, stress_;
  Buffer<Index> row_of_id_;
  Buffer<Offset> room_, ordered_;  // of rows in the order of the particles
  Layout fluid_layout_, wall_layout_;
};

}  // namespace slagflow
