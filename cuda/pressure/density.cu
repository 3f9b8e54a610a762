#include "backend/launch.hpp"
#include "fluid/lane_math.hpp"
#include "fluid/yield_rheology.hpp"
#include "neighbours/pair_rheology.hpp"
#include "pressure/density.hpp"
#include "pressure/pair_pressure.hpp"
#include "walls/contact.hpp"
#include "walls/wall_tension.hpp"

namespace slagflow {

namespace {

struct PairSums {
  Lanes approach = 0;  // of the fluid, relative change of the density [1/s]
  Lanes squeeze = 0;   // by the walls, relative change in the last step
  // What the function for tension makes of both beyond that, and the densities around, with and without sign.
  Lanes apart = 0, torn = 0, around = 0, sizes = 0;
  Lanes diffusion = 0, shear = 0, fill = 0;
  Lanes nearest_wall = Real(1e30);  // squared distance from a wall particle [m^2]
};

// Sum V W where particles in disorder leave no voids; 1 on a lattice.
constexpr Real closed_fill = Real(1.02);
// Below that there are some around a particle that has left voids, of more than a share of its density.
constexpr Real open_fill = Real(0.96), true_void = Real(0.02);
// But not where a wall particle is nearer [spacings]: what strikes a wall is stopped there.
constexpr Real pressed_within = Real(0.9);

// Particle i as its pairs see it.
struct Centre {
  Vec3 place, velocity;
  Real excess;  // density - rest density
  Real rest_density, viscosity;
  Vec3 by_pressure;  // force per volume
  Real in_tension;   // share of the function for tension in its continuity
  Real hollow;       // void that it has left behind [kg/m^3]
};

// Writes the new density excess to `excess` and the shear rate; neighbours still read the old density.
template <class Box>
struct DensityAndShear {
  PairContext c;
  Box box;
  Real moved;              // [s]
  Real inverse_stiffness;  // 1/c0^2
  Span<Real> excess, hollow, shear_rate, contact;

  HOST_DEVICE void operator()(Index i) const {
    const Quad motion = c.fluid.motion[i];
    const FluidConstants& kind = c.fluids[c.fluid.fluid[i]];
    const Centre centre{xyz(c.fluid.place[i]),
                        xyz(motion),
                        motion.w,
                        kind.rest_density,
                        c.fluid.state[i].y,
                        xyz(c.fluid.by_pressure[i]),
                        share_in_tension(i, motion.w),
                        c.fluid.hollow[i]};
    PairSums sums;
    add_fluid(i, centre, sums);
    add_walls(i, centre, sums);
    const Real denser = moved * total(sums.approach) + total(sums.squeeze) +
                        held_together(centre, sums) * (moved * total(sums.apart) + total(sums.torn));
    const Real left = void_left(i, centre, sums);
    hollow[i] = left;
    excess[i] = motion.w - left + (kind.rest_density + motion.w) * denser +
                moved * c.flow.diffusion * total(sums.diffusion);
    shear_rate[i] = std::sqrt(c.flow.shear_factor * total(sums.shear));
    Real from_wall = Real(1e30);
    if (least(sums.nearest_wall) < square(contact_reach * c.flow.spacing))
      from_wall = contact_distance(c, i, [&](Vec3 a, Vec3 b) { return box.separation(a, b); });
    contact[i] = contact_pressure(c.flow, kind.rest_density, from_wall);
  }

  // What is left of the void of a particle: no more than the places of its neighbours, with the sum V W over
  // them, leave room for; and no less than they show. Continuity alone forgets what opens where few
  // neighbours are left to tell of it, as in a jet that falls.
  HOST_DEVICE Real void_left(Index i, const Centre& centre, const PairSums& sums) const {
    if (!(centre.hollow > 0)) return 0;
    const Real fill = total(sums.fill) + c.fluid.place[i].w * c.flow.smoothing.value(Real(0));
    const bool pressed = least(sums.nearest_wall) < square(pressed_within * c.flow.spacing);
    const bool open = centre.hollow > true_void * centre.rest_density && !pressed;
    const Real seen = open ? open_fill - fill : Real(0);
    return smaller(larger(centre.hollow, centre.rest_density * seen),
                   centre.rest_density * larger(Real(0), closed_fill - fill));
  }

