#include "fluid/constants.hpp"
#include "fluid/diagnostic_sums.hpp"
#include "observation/diagnostics.hpp"

namespace slagflow {

namespace {

// Bodies: one number of particle i each.
struct KineticEnergy {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Quad> motion;
  HOST_DEVICE double operator()(Index i) const {
    const Vec3d v = to_double(xyz(motion[i]));
    return 0.5 * static_cast<double>(fluids[kind[i]].mass) * dot(v, v);
  }
};

struct PotentialEnergy {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Vec3d> position;
  Vec3d force, origin;
  HOST_DEVICE double operator()(Index i) const {
    return -static_cast<double>(fluids[kind[i]].mass) * dot(force, position[i] + origin);
  }
};

// Of the equation of state: int p m/rho^2 d rho = m c0^2 [ln(1 + s) - s/(1 + s)], s = rho/rho0 - 1, about
// m c0^2 s^2/2; no more of it beyond the tension limit.
struct ElasticEnergy {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Quad> motion;
  double sound_speed, tension_limit;
  HOST_DEVICE double operator()(Index i) const {
    const FluidConstants& f = fluids[kind[i]];
    const auto rest = static_cast<double>(f.rest_density);
    const double least = -tension_limit / (rest * square(sound_speed));
    const double strain = larger(least, static_cast<double>(motion[i].w) / rest);
    // The difference of small strains as a series, s^2/2 - 2 s^3/3 + 3 s^4/4.
    const double energy = std::fabs(strain) < 1e-3
                              ? square(strain) * (0.5 - strain * (2.0 / 3 - 0.75 * strain))
                              : std::log1p(strain) - strain / (1 + strain);
    return static_cast<double>(f.mass) * square(sound_speed) * energy;
  }
};

struct PressureEnergy {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Real> pressure;
  HOST_DEVICE double operator()(Index i) const {
    const FluidConstants& f = fluids[kind[i]];
    return static_cast<double>(magnitude(pressure[i]) * f.mass / f.rest_density);
  }
};

struct Momentum {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Quad> motion;
  int axis;
  HOST_DEVICE double operator()(Index i) const {
    return static_cast<double>(fluids[kind[i]].mass) * to_double(xyz(motion[i]))[axis];
  }
};

struct AngularMomentum {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Vec3d> position;
  Span<const Quad> motion;
  Vec3d origin;
  int axis;
  HOST_DEVICE double operator()(Index i) const {
    return static_cast<double>(fluids[kind[i]].mass) *
           cross(position[i] + origin, to_double(xyz(motion[i])))[axis];
  }
};

struct IsFluid {
  Span<const std::uint8_t> kind;
  int wanted;
  HOST_DEVICE double operator()(Index i) const { return kind[i] == wanted ? 1 : 0; }
};

struct SpeedSquared {
  Span<const Quad> motion;
  HOST_DEVICE Real operator()(Index i) const { return dot(xyz(motion[i]), xyz(motion[i])); }
};

struct Compression {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Quad> motion;
  Real sign;
  HOST_DEVICE Real operator()(Index i) const { return sign * fluids[kind[i]].compression(motion[i].w); }
};

// 1, or a coordinate, of the particles beyond a plane; else 0.
struct Beyond {
  Span<const Vec3d> position;
  int axis, sign;
  double line;
  int coordinate;  // -1: count
  HOST_DEVICE double operator()(Index i) const {
    if (sign * (position[i][axis] - line) <= 0) return 0;
    return coordinate < 0 ? 1.0 : position[i][coordinate];
  }
};

struct Lead {
  Span<const Vec3d> position;
  int axis, sign;
  HOST_DEVICE Real operator()(Index i) const { return static_cast<Real>(sign * position[i][axis]); }
};

struct CountWithinSupport {
  PairContext c;
  HOST_DEVICE double count(Index i, const ListView& list, Span<const Quad> place) const {
    int n = 0;
    const ListRow row = list.entries(i);
    for (Index k = 0; k < list.length[i]; ++k) {
      const Vec3 d = c.box.separation(xyz(c.fluid.place[i]), xyz(place[row.one(k)]));
      if (dot(d, d) < square(c.flow.support)) ++n;
    }
    return n;
  }
  HOST_DEVICE double operator()(Index i) const {
    return count(i, c.fluid_list, c.fluid.place) + count(i, c.wall_list, c.wall.place);
  }
};

template <class A, class B>
struct PairOfTerms {
  static constexpr int terms = 2;
  A a;
  B b;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    return {{static_cast<double>(a(i)), static_cast<double>(b(i))}};
  }
};

template <class A, class B, class C, class D>
struct FourTerms {
  static constexpr int terms = 4;
  A a;
  B b;
  C c;
  D d;
  HOST_DEVICE Terms<4> operator()(Index i) const { return {{a(i), b(i), c(i), d(i)}}; }
};

template <class Term>
struct From {
  Term term;
  Index first;
  HOST_DEVICE double operator()(Index i) const { return term(first + i); }
};

// From the lowest point of the domain.
PotentialEnergy potential_energy(const FluidArrays& f, Span<const FluidConstants> fluids,
                                 const SimulationSetup& setup) {
  const Vec3d force = setup.gravity + setup.body_acceleration;
  Vec3d lowest;  // relative to its lower corner
  for (int k = 0; k < 3; ++k) lowest[k] = force[k] > 0 ? setup.domain.upper[k] - setup.domain.lower[k] : 0;
  return {fluids, f.fluid.span(), f.position.span(), force, -lowest};
}

FrontState measure_front(Context& c, const FluidArrays& f, const FrontSetup& front, Vec3d origin,
                         DiagnosticScratch& scratch) {
  FrontState state;
  const double line = front.position - origin[front.axis];
  auto beyond = [&](int coordinate) {
    return total(c, scratch, f.count, Beyond{f.position.span(), front.axis, front.sign, line, coordinate});
  };
  const double count = beyond(-1);
  state.passed = static_cast<std::int64_t>(count);
  if (count > 0)
    for (int k = 0; k < 3; ++k) state.mean_position[k] = beyond(k) / count + origin[k];
  if (f.count.of_all() > 0)
    state.extreme =
        front.sign * largest(c, scratch, f.count, Lead{f.position.span(), front.axis, front.sign}) +
        origin[front.axis];
  return state;
}

}  // namespace

