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

struct Momenta {
  static constexpr int terms = 6;
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> kind;
  Span<const Vec3d> position;
  Span<const Quad> motion;
  Vec3d origin;
  HOST_DEVICE Terms<6> operator()(Index i) const {
    const auto mass = static_cast<double>(fluids[kind[i]].mass);
    const Vec3d v = to_double(xyz(motion[i])), turn = cross(position[i] + origin, v);
    return {{mass * v.x, mass * v.y, mass * v.z, mass * turn.x, mass * turn.y, mass * turn.z}};
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
  HOST_DEVICE Real operator()(Index i) const { return fluids[kind[i]].compression(motion[i].w); }
};

// Of the particles beyond a plane 1 and the coordinates, else 0.
struct Beyond {
  static constexpr int terms = 4;
  Span<const Vec3d> position;
  int axis, sign;
  double line;
  HOST_DEVICE Terms<4> operator()(Index i) const {
    const Vec3d x = position[i];
    if (sign * (x[axis] - line) <= 0) return {{0, 0, 0, 0}};
    return {{1, x.x, x.y, x.z}};
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

template <class A, class B, class C, class D>
struct FourTerms {
  static constexpr int terms = 4;
  A a;
  B b;
  C c;
  D d;
  HOST_DEVICE Terms<4> operator()(Index i) const { return {{a(i), b(i), c(i), d(i)}}; }
};

// Squared speed, compression, expansion.
struct Extremes {
  static constexpr int terms = 3;
  SpeedSquared speed;
  Compression compression;
  HOST_DEVICE Terms<3> operator()(Index i) const {
    const auto strain = static_cast<double>(compression(i));
    return {{static_cast<double>(speed(i)), strain, -strain}};
  }
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

void gather_front(GatheredSums& sums, const FluidArrays& f, const FrontSetup& front, Vec3d origin,
                  FrontState& state) {
  const double line = front.position - origin[front.axis];
  gather_terms<AddUp>(sums, f.count, Beyond{f.position.span(), front.axis, front.sign, line},
                      [&state, origin](const Terms<4>& all) {
                        const double count = all.value[0];
                        state.passed = static_cast<std::int64_t>(count);
                        for (int k = 0; count > 0 && k < 3; ++k)
                          state.mean_position[k] = all.value[k + 1] / count + origin[k];
                      });
  if (f.count.of_all() == 0) return;
  gather_terms<TakeLargest>(sums, f.count, OneTerm<Lead>{{f.position.span(), front.axis, front.sign}},
                            [&state, front, origin](const Terms<1>& all) {
                              state.extreme = front.sign * all.value[0] + origin[front.axis];
                            });
}

}  // namespace

void gather_totals(GatheredSums& sums, const FluidArrays& f, Span<const FluidConstants> fluids,
                   const SimulationSetup& setup, Totals& t) {
  const Rows n = f.count;
  const auto motion = f.motion.span();
  const auto kind = f.fluid.span();
  const Vec3d origin = setup.domain.lower;
  for (std::size_t k = 0; k < setup.fluids.size(); ++k)
    gather_total(sums, n, IsFluid{kind, static_cast<int>(k)},
                 [&t, mass = particle_mass(setup, k)](double count) { t.mass_in += count * mass; });
  t.fronts.resize(setup.fronts.size());
  for (std::size_t k = 0; k < setup.fronts.size(); ++k)
    gather_front(sums, f, setup.fronts[k], origin, t.fronts[k]);
  if (n.of_all() == 0) return;
  const PotentialEnergy potential{fluids, kind, f.position.span(), setup.gravity + setup.body_acceleration,
                                  origin};
  gather_terms<AddUp>(
      sums, n, PairOfTerms<KineticEnergy, PotentialEnergy>{{fluids, kind, motion}, potential},
      [&t](const Terms<2>& all) { t.kinetic_energy = all.value[0], t.potential_energy = all.value[1]; });
  gather_terms<AddUp>(sums, n, Momenta{fluids, kind, f.position.span(), motion, origin},
                      [&t](const Terms<6>& all) {
                        t.momentum = {all.value[0], all.value[1], all.value[2]};
                        t.angular_momentum = {all.value[3], all.value[4], all.value[5]};
                      });
  gather_terms<TakeLargest>(sums, n, Extremes{{motion}, {fluids, kind, motion}}, [&t](const Terms<3>& most) {
    t.max_speed = std::sqrt(most.value[0]);
    t.max_density_error = larger(0.0, most.value[1]);
    t.min_density_ratio = 1 - most.value[2];
  });
}

double energy_from(Context& c, Index first, const FluidArrays& f, Span<const FluidConstants> fluids,
                   const SimulationSetup& setup, DiagnosticScratch& scratch) {
  const auto motion = f.motion.span();
  const auto kind = f.fluid.span();
  const Index n = f.count - first;
  GatheredSums sums(c, scratch);
  double energy = 0;
  const auto add = [&energy](double part) { energy += part; };
  gather_total(sums, n, From<KineticEnergy>{{fluids, kind, motion}, first}, add);
  gather_total(sums, n, From<PotentialEnergy>{potential_energy(f, fluids, setup), first}, add);
  const ElasticEnergy elastic{fluids, kind, motion, setup.numerics.sound_speed, setup.numerics.tension_limit};
  gather_total(sums, n, From<ElasticEnergy>{elastic, first}, add);
  sums.read();
  return energy;
}

void gather_vitals(GatheredSums& sums, const FluidArrays& f, Span<const FluidConstants> fluids,
                   const SimulationSetup& setup, Vitals& v) {
  const Rows n = f.count;
  const auto motion = f.motion.span();
  const auto kind = f.fluid.span();
  gather_terms<TakeLargest>(sums, n, PairOfTerms<SpeedSquared, Compression>{{motion}, {fluids, kind, motion}},
                            [&v](const Terms<2>& most) {
                              v.max_speed = std::sqrt(most.value[0]);
                              v.max_compression = most.value[1];
                            });
  gather_terms<AddUp>(sums, n,
                      FourTerms<KineticEnergy, PotentialEnergy, ElasticEnergy, PressureEnergy>{
                          {fluids, kind, motion},
                          potential_energy(f, fluids, setup),
                          {fluids, kind, motion, setup.numerics.sound_speed, setup.numerics.tension_limit},
                          {fluids, kind, f.pressure.span()}},
                      [&v](const Terms<4>& energy) {
                        v.kinetic_energy = energy.value[0];
                        v.elastic_energy = energy.value[2],
                        v.stored_energy = energy.value[1] + v.elastic_energy;
                        v.pressure_energy = energy.value[3];
                      });
}

double mean_neighbours(Context& context, const PairContext& c, DiagnosticScratch& scratch) {
  const Index all = c.fluid.count.of_all();
  if (all == 0) return 0;
  return total(context, scratch, c.fluid.count, CountWithinSupport{c}) / all;
}

}  // namespace slagflow