  HOST_DEVICE void add_fluid(Index i, const Centre& centre, PairSums& sums) const {
    const LaneVec3 x = in_lanes(centre.place), v = in_lanes(centre.velocity),
                   f = in_lanes(centre.by_pressure);
    const Lanes half = Real(0.5) * moved;
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      row.foresee(k);
      const QuadLanes there = gather(c.fluid.place, j), other = gather(c.fluid.motion, j);
      const LaneVec3 slip = v - xyz(other), d = box.separation(x, xyz(there)) - half * slip;
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const Lanes volume = select(near, there.w, Lanes(0)), weight = volume * c.flow.smoothing.gradient(r2);
      if (centre.hollow > 0) sums.fill += volume * c.flow.smoothing.value(r2);
      const Lanes approach = dot(slip, d);
      sums.approach += weight * approach;
      if (centre.in_tension > 0) {
        sums.apart += in_tension(centre, volume, weight, r2) * approach;
        sums.around -= weight * other.w, sums.sizes -= weight * magnitude(other.w);
      }
      const Lanes smooth = (Real(0.5) * inverse_stiffness * c.flow.inverse_gradient_sum) *
                           dot(f + xyz(gather(c.fluid.by_pressure, j)), d);
      const Lanes viscosity = gather(c.fluid.state, j).y;
      const Lanes noise = diffusing_share(centre, centre.viscosity + viscosity) * weight *
                          ((other.w - centre.excess) - smooth),
                  strain = volume * c.flow.smoothing.viscous(r2) * square(approach);
      const Lanes within =
          c.fluid.melt.size > 0 ? share_of_strain(c, i, Lanes(centre.viscosity), j) : Lanes(1);
      if (c.fluids.size == 1) {
        sums.diffusion -= noise, sums.shear += within * strain;
        continue;
      }
      const LaneMask alike = same(c.fluid.fluid, j, c.fluid.fluid[i]);
      sums.diffusion -= select(alike, noise, Lanes(0));
      sums.shear += select(alike, within, own_side(centre.viscosity, viscosity)) * strain;
    }
  }

  HOST_DEVICE Real share_in_tension(Index i, Real above_rest) const {
    if (!c.flow.flat_tension || above_rest >= 0) return 0;
    const Quad state = c.fluid.state[i];
    return tension_share(c.flow, state.w / state.z, state.y);
  }

  // What the function for tension has beyond the weight by F.
  HOST_DEVICE Lanes in_tension(const Centre& centre, Lanes volume, Lanes weight, Lanes r2) const {
    if (!(centre.in_tension > 0)) return 0;
    return volume * c.flow.smoothing.tension_gradient(r2) - weight;
  }

  // Of a particle below zero the share of the function for tension, as far as the fluid around it is below
  // zero too. A single one between others above is noise: with two functions, one on its way down and the
  // other up, sheared fluid would gain volume.
  HOST_DEVICE Real held_together(const Centre& centre, const PairSums& sums) const {
    if (!(centre.in_tension > 0)) return 0;
    const Real sizes = total(sums.sizes);
    return sizes > 0 ? centre.in_tension * larger(Real(0), -total(sums.around) / sizes) : Real(0);
  }

  // Of a pair with this sum of viscosities: what sways between thick neighbours their viscosity damps.
  HOST_DEVICE Lanes diffusing_share(const Centre& centre, Lanes viscosities) const {
    const Lanes reference = Real(2) * centre.rest_density * c.flow.damping_reference;
    return reference / (reference + viscosities);
  }

  HOST_DEVICE void add_walls(Index i, const Centre& centre, PairSums& sums) const {
    const LaneVec3 x = in_lanes(centre.place), v = in_lanes(centre.velocity),
                   travelled = in_lanes(moved * centre.velocity), hydrostatic = in_lanes(c.flow.gravity);
    const Lanes half = Real(0.5), slope = centre.rest_density * inverse_stiffness;
    const bool walls_move = c.wall.moved.size > 0;
    const ListRow row = c.wall_list.entries(i);
    const Index pairs = c.wall_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      LaneVec3 change = travelled, falls = hydrostatic;
      QuadLanes other = gather(c.wall.velocity, j);
      if (walls_move) {
        const LaneVec3 gain = xyz(gather(c.wall.acceleration, j));
        change = change - xyz(gather(c.wall.moved, j));
        falls = falls - gain;
        // The fluid still has the velocity of the last step.
        other.x -= Lanes(moved) * gain.x, other.y -= Lanes(moved) * gain.y, other.z -= Lanes(moved) * gain.z;
      } else {
        change = change - Lanes(moved) * xyz(other);
      }
      const LaneVec3 d = box.separation(x, xyz(gather(c.wall.place, j))) - half * change;
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const Lanes volume = select(near, Lanes(c.flow.wall_volume), Lanes(0)),
                  weight = volume * c.flow.smoothing.gradient(r2);
      if (centre.hollow > 0) sums.fill += volume * c.flow.smoothing.value(r2);
      const Lanes closer = dot(change, d);
      sums.squeeze += weight * closer, sums.torn += in_tension(centre, volume, weight, r2) * closer;
      // A wall particle at the cut-off, as above the surface, has no hydrostatic density to diffuse towards.
      const Lanes pressure = gather(c.wall.pressure, j);
      const Lanes difference = pressure * inverse_stiffness - centre.excess + slope * dot(falls, d);
      const Lanes noise = diffusing_share(centre, Real(2) * centre.viscosity) * weight * difference;
      sums.diffusion -= select(pressure > -wall_tension_limits(c, j), noise, Lanes(0));
      const WallPairGeometry<Lanes, QuadLanes> pair{d, gather(c.wall.normal, j), gather(c.wall.back, j)};
      const LaneVec3 now = d + half * change;
      sums.nearest_wall = smaller(sums.nearest_wall, select(near, dot(now, now), sums.nearest_wall));
      sums.shear += volume * c.flow.smoothing.viscous(r2) * wall_strain(pair, other, v);
    }
  }

