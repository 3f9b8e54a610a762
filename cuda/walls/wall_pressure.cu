#include "backend/launch.hpp"
#include "smoothing/lucy.hpp"
#include "walls/wall_pressure.hpp"

namespace slagflow {

namespace {

template <class Smoothing, class Box>
struct WallPressure {
  PairContext c;
  ListView list;
  Smoothing smoothing;
  Box box;
  Span<Real> pressure;

  HOST_DEVICE void operator()(Index w) const {
    const Vec3 x = xyz(c.wall.place[w]);
    const Offset first = list.row(w);
    Real weights = 0, sum = 0;
    for (Index k = 0; k < list.length[w]; ++k) {
      const Index f = list.entry[first + k * ListView::stride()];
      const Vec3 d = box.separation(x, xyz(c.fluid.place[f]));
      const Real weight = smoothing.value(norm(d));
      const Real density = c.fluids[c.fluid.fluid[f]].rest_density + c.fluid.motion[f].w;
      weights += weight;
      sum += weight * (c.fluid.pressure[f] + density * dot(c.flow.gravity, d));
    }
    pressure[w] = weights > 0 ? larger(sum / weights, -c.flow.tension_limit) : Real(0);
  }
};

}  // namespace

void extrapolate_wall_pressure(Context& context, const PairContext& c, const ListView& list,
                               WallArrays& wall) {
  const Lucy smoothing(c.flow.support, c.flow.dimensions);
  auto sweep = [&](auto box) {
    launch(context, "wall pressure", wall.count,
           WallPressure<Lucy, decltype(box)>{c, list, smoothing, box, wall.pressure.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
