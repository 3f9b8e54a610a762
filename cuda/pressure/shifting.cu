#include "backend/launch.hpp"
#include "fluid/lane_math.hpp"
#include "fluid/melt.hpp"
#include "pressure/shifting.hpp"

namespace slagflow {

namespace {

struct Crowding {
  LaneVec3 gradient;           // of the concentration [1/m]
  Lanes fill = 0;              // d T
  Lanes nearest = Real(1e30);  // square of the distance of what it keeps off [m^2]
};

template <class Box>
struct Shift {
  PairContext c;
  Box box;
  ShiftStep step;
  Span<Vec3d> position;

  HOST_DEVICE void operator()(Index i) const {
    constexpr Real surface = Real(0.92), inside = Real(0.97), most = Real(0.024);
    if (c.fluid.melt.size > 0 && Melt(c.fluid.melt[i]).is_solid()) return;
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    Crowding sum;
    add(c.fluid_list, i, x, sum, c.fluid.place, false);
    add(c.wall_list, i, x, sum, c.wall.place, true);
    const Real fill = total(sum.fill) / static_cast<Real>(c.flow.dimensions),
               off = std::sqrt(least(sum.nearest)) / c.flow.spacing - Real(1);
    const Real share = ramp((fill - surface) / (inside - surface)) * ramp(off);
    const Real pace = damped(i) * smaller(step.amount * step.shear_rate[i] * step.dt, most);
    position[i] -= to_double((square(c.flow.support) * pace * share) * total(sum.gradient));
  }

  // Density takes no notice of the ways. What they do to it, and to the energy, viscosity must take: thin
  // fluid in a closed vessel would sink by and by.
  HOST_DEVICE Real damped(Index i) const {
    constexpr Real reference = 20;
    const Quad state = c.fluid.state[i];
    const Real inertia = state.w / state.z * step.shear_rate[i] * square(c.flow.support);
    return state.y / (state.y + inertia / reference);
  }

  HOST_DEVICE static Real ramp(Real x) { return smaller(Real(1), larger(Real(0), x)); }

  HOST_DEVICE void add(const ListView& list, Index i, LaneVec3 x, Crowding& sum, Span<const Quad> places,
                       bool walls) const {
    const ListRow row = list.entries(i);
    const Index pairs = list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      row.foresee(k);
      const QuadLanes there = gather(places, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const Lanes volume = select(near, walls ? Lanes(c.flow.wall_volume) : there.w, Lanes(0));
      sum.gradient += (volume * c.flow.smoothing.crowding_gradient(r2)) * d;
      sum.fill -= volume * c.flow.smoothing.gradient(r2) * r2;
      if (walls)
        sum.nearest = smaller(sum.nearest, select(near, r2, sum.nearest));
      else if (c.fluids.size > 1)
        sum.nearest = select(same(c.fluid.fluid, j, c.fluid.fluid[i]), sum.nearest,
                             select(near, Lanes(0), sum.nearest));
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
