#include "backend/launch.hpp"
#include "predictor.hpp"
#include "smoothing/lucy.hpp"

namespace slagflow {

namespace {

template <class Smoothing, class Box>
struct PredictAndAssemble {
  PairContext c;
  Smoothing smoothing;
  Box box;
  Real dt, implicit_dt;  // implicit_dt = theta dt
  PredictorOutput out;

  // Pressure part of a pair; both signs of pressure keep a pair apart when it is closer than the spacing.
  HOST_DEVICE Real pressure_term(Real own, Real other, Real r) const {
    Real sum = own + other;
    if (r < c.flow.spacing) {
      const Real ratio = smoothing.value(r) * c.flow.pairing_reference;
      sum += c.flow.anti_pairing * (square(square(ratio)) - 1) * (std::fabs(own) + std::fabs(other));
    }
    return sum;
  }

  HOST_DEVICE Vec3 pair_diagonal(Vec3 s) const {
    if (c.flow.coupling == PairCoupling::radial) return {square(s.x), square(s.y), square(s.z)};
    const Real weight = dot(s, s);
    return {weight, weight, weight};
  }

  HOST_DEVICE void operator()(Index i) const {
    const Vec3 x = xyz(c.fluid.place[i]);
    const Quad own = c.fluid.state[i];
    const Real h2 = square(c.flow.support);
    const Real factor = implicit_dt * c.flow.operator_factor * own.z;
    Vec3 acceleration = c.flow.gravity + c.flow.body_acceleration;
    Vec3 diagonal{own.w, own.w, own.w};

    const Offset first = c.fluid_list.row(i);
    Offset at = first;
    const Index entries = c.fluid_list.length[i];
    for (Index k = 0; k < entries; ++k) {
      const Index j = c.fluid_list.entry[first + k * ListView::stride()];
      const Vec3 d = box.separation(x, xyz(c.fluid.place[j]));
      const Real r2 = dot(d, d);
      if (r2 >= h2) continue;
      const Quad other = c.fluid.state[j];
      const Real r = std::sqrt(r2);
      const Real f = smoothing.gradient(r);
      acceleration -= (other.w * pressure_term(own.x, other.x, r) * f) * d;
      const Real mean = 2 * own.y * other.y / (own.y + other.y);
      const Vec3 s = std::sqrt(-factor * mean * other.z * f / (r2 + c.flow.softening)) * d;
      diagonal += pair_diagonal(s);
      out.link[at] = {s, j};
      at += ListView::stride();
    }
    out.length[i] = static_cast<Index>((at - first) / ListView::stride());
    walls(i, x, own, acceleration, diagonal);
  }

  HOST_DEVICE void walls(Index i, Vec3 x, Quad own, Vec3 acceleration, Vec3 diagonal) const {
    const Real rest_density = c.fluids[c.fluid.fluid[i]].rest_density;
    const Real factor = implicit_dt * c.flow.operator_factor * own.z * own.y * c.flow.wall_volume;
    Symmetric3 block;
    Vec3 drag;
    const Offset first = c.wall_list.row(i);
    for (Index k = 0; k < c.wall_list.length[i]; ++k) {
      const Index j = c.wall_list.entry[first + k * ListView::stride()];
      const Vec3 d = box.separation(x, xyz(c.wall.place[j]));
      const Real r2 = dot(d, d);
      if (r2 >= square(c.flow.support)) continue;
      const Real r = std::sqrt(r2);
      const Real f = smoothing.gradient(r);
      const Real density = rest_density + c.wall.pressure[j] / c.flow.sound_speed_squared;
      const Real other = c.wall.pressure[j] / square(density);
      acceleration -= (own.w * pressure_term(own.x, other, r) * f) * d;
      const Quad motion = c.wall.velocity[j];
      if (motion.w == 0) continue;
      const Real stick = no_slip_factor(d, c.wall.normal[j], c.wall.back[j], c.flow.spacing);
      const Vec3 s = std::sqrt(-factor * stick * f / (r2 + c.flow.softening)) * d;
      add_coupling(c.flow.coupling, s, block);
      drag += couple(c.flow.coupling, s, xyz(motion));
    }
    const Vec3 predicted = xyz(c.fluid.motion[i]) + dt * acceleration;
    diagonal += Vec3{block.xx, block.yy, block.zz};
    out.predicted[i] = quad(predicted, 0);
    out.wall[i] = block;
    out.diagonal[i] = quad(diagonal, own.w);
    out.right_hand_side[i] = quad(own.w * predicted + drag, 0);
  }
};

}  // namespace

void predict_and_assemble(Context& context, const PairContext& c, const PredictorOutput& out, Real dt,
                          Real theta) {
  const Lucy smoothing(c.flow.support, c.flow.dimensions);
  auto sweep = [&](auto box) {
    launch(context, "predictor and assembly", c.fluid.count,
           PredictAndAssemble<Lucy, decltype(box)>{c, smoothing, box, dt, theta * dt, out});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