Totals measure_totals(Context& c, const FluidArrays& f, Span<const FluidConstants> fluids,
                      const SimulationSetup& setup, DiagnosticScratch& scratch) {
  Totals t;
  const Rows n = f.count;
  const auto position = f.position.span();
  const auto motion = f.motion.span();
  const auto kind = f.fluid.span();
  const Vec3d origin = setup.domain.lower;
  for (std::size_t k = 0; k < setup.fluids.size(); ++k)
    t.mass_in += total(c, scratch, n, IsFluid{kind, static_cast<int>(k)}) * particle_mass(setup, k);
  t.fronts.resize(setup.fronts.size());
  for (std::size_t k = 0; k < setup.fronts.size(); ++k)
    t.fronts[k] = measure_front(c, f, setup.fronts[k], origin, scratch);
  if (n.of_all() == 0) return t;
  t.kinetic_energy = total(c, scratch, n, KineticEnergy{fluids, kind, motion});
  t.potential_energy =
      total(c, scratch, n,
            PotentialEnergy{fluids, kind, position, setup.gravity + setup.body_acceleration, origin});
  for (int k = 0; k < 3; ++k) {
    t.momentum[k] = total(c, scratch, n, Momentum{fluids, kind, motion, k});
    t.angular_momentum[k] = total(c, scratch, n, AngularMomentum{fluids, kind, position, motion, origin, k});
  }
  t.max_speed = std::sqrt(largest(c, scratch, n, SpeedSquared{motion}));
  t.max_density_error = larger(0.0, largest(c, scratch, n, Compression{fluids, kind, motion, 1}));
  t.min_density_ratio = 1 - largest(c, scratch, n, Compression{fluids, kind, motion, -1});
  return t;
}

double energy_from(Context& c, Index first, const FluidArrays& f, Span<const FluidConstants> fluids,
                   const SimulationSetup& setup, DiagnosticScratch& scratch) {
  const auto motion = f.motion.span();
  const auto kind = f.fluid.span();
  const Index n = f.count - first;
  return total(c, scratch, n, From<KineticEnergy>{{fluids, kind, motion}, first}) +
         total(c, scratch, n, From<PotentialEnergy>{potential_energy(f, fluids, setup), first}) +
         total(c, scratch, n,
               From<ElasticEnergy>{
                   {fluids, kind, motion, setup.numerics.sound_speed, setup.numerics.tension_limit}, first});
}

Vitals measure_vitals(Context& c, const FluidArrays& f, Span<const FluidConstants> fluids,
                      const SimulationSetup& setup, DiagnosticScratch& scratch) {
  const Rows n = f.count;
  const auto motion = f.motion.span();
  const auto kind = f.fluid.span();
  const auto most = reduce_terms<TakeLargest>(
      c, scratch, n, PairOfTerms<SpeedSquared, Compression>{{motion}, {fluids, kind, motion, 1}});
  const auto energy = reduce_terms<AddUp>(
      c, scratch, n,
      FourTerms<KineticEnergy, PotentialEnergy, ElasticEnergy, PressureEnergy>{
          {fluids, kind, motion},
          potential_energy(f, fluids, setup),
          {fluids, kind, motion, setup.numerics.sound_speed, setup.numerics.tension_limit},
          {fluids, kind, f.pressure.span()}});
  Vitals v;
  v.max_speed = std::sqrt(most.value[0]);
  v.max_compression = most.value[1];
  v.kinetic_energy = energy.value[0];
  v.elastic_energy = energy.value[2], v.stored_energy = energy.value[1] + v.elastic_energy;
  v.pressure_energy = energy.value[3];
  return v;
}

double mean_neighbours(Context& context, const PairContext& c, DiagnosticScratch& scratch) {
  const Index all = c.fluid.count.of_all();
  if (all == 0) return 0;
  return total(context, scratch, c.fluid.count, CountWithinSupport{c}) / all;
}

}  // namespace slagflow
