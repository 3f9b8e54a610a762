#include "fluid/diagnostic_sums.hpp"
#include "simulation/advance.hpp"

namespace slagflow {

namespace {

struct AdvanceParticle {
  static constexpr int terms = 3;
  Move move;
  Span<const std::uint8_t> kind;
  Span<Vec3d> position;
  Span<Quad> place, motion;
  HOST_DEVICE Terms<3> operator()(Index i) const {
    const Vec3 v = xyz(move.velocity[i]);
    const Vec3d x = position[i] + move.dt * to_double(v);
    const Vec3 rounded = to_real(x);
    position[i] = x;
    place[i] = quad(rounded, place[i].w);
    const Real excess = motion[i].w;
    motion[i] = quad(v, excess);
    const Vec3 moved = rounded - xyz(move.reference[i]);
    return {{static_cast<double>(dot(moved, moved)),
             static_cast<double>(move.fluids[kind[i]].compression(excess)), static_cast<double>(dot(v, v))}};
  }
};

struct KeepLargest {
  StepRecord* record;
  HOST_DEVICE void operator()(const Terms<3>& largest) const {
    record->displacement_squared = larger(largest.value[0], 0.0);
    record->compression = larger(largest.value[1], 0.0);
    record->speed_squared = larger(largest.value[2], 0.0);
    record->worn = 0;
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

void advance_particles(Context& context, FluidArrays& f, const Move& move, StepRecord* record) {
  const AdvanceParticle body{move, f.fluid.span(), f.position.span(), f.place.span(), f.motion.span()};
  launch_reduction<TakeLargest>(context, "advance", f.count, if_converged(&record->solve, body),
                                KeepLargest{record});
}

double largest_speed(Context& context, const FluidArrays& f, DiagnosticScratch& scratch) {
  return std::sqrt(larger(largest(context, scratch, f.count, SpeedSquared{f.motion.span()}), 0.0));
}

double largest_diffusivity(Context& context, const FluidArrays& f, DiagnosticScratch& scratch) {
  return larger(largest(context, scratch, f.count, Diffusivity{f.state.span()}), 0.0);
}

}  // namespace slagflow
