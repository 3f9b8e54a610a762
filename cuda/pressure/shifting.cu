#include "backend/launch.hpp"
#include "fluid/lane_math.hpp"
#include "pressure/shifting.hpp"

namespace slagflow {

namespace {

struct Crowding {
  LaneVec3 gradient;  // of the concentration [1/m]
  Lanes fill = 0;     // d T
};

template <class Box>
struct Shift {
  PairContext c;
  Box box;
  ShiftStep step;
  Span<Vec3d> position;

  HOST_DEVICE void operator()(Index i) const {
    constexpr Real surface = Real(0.92), inside = Real(0.97), most_strain = Real(0.1);
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    Crowding sum;
    add(c.fluid_list, i, x, sum, c.fluid.place, false);
    add(c.wall_list, i, x, sum, c.wall.place, true);
    const Real fill = total(sum.fill) / static_cast<Real>(c.flow.dimensions);
    const Real share = smaller(Real(1), larger(Real(0), (fill - surface) / (inside - surface)));
    const Real strain = smaller(step.shear_rate[i] * step.dt, most_strain);
    position[i] -= to_double((step.amount * square(c.flow.support) * strain * share) * total(sum.gradient));
  }

  HOST_DEVICE void add(const ListView& list, Index i, LaneVec3 x, Crowding& sum, Span<const Quad> places,
                       bool walls) const {
    const Offset first = list.row(i);
    const Index pairs = list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const QuadLanes there = gather(places, &list.entry[first + k * ListView::stride()]);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const Lanes volume = walls ? Lanes(c.flow.wall_volume) : there.w;
      const Lanes weight = select(near, volume * c.flow.smoothing.gradient(r2), Lanes(0));
      sum.gradient += weight * d;
      sum.fill -= weight * r2;
    }
  }
};

}  // namespace

void shift_particles(Context& context, const PairContext& c, const ShiftStep& step, Span<Vec3d> position) {
  auto sweep = [&](auto box) {
    launch(context, "shifting", c.fluid.count,
           if_converged(step.solve, Shift<decltype(box)>{c, box, step, position}));
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
