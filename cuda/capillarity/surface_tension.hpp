// Surface tension and contact angles by a continuum surface stress.
#pragma once

#include <vector>

#include "fluid/setup.hpp"
#include "fluid/step_record.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

// Weight of a pair in the divergence of a stress: K = k q^2 (1 - q)^2, q = r/h, with int K x x^T dV = 1
// [1/m^5, in 2-D 1/m^4]. A pull k r grows with the distance up to 0.6 h, as that of a spring, so that tension
// spaces particles evenly instead of drawing them into pairs as a smoothing function would.
struct TensionWeight {
  Real inverse;  // 1/h [1/m]
  Real factor;   // k

  TensionWeight(double h, int dimensions);

  template <class T>  // Real or Lanes; for r < h only
  HOST_DEVICE T operator()(T r) const {
    const T q = r * inverse;
    return factor * square(q * (Real(1) - q));
  }
};

// Gradients of the colour that disorder leaves within the fluid are below this, times 1/h.
constexpr double colour_noise = 0.1;

// What the stress below makes of a plane surface, over the strength k: int_0^h W1^2/(W1 + n0) M dz at depth
// z. W1: the smoothing function integrated over planes, which is the gradient of the colour there; M: the
// share of int K x_t^2 dV, x_t along the surface, that lies within the fluid. Thus k = sigma over this.
double plane_surface_tension(int dimensions);
// The same with -F in place of K: k_w = sigma over this.
double plane_wall_tension(int dimensions);

// The stress as pairs see it; all empty without surface tension.
struct CapillaryView {
  Span<const Quad> normal_stress;  // xx, yy, zz, xy [Pa]
  Span<const Quad> shear_stress;   // xz, yz, 0, 0 [Pa]
  Span<const Quad> wall_normal;    // unit vector s/|s|, 0 away from walls; w: A [Pa]
  Span<const Quad> wall_traction;  // V_i T s/|s| [Pa m^3]: of the volume that the acceleration had

  HOST_DEVICE bool any() const { return normal_stress.size > 0; }
};

// Impulse per time on a fluid particle from a wall particle of the given volume at -d from it: the part of
// the stress along the wall's normal. Along the wall the contact angle is the work of the stress within the
// fluid. [N]
HOST_DEVICE inline Vec3 capillary_pull(const CapillaryView& c, const TensionWeight& weight, Index i, Vec3 d,
                                       Real r, Real volume) {
  const Real pull = Real(-2) * volume * weight(r) * dot(xyz(c.wall_traction[i]), d);
  return pull * xyz(c.wall_normal[i]);
}

// n = sum_j V_j F_ij x_ij over fluid and walls is the gradient of the colour, which walls continue; s that of
// the walls alone, t = s/|s|; theta the contact angle.
//   T_i = k (|n|^2 - n n)/(|n| + n0),   A_i = k_w cos theta |s|^2/(|s| + n0)
//   m_i a_i = -V_i sum_j V_j [K_ij (T_i + T_j) + F_ij (A_i (1 - t_i t_i) + A_j (1 - t_j t_j))] x_ij
// T is the tension of the free surface (the continuum surface stress of B. Lafaurie et al., J. Comput. Phys.
// 113 (1994) 134, with |n| as delta function where it is above n0 = 0.1/h), A the push along the wetted wall,
// by Young's equation sigma_s - sigma_sl = sigma cos theta. Particles that push each other need a weight that
// falls with the distance, -F, as those that pull need one that grows, K: with K the layer at the wall
// clumped. Pairs carry momentum exactly. Only the fluid's side of a surface has particles.
class SurfaceTension {
 public:
  SurfaceTension(Context&, const SimulationSetup&);

  bool on() const { return on_; }
  // Takes the memory for so many fluid particles.
  void reserve(Index count);
  // Sets stress and acceleration, after reserve(). `wall_id`: id of each wall particle.
  void update(const PairContext&, Span<const Index> wall_id);
  Span<const Quad> acceleration() const { return acceleration_.span(); }  // xyz [m/s^2]
  CapillaryView view() const;

  // What the stress does on the fluid at the velocities of a solve that has converged [W], to the record.
  void launch_power(const FluidArrays&, Span<const Quad> velocity, StepRecord*);

 private:
  Context& context_;
  bool on_ = false;
  Real wall_share_ = 0;    // k_w/k
  Buffer<Real> strength_;  // k of each fluid [N/m]
  Buffer<Real> cosine_;    // of the contact angle, by wall id
  Buffer<Quad> normal_stress_, shear_stress_, wall_normal_, wall_traction_, acceleration_;
};

}  // namespace slagflow