  // Each of two fluid particles carries half of what their pair dissipates; a wall particle carries none. Of
  // what a wall that slips dissipates, the share d_f/(d_f + b) is in the fluid, and shears it.
  HOST_DEVICE Lanes wall_strain(const WallPairGeometry<Lanes, QuadLanes>& pair, const QuadLanes& wall,
                                LaneVec3 velocity) const {
    const FaceBetween<Lanes> face = face_between(pair, c.flow.spacing);
    const Lanes stick = no_slip_factor(face, wall.w), within = face.distance / (face.distance + wall.w);
    const Lanes strain = square(dot(velocity - xyz(wall), pair.fluid_minus_wall));
    return select(wall.w < Lanes(0), Lanes(0), (Real(2) * within * stick) * strain);
  }
};

// Tension over the viscous stress eta gamma. A free surface asks for 2/sqrt(3) at most; from 4 on discharges
// and sheets take no notice of it.
constexpr Real most_tension = 8;

struct StateFromDensity {
  Span<const FluidConstants> fluids;
  FlowConstants flow;
  Span<const std::uint8_t> fluid;
  Span<const Real> excess, shear_rate, packing;
  Span<Quad> place, motion, state, melt;
  Span<Real> pressure, hollow;

  // With heat the rheology is that of the particle's temperature.
  HOST_DEVICE Real viscosity_of(Index i, const FluidConstants& f) const {
    if (melt.size == 0) return viscosity(f.rheology, shear_rate[i]);
    const Rheology now = Melt(melt[i]).of(f.rheology);
    const Real eta = smaller(viscosity(now, shear_rate[i]), f.max_viscosity);
    melt[i].w = smaller(viscous_part_of(now, shear_rate[i]), eta);
    return eta;
  }

  HOST_DEVICE void operator()(Index i) const {
    const FluidConstants& f = fluids[fluid[i]];
    const Real eta = viscosity_of(i, f);
    const Real limit = flow.viscous_tension
                           ? smaller(flow.tension_limit, larger(Real(0), most_tension * eta * shear_rate[i]))
                           : flow.tension_limit;
    // Over a void tension grows by expansion alone, not with its limit.
    const Real stretched = hollow[i] > 0 ? smaller(excess[i] + hollow[i], motion[i].w) : excess[i];
    const Real least = larger(stretched, -limit / flow.sound_speed_squared);
    const Real kept = flow.viscous_tension ? larger(excess[i], least) : excess[i];
    const Real p = larger(flow.sound_speed_squared * kept, -limit), volume = f.volume(kept, packing[i]);
    motion[i].w = kept;
    hollow[i] = kept - excess[i];
    place[i].w = volume;
    pressure[i] = p;
    state[i] = {p, eta, volume, f.mass};
  }
};

}  // namespace

void update_density(Context& context, const PairContext& c, FluidArrays& fluid, Buffer<Real>& scratch,
                    Real moved) {
  scratch.resize(fluid.count);
  auto sweep = [&](auto box) {
    launch(
        context, "density and shear rate", fluid.count,
        DensityAndShear<decltype(box)>{c, box, moved, 1 / c.flow.sound_speed_squared, scratch.span(),
                                       fluid.hollow.span(), fluid.shear_rate.span(), fluid.contact.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
  launch(context, "state", fluid.count,
         StateFromDensity{c.fluids, c.flow, fluid.fluid.span(), scratch.span(), fluid.shear_rate.span(),
                          fluid.packing.span(), fluid.place.span(), fluid.motion.span(), fluid.state.span(),
                          fluid.melt.span(), fluid.pressure.span(), fluid.hollow.span()});
  exchange(context, fluid.count, fluid.place, fluid.motion, fluid.state, fluid.pressure, fluid.contact,
           fluid.hollow, fluid.shear_rate);
}

}  // namespace slagflow
