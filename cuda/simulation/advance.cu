#include "fluid/diagnostic_sums.hpp"
#include "simulation/advance.hpp"

namespace slagflow {

namespace {

struct AdvanceParticle {
  static constexpr int terms = 1;
  Span<const Quad> velocity, reference;
  double dt;
  Span<Vec3d> position;
  Span<Quad> place, motion;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    const Vec3 v = xyz(velocity[i]);
    const Vec3d x = position[i] + dt * to_double(v);
    const Vec3 rounded = to_real(x);
    position[i] = x;
    place[i] = quad(rounded, place[i].w);
    motion[i] = quad(v, motion[i].w);
    const Vec3 moved = rounded - xyz(reference[i]);
    return {{static_cast<double>(dot(moved, moved))}};
  }
};

struct KeepDisplacement {
  StepRecord* record;
  HOST_DEVICE void operator()(const Terms<1>& largest) const {
    record->displacement_squared = larger(largest.value[0], 0.0);
  }
};

struct SpeedSquared {
  Span<const Quad> motion;
  HOST_DEVICE Real operator()(Index i) const { return dot(xyz(motion[i]), xyz(motion[i])); }
};

// eta V / m
struct Diffusivity {
  Span<const Quad> state;
  HOST_DEVICE Real operator()(Index i) const { return state[i].y * state[i].z / state[i].w; }
};

}  // namespace

void advance_particles(Context& context, FluidArrays& f, SolvedVelocity solved, const Buffer<Quad>& reference,
                       StepRecord* record) {
  const AdvanceParticle body{solved.velocity,   reference.span(), solved.dt,
                             f.position.span(), f.place.span(),   f.motion.span()};
  launch_reduction<TakeLargest>(context, "advance", f.count, if_converged(&record->solve, body),
                                KeepDisplacement{record});
}

double largest_speed(Context& context, const FluidArrays& f, DiagnosticScratch& scratch) {
  return std::sqrt(larger(largest(context, scratch, f.count, SpeedSquared{f.motion.span()}), 0.0));
}

double largest_diffusivity(Context& context, const FluidArrays& f, DiagnosticScratch& scratch) {
  return larger(largest(context, scratch, f.count, Diffusivity{f.state.span()}), 0.0);
}

}  // namespace slagflow
