// Heat as the sweeps over the pairs see it.
#pragma once

#include "fluid/lane_math.hpp"
#include "heat/material_table.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

// Of a wall, temperatures relative to the reference.
struct WallHeatConstants {
  WallHeat kind = WallHeat::adiabatic;
  Real temperature = 0;         // [K]
  Real flux = 0;                // [W/m^2] into the fluid
  Real contact_resistance = 0;  // 1/h_c [m^2 K/W]
  double absorption = 0;        // a of (H5) [J W/(m^4 K^2)]
  double least_taken = 0;       // E_s of the start [J/m^2]
};

// Sites of walls that heat passes: wall particles of the first layer, to which the deeper ones belong. By
// number; the particles of site s are member[first[s]] to member[first[s + 1]].
struct SiteView {
  Index count = 0;
  Span<const Index> of_wall;            // site of a wall particle by its id; -1: none
  Span<const Index> first, member;      // ids
  Span<const std::uint8_t> body;        // of each site
  Span<const Real> area;                // [m^2]
  Span<const Real> temperature, share;  // [K] relative to the reference; of the pairs' heat
  Span<const WallHeatConstants> bodies;
};

struct HeatConstants {
  Real factor = 0;              // 2 C_T: pair weight of the conduction operator
  Smoothing fill;               // Lucy's, which tells a surface from disorder better than steeper functions
  Span<const Quad> directions;  // xyz: unit vectors, evenly spread
  Real flat_share = 1;          // e_0 of (H6)
  Real drop_exponent = 0;       // of (H6)
  Real reference = 0;           // [K] of what is stored
  Real ambient = 0;             // [K]
  Real surface_transfer = 0;    // h of (H7) [W/(m^2 K)]
};

// G_ij of (H3) over V_i V_j [1/m^5], times the squared distance.
HOST_DEVICE_INLINED Lanes conduction_weight(const PairContext& c, const HeatConstants& heat, Lanes r2) {
  return heat.factor * c.flow.smoothing.viscous(r2) * r2;
}

// A fluid particle before a wall particle.
struct WallPair {
  Real area;      // G (d_f + d_w) [m^2]
  Real distance;  // d_f [m]
};

template <class Box>
HOST_DEVICE WallPair wall_pair(const PairContext& c, const HeatConstants& heat, const Box& box, Index i,
                               Index w) {
  const Quad place = c.fluid.place[i];
  const Vec3 d = box.separation(xyz(place), xyz(c.wall.place[w]));
  const Real r2 = dot(d, d);
  if (!(r2 < square(c.flow.support))) return {0, 1};
  const WallPairGeometry<Real, Quad> pair{d, c.wall.normal[w], c.wall.back[w]};
  const FaceBetween<Real> face = face_between(pair, c.flow.spacing);
  const Real weight = heat.factor * c.flow.smoothing.viscous(r2) * r2;
  return {weight * place.w * c.flow.wall_volume * (face.distance + face.depth), face.distance};
}

// U of (H4) [W/(m^2 K)], with which the wall at `wall` [K] gives U (wall - T_i) to the fluid.
HOST_DEVICE inline Real wall_conductance(const Material& material, Quad heat, Real distance, Real wall,
                                         Real contact_resistance) {
  constexpr int passes = 3;
  constexpr Real alike = Real(1e-2);  // [K]
  Real contact = wall, conductance = 0;
  for (int pass = 0; pass < (contact_resistance > 0 ? passes : 1); ++pass) {
    const Real apart = contact - heat.x;
    const Real k = magnitude(apart) > alike ? (material.potential_at(contact) - heat.y) / apart : heat.z;
    conductance = 1 / (distance / k + contact_resistance);
    contact = heat.x + conductance * (wall - heat.x) * distance / k;
  }
  return conductance;
}

}  // namespace slagflow
