// Constants of a run as the device bodies use them.
#pragma once

#include "backend/lanes.hpp"
#include "backend/span.hpp"
#include "fluid/math.hpp"
#include "fluid/models.hpp"
#include "fluid/smoothing/smoothing.hpp"

namespace slagflow {

// Positions on the device are relative to the domain's lower corner, so that fp32 keeps pair distances.
// Periodic axes take the nearest image; an open axis has period and inverse 0.
struct PeriodicBox {
  Vec3 period, inverse;

  HOST_DEVICE bool any() const { return period.x != 0 || period.y != 0 || period.z != 0; }
  template <class T>  // Real or Lanes
  HOST_DEVICE Vector3<T> separation(Vector3<T> a, Vector3<T> b) const {
    Vector3<T> d = a - b;
    d.x -= period.x * nearest_integer(d.x * inverse.x);
    d.y -= period.y * nearest_integer(d.y * inverse.y);
    d.z -= period.z * nearest_integer(d.z * inverse.z);
    return d;
  }
};

struct OpenBox {
  template <class T>
  HOST_DEVICE Vector3<T> separation(Vector3<T> a, Vector3<T> b) const {
    return a - b;
  }
};

// How a pair at separation d couples two velocities, w d (d . difference) or w |d|^2 difference: along the
// line between the particles, or all components alike.
enum class PairCoupling { radial, isotropic };

template <class T>
HOST_DEVICE Vector3<T> couple(PairCoupling coupling, T weight, Vector3<T> d, Vector3<T> difference) {
  return coupling == PairCoupling::radial ? (weight * dot(d, difference)) * d
                                          : (weight * dot(d, d)) * difference;
}

template <class T>
HOST_DEVICE void add_coupling(PairCoupling coupling, T weight, Vector3<T> d, SymmetricMatrix3<T>& block) {
  if (coupling == PairCoupling::radial)
    block.add_outer(weight, d);
  else
    block.add_diagonal(weight * dot(d, d));
}

struct FluidConstants {
  Real rest_density;  // [kg/m^3]
  Real mass;          // of a particle [kg]
  Rheology rheology;
  Real max_viscosity = Real(1e30);  // [Pa s]; less where heat is on

  // Of a particle whose density is above that of rest by `excess`. `packing`: its density at the start over
  // that at rest, as the lattice of the start has one volume whatever the pressure. Thin fluid takes at most
  // twice its volume: the pressure of a neighbour acts on a particle in proportion to it.
  HOST_DEVICE Real volume(Real excess, Real packing) const {
    return packing * mass / (rest_density + larger(excess, Real(-0.5) * rest_density));
  }
  HOST_DEVICE Real compression(Real excess) const { return excess / rest_density; }
};

struct FlowConstants {
  int dimensions = 3;
  Real spacing = 0;              // [m]
  Real support = 0;              // h [m]
  Real wall_volume = 0;          // of a wall particle [m^3], [m^2] in 2-D
  Vec3 gravity;                  // [m/s^2]
  Vec3 body_acceleration;        // [m/s^2]
  Real sound_speed_squared = 0;  // [m^2/s^2]
  Real diffusion = 0;            // 2 delta (h/2) c0 [m^2/s]
  Real damping_reference = 0;    // c0 h [m^2/s], of diffusing_share()
  bool viscous_tension = false;  // what is in tension follows TensionModel::viscous
  bool flat_tension = false;     // its pairs have the function for tension
  Real tension_limit = 0;        // [Pa]
  Real wall_tension_limit = 0;   // [Pa], of walls without one of their own (WallArrays::tension_limit)
  Real tension_reference = 0;    // c0 dx/40 [m^2/s], of tension_share()
  Real anti_pairing = 0;
  Real pairing_reference = 0;     // 1 / W(spacing)
  Real inverse_gradient_sum = 1;  // 1 / sum V |F| x^2 of a lattice: what the pair sums make of a gradient
  Smoothing smoothing;
  PairCoupling coupling = PairCoupling::radial;
  Real operator_factor =
      0;                  // C_visc 2 (d + 2) radial, C_visc 2 isotropic: pair weight of the viscous operator
  Real shear_factor = 0;  // C_visc (d + 2): pair weight of the squared shear rate
};

// Morris' no-slip: a wall particle at depth d_w below the surface stands for the velocity that makes the
// velocity linear through the surface, i.e. the pair weight grows by 1 + d_w/d_f, d_f the fluid particle's
// distance from the surface. J. P. Morris et al., J. Comput. Phys. 136 (1997) 214.
// With a slip length b (C. L. M. H. Navier, Mem. Acad. R. Sci. 6 (1823) 389: slip velocity = b times the
// velocity gradient) the line vanishes at depth b: the weight grows by (d_f + d_w)/(d_f + b). The factor
// scales all of the pair, so that the matrix stays symmetric and b -> infinity is free slip; what keeps the
// fluid off a slippery wall is pressure.
template <class T, class Face>  // Real and Quad, or Lanes and QuadLanes
struct WallPairGeometry {
  Vector3<T> fluid_minus_wall;
  Face normal;  // xyz unit normal, w depth of the wall particle [m]
  Face back;    // the same of the opposite face of a thin plate, w = 0 without one
};

// Depth of the wall particle below the face before which the fluid particle is, and the distance of that from
// it, a quarter of a spacing at least.
template <class T>
struct FaceBetween {
  T depth, distance;
};
template <class T, class Face>
HOST_DEVICE_INLINED FaceBetween<T> face_between(const WallPairGeometry<T, Face>& pair, Real spacing) {
  const Vector3<T> d = pair.fluid_minus_wall;
  const T front = dot(d, xyz(pair.normal)) - pair.normal.w, rear = dot(d, xyz(pair.back)) - pair.back.w;
  const auto behind = (pair.back.w > T(0)) & (rear > T(0));
  return {select(behind, pair.back.w, pair.normal.w),
          larger(select(behind, rear, front), T(Real(0.25) * spacing))};
}

// `slip_length`: b [m] >= 0, 0 without slip.
template <class T>
HOST_DEVICE_INLINED T no_slip_factor(const FaceBetween<T>& face, T slip_length) {
  return smaller(T(3), T(1) + (face.depth - slip_length) / (face.distance + slip_length));
}
template <class T, class Face>
HOST_DEVICE_INLINED T no_slip_factor(const WallPairGeometry<T, Face>& pair, Real spacing, T slip_length) {
  return no_slip_factor(face_between(pair, spacing), slip_length);
}

}  // namespace slagflow
