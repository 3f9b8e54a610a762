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
// a [Pa s]: the augmentation, w: the over-relaxation. p [Pa] is all there is to keep: the stress is f p, the
// sheared strain rate (1 - f) p / a, which is zero to the bit in a plug.
#pragma once

#include "density.hpp"

namespace slagflow {

// g of the pair with a wall particle at distance r, `gradient`: F; `stick`: what no_slip_factor says.
HOST_DEVICE inline Real wall_strain_factor(const FlowConstants& flow, Real stick, Real gradient, Real r2) {
  return std::sqrt(-2 * stick * flow.shear_factor * flow.wall_volume * gradient / (r2 + flow.softening));
}

// p of the entries of the wall list and f of the particles; without data where no yield stress is exact.
struct WallYield {
  Span<const Real> stress, held;
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
  // The same when p belongs to the lists already, as after restoring it; throws Error when it cannot.
  void remember(const Lists&, Index ids);

  // Begins a step with the augmentation [Pa s]; strain rates and stresses of the last step are kept.
  void begin(const PairContext&, const FluidArrays&, Real augmentation);
  // The pairs with the part of the viscosities that is no yield stress, at the shear rate of the step's
  // start, and with the augmentation.
  PairContext viscous_part(const PairContext&) const;

  // force_i = -dt (G^T V s)_i  [kg m/s]
  void add_force(const PairContext&, Real dt, Span<const Quad> base, Span<Quad> force);
  // p and f from the velocities. Returns the rms of what is between G u and the strain rates q, of how much
  // these changed, and of G u.
  struct Rates {
    double gap = 0, change = 0, shear = 0;  // [1/s]
  };
  Rates update(const PairContext&, Span<const Quad> velocity);

  // What suits the flow, in rho spacing^2/dt, after a step of which `gap` and `change` are the sums over its
  // iterations: more where rates differ but no longer change, as in a plug that comes to rest, less where
  // they change (residual balancing: B. S. He et al., J. Optim. Theory Appl. 106 (2000) 337).
  void balance(double gap, double change);
  double balanced_augmentation() const { return balanced_; }

  // |tau| [Pa] of each particle: f |p| and that of the viscous part at these shear rates.
  void measure_stress(const PairContext&, Span<const Real> shear_rate, Span<Real> result);

  // f of each particle: 1 where it has not yielded.
  Span<const Real> held() const { return held_.span(); }
  WallYield walls() const { return {wall_.span(), held_.span()}; }

  // p of a row's own pairs, p of the same pairs in the other particle's row, p of wall pairs, and f.
  template <class Visitor>
  void visit_arrays(Visitor& v) {
    v.array("yield_own", own_), v.array("yield_other", other_), v.array("yield_wall", wall_);
    v.array("yield_held", held_);
    std::vector<double> numbers{balanced_, static_cast<double>(augmentation_)};
    v.values("yield_augmentation", numbers);
    numbers.resize(2);
    balanced_ = numbers[0], augmentation_ = static_cast<Real>(numbers[1]);
  }

 private:
  // Whose pairs the entries of a list were, for the next list.
  struct Layout {
    Layout(Context& c, const char* name) : slice(c, name), length(c, name), id(c, name) {}
    Buffer<Offset> slice;
    Buffer<Index> length, id;
    ListView view() const { return {slice.span(), length.span(), id.span()}; }
  };
  void record(const NeighbourList&, Span<const Index> id, Layout&);

  Context& context_;
  double balanced_ = 1;
  Real augmentation_ = 0;  // [Pa s] that p belongs to
  Buffer<Real> own_, other_, wall_, held_, spare_own_, spare_other_, spare_wall_, spare_held_;
  Buffer<Quad> state_;
  Buffer<double> gap_, change_, shear_;
  Buffer<Index> row_of_id_;
  Layout fluid_layout_, wall_layout_;
};

}  // namespace slagflow
