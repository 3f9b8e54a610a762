#include "backend/launch.hpp"
#include "viscosity/pair_viscosity.hpp"
#include "viscosity/shear_stress.hpp"

namespace slagflow {

namespace {

template <class Box>
struct ShearStress {
  PairContext c;
  Box box;
  Real half_way;  // [s]
  Span<Real> result;

  // Adds f x^T, made symmetric, of a pair whose force is f per volume of i.
  HOST_DEVICE void add(Lanes weight, LaneVec3 d, LaneVec3 difference, SymmetricMatrix3<Lanes>& sum) const {
    const LaneVec3 f = couple(c.flow.coupling, weight, d, difference);
    sum.xx += f.x * d.x, sum.yy += f.y * d.y, sum.zz += f.z * d.z;
    sum.xy += Real(0.5) * (f.x * d.y + f.y * d.x);
    sum.xz += Real(0.5) * (f.x * d.z + f.z * d.x);
    sum.yz += Real(0.5) * (f.y * d.z + f.z * d.y);
  }

  HOST_DEVICE void operator()(Index i) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i])), v = in_lanes(xyz(c.fluid.motion[i]));
    // The laplacian's force carries eta grad v, whose symmetric part is half of 2 eta D.
    const Real half = c.flow.coupling == PairCoupling::radial ? Real(0.5) : Real(1);
    const Real factor = half * c.flow.operator_factor, own = c.fluid.state[i].y;
    SymmetricMatrix3<Lanes> sum;
    add_fluid(i, x, v, factor, own, sum);
    add_walls(i, x, v, factor * own * c.flow.wall_volume, sum);
    const Symmetric3 s = total(sum);
    const Real trace = s.xx + s.yy + s.zz;
    const Real squares = square(s.xx) + square(s.yy) + square(s.zz) +
                         2 * (square(s.xy) + square(s.xz) + square(s.yz)) -
                         square(trace) / static_cast<Real>(c.flow.dimensions);
    result[i] = std::sqrt(larger(Real(0), squares / 2));
  }

  HOST_DEVICE void add_fluid(Index i, LaneVec3 x, LaneVec3 v, Real factor, Real own,
                             SymmetricMatrix3<Lanes>& sum) const {
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.fluid.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const QuadLanes other = gather(c.fluid.state, j);
      const Lanes mean = pair_viscosity(c, i, Lanes(own), other.y, j);
      const Lanes weight = select(near, c.flow.smoothing.viscous(r2), Lanes(0));
      const LaneVec3 slip = v - xyz(gather(c.fluid.motion, j));
      add(factor * other.z * weight * mean, d - Lanes(half_way) * slip, slip, sum);
    }
  }

  // A wall particle bears what a fluid particle in its place would.
  HOST_DEVICE void add_walls(Index i, LaneVec3 x, LaneVec3 v, Real factor,
                             SymmetricMatrix3<Lanes>& sum) const {
    const ListRow row = c.wall_list.entries(i);
    const Index pairs = c.wall_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.wall.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const QuadLanes motion = gather(c.wall.velocity, j);
      const WallPairGeometry<Lanes, QuadLanes> pair{d, gather(c.wall.normal, j), gather(c.wall.back, j)};
      const Lanes stick = no_slip_factor(pair, c.flow.spacing, motion.w);
      const Lanes weight = factor * stick * select(near, c.flow.smoothing.viscous(r2), Lanes(0));
      add(select(motion.w < Lanes(0), Lanes(0), weight), d, v - xyz(motion), sum);
    }
  }
};

}  // namespace

void measure_shear_stress(Context& context, const PairContext& c, Real way, Span<Real> result) {
  auto sweep = [&](auto box) {
    launch(context, "shear stress", c.fluid.count, ShearStress<decltype(box)>{c, box, way / 2, result});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
