#include "backend/launch.hpp"
#include "density.hpp"
#include "lane_math.hpp"
#include "smoothing/lucy.hpp"
#include "walls/wall_tension.hpp"

namespace slagflow {

namespace {

struct PairSums {
  Lanes divergence = 0, diffusion = 0, shear = 0;
};

// Particle i as its pairs see it.
struct Centre {
  Vec3 place, velocity;
  Real excess;        // density - rest density
  Real slope;         // gradient of the density over the acceleration that it gives
  Vec3 acceleration;  // by pressure
};

// Writes the new density excess to `excess` and the shear rate; neighbours still read the old density.
template <class Smoothing, class Box>
struct DensityAndShear {
  PairContext c;
  Smoothing smoothing;
  Box box;
  Real dt;
  Span<Real> excess, shear_rate;

  HOST_DEVICE void operator()(Index i) const {
    const Quad motion = c.fluid.motion[i];
    const Real rest_density = c.fluids[c.fluid.fluid[i]].rest_density;
    const Centre centre{xyz(c.fluid.place[i]), xyz(motion), motion.w,
                        rest_density / c.flow.sound_speed_squared, xyz(c.fluid.by_pressure[i])};
    PairSums sums;
    add_fluid(i, centre, sums);
    add_walls(i, centre, sums);
    const Real rate =
        (rest_density + motion.w) * total(sums.divergence) + c.flow.diffusion * total(sums.diffusion);
    excess[i] = motion.w + dt * rate;
    shear_rate[i] = std::sqrt(c.flow.shear_factor * total(sums.shear));
  }

  HOST_DEVICE void add_fluid(Index i, const Centre& centre, PairSums& sums) const {
    const LaneVec3 x = in_lanes(centre.place), v = in_lanes(centre.velocity),
                   a = in_lanes(centre.acceleration);
    const Offset first = c.fluid_list.row(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Index* j = &c.fluid_list.entry[first + k * ListView::stride()];
      const QuadLanes there = gather(c.fluid.place, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const QuadLanes other = gather(c.fluid.motion, j);
      const Lanes weight = select(near, there.w * smoothing.gradient(root(r2)), Lanes(0));
      const Lanes approach = dot(v - xyz(other), d), share = weight * approach;
      sums.divergence += share;
      const LaneVec3 both = a + xyz(gather(c.fluid.by_pressure, j));
      sums.diffusion -= weight * ((other.w - centre.excess) - (Real(0.5) * centre.slope) * dot(both, d));
      sums.shear -= share * approach / (r2 + c.flow.softening);
    }
  }

  HOST_DEVICE void add_walls(Index i, const Centre& centre, PairSums& sums) const {
    const LaneVec3 x = in_lanes(centre.place), v = in_lanes(centre.velocity),
                   hydrostatic = in_lanes(centre.slope * c.flow.gravity);
    const Offset first = c.wall_list.row(i);
    const Index pairs = c.wall_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Index* j = &c.wall_list.entry[first + k * ListView::stride()];
      const LaneVec3 d = box.separation(x, xyz(gather(c.wall.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const QuadLanes other = gather(c.wall.velocity, j);
      const Lanes weight = select(near, c.flow.wall_volume * smoothing.gradient(root(r2)), Lanes(0));
      const Lanes approach = dot(v - xyz(other), d), share = weight * approach;
      sums.divergence += share;
      // The fluid still has the velocity of the last step; so must the wall, that they keep their distance.
      Lanes rest = dot(hydrostatic, d);
      if (c.wall.acceleration.size > 0) {
        const Lanes moved = dot(xyz(gather(c.wall.acceleration, j)), d);
        sums.divergence += weight * (Lanes(dt) * moved);
        rest -= centre.slope * moved;
      }
      // A wall particle at the cut-off, as above the surface, has no hydrostatic density to diffuse towards.
      const Lanes pressure = gather(c.wall.pressure, j);
      const Lanes difference = pressure / c.flow.sound_speed_squared - centre.excess;
      sums.diffusion -= select(pressure > -wall_tension_limits(c, j), weight * (difference + rest), Lanes(0));
      const WallPairGeometry<Lanes, QuadLanes> pair{d, gather(c.wall.normal, j), gather(c.wall.back, j)};
      const Lanes stick = no_slip_factor(pair, c.flow.spacing, other.w);
      // Each of two fluid particles carries half of what their pair dissipates; a wall particle carries none.
      const Lanes dissipated = Real(2) * stick * share * approach / (r2 + c.flow.softening);
      sums.shear -= select(other.w < Lanes(0), Lanes(0), dissipated);
    }
  }
};

struct StateFromDensity {
  Span<const FluidConstants> fluids;
  FlowConstants flow;
  Span<const std::uint8_t> fluid;
  Span<const Real> excess, shear_rate;
  Span<Quad> place, motion, state;
  Span<Real> pressure;

  HOST_DEVICE void operator()(Index i) const {
    const FluidConstants& f = fluids[fluid[i]];
    const Real density = f.rest_density + excess[i];
    const Real p = larger(flow.sound_speed_squared * excess[i], -flow.tension_limit);
    motion[i].w = excess[i];
    place[i].w = f.mass / density;
    pressure[i] = p;
    state[i] = {p / square(density), viscosity(f.rheology, shear_rate[i]), f.mass / density, f.mass};
  }
};

}  // namespace

void update_density(Context& context, const PairContext& c, FluidArrays& fluid, Buffer<Real>& scratch,
                    Real dt) {
  const Lucy smoothing(c.flow.support, c.flow.dimensions);
  scratch.resize(fluid.count);
  auto sweep = [&](auto box) {
    launch(
        context, "density and shear rate", fluid.count,
        DensityAndShear<Lucy, decltype(box)>{c, smoothing, box, dt, scratch.span(), fluid.shear_rate.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
  launch(
      context, "state", fluid.count,
      StateFromDensity{c.fluids, c.flow, fluid.fluid.span(), scratch.span(), fluid.shear_rate.span(),
                       fluid.place.span(), fluid.motion.span(), fluid.state.span(), fluid.pressure.span()});
}

}  // namespace slagflow
