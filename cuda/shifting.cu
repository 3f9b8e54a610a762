#include "backend/launch.hpp"
#include "lane_math.hpp"
#include "shifting.hpp"
#include "smoothing/lucy.hpp"

namespace slagflow {

namespace {

struct Crowding {
  LaneVec3 gradient;  // of the concentration [1/m]
  Lanes fill = 0;     // d T
};

template <class Smoothing, class Box>
struct Shift {
  PairContext c;
  Smoothing smoothing;
  Box box;
  Real amount, dt;
  Span<const Real> shear_rate;
  Span<Vec3d> position;

  HOST_DEVICE void operator()(Index i) const {
    constexpr Real surface = Real(0.92), inside = Real(0.97), most_strain = Real(0.1);
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    Crowding sum;
    add(c.fluid_list, i, x, sum, c.fluid.place,
        [this](const QuadLanes& place, LaneMask near) { return select(near, place.w, Lanes(0)); });
    add(c.wall_list, i, x, sum, c.wall.place, [this](const QuadLanes&, LaneMask near) {
      return select(near, Lanes(c.flow.wall_volume), Lanes(0));
    });
    const Real fill = total(sum.fill) / static_cast<Real>(c.flow.dimensions);
    const Real share = smaller(Real(1), larger(Real(0), (fill - surface) / (inside - surface)));
    const Real strain = smaller(shear_rate[i] * dt, most_strain);
    position[i] -= to_double((amount * square(c.flow.support) * strain * share) * total(sum.gradient));
  }

  template <class Volume>
  HOST_DEVICE void add(const ListView& list, Index i, LaneVec3 x, Crowding& sum, Span<const Quad> places,
                       Volume volume) const {
    const Offset first = list.row(i);
    const Index pairs = list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const QuadLanes there = gather(places, &list.entry[first + k * ListView::stride()]);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const Lanes weight = volume(there, near) * smoothing.gradient(root(r2));
      sum.gradient += weight * d;
      sum.fill -= weight * r2;
    }
  }
};

}  // namespace

void shift_particles(Context& context, const PairContext& c, Real amount, Real dt,
                     Span<const Real> shear_rate, Span<Vec3d> position, const SolveState* solve) {
  const Lucy smoothing(c.flow.support, c.flow.dimensions);
  auto sweep = [&](auto box) {
    launch(
        context, "shifting", c.fluid.count,
        if_converged(solve, Shift<Lucy, decltype(box)>{c, smoothing, box, amount, dt, shear_rate, position}));
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
