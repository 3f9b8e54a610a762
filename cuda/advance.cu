#include "advance.hpp"
#include "backend/launch.hpp"
#include "backend/primitives.hpp"

namespace slagflow {

namespace {

struct AdvanceParticle {
  Span<const Quad> velocity, reference;
  double dt;
  Span<Vec3d> position;
  Span<Quad> place, motion;
  Span<Real> displacement_squared;
  HOST_DEVICE void operator()(Index i) const {
    const Vec3 v = xyz(velocity[i]);
    const Vec3d x = position[i] + dt * to_double(v);
    const Vec3 rounded = to_real(x);
    position[i] = x;
    place[i] = quad(rounded, place[i].w);
    motion[i] = quad(v, motion[i].w);
    const Vec3 moved = rounded - xyz(reference[i]);
    displacement_squared[i] = dot(moved, moved);
  }
};

struct SpeedSquared {
  Span<const Quad> motion;
  Span<Real> result;
  HOST_DEVICE void operator()(Index i) const { result[i] = dot(xyz(motion[i]), xyz(motion[i])); }
};

// eta V / m
struct Diffusivity {
  Span<const Quad> state;
  Span<Real> value;
  HOST_DEVICE void operator()(Index i) const { value[i] = state[i].y * state[i].z / state[i].w; }
};

}  // namespace

double advance_particles(Context& context, FluidArrays& f, SolvedVelocity solved,
                         const Buffer<Quad>& reference, Buffer<Real>& scratch) {
  scratch.resize(f.count);
  launch(context, "advance", f.count,
         AdvanceParticle{solved.velocity, reference.span(), solved.dt, f.position.span(), f.place.span(),
                         f.motion.span(), scratch.span()});
  return std::sqrt(maximum(context, scratch.span(), 0));
}

double largest_speed(Context& context, const FluidArrays& f, Buffer<Real>& scratch) {
  scratch.resize(f.count);
  launch(context, "speed", f.count, SpeedSquared{f.motion.span(), scratch.span()});
  return std::sqrt(maximum(context, scratch.span(), 0));
}

double largest_diffusivity(Context& context, const FluidArrays& f, Buffer<Real>& scratch) {
  scratch.resize(f.count);
  launch(context, "diffusivity", f.count, Diffusivity{f.state.span(), scratch.span()});
  return maximum(context, scratch.span(), 0);
}

}  // namespace slagflow
