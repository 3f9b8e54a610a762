#include <limits>

#include "fluid/diagnostic_sums.hpp"
#include "observation/around_point.hpp"
#include "observation/measures.hpp"

namespace slagflow {

namespace {

constexpr double least_fill = 0.25;  // of the support around a point of a profile

struct Plane {
  int axis, sign;
  Real place;
  HOST_DEVICE bool beyond(Quad q) const { return sign > 0 ? xyz(q)[axis] > place : xyz(q)[axis] < place; }
};

// How often particle i has passed since `before`, against the direction counted as negative.
struct Crossings {
  Span<const Quad> before, now;
  Plane plane;
  Real period;  // 0: none
  HOST_DEVICE double operator()(Index i) const {
    if (period == 0) return (plane.beyond(now[i]) ? 1 : 0) - (plane.beyond(before[i]) ? 1 : 0);
    const Real from = std::floor((xyz(before[i])[plane.axis] - plane.place) / period);
    const Real to = std::floor((xyz(now[i])[plane.axis] - plane.place) / period);
    return plane.sign * static_cast<double>(to - from);
  }
};

struct Behind {
  Span<const Quad> now;
  Plane plane;
  HOST_DEVICE double operator()(Index i) const { return plane.beyond(now[i]) ? 0 : 1; }
};

// Behind the plane, and about to be dropped because it has left the domain or is in an outlet.
struct LostBehind {
  Span<const Vec3d> position;
  Span<const Quad> now;
  Plane plane;
  Vec3d extent;
  bool periodic[3];
  Span<const OutletBox> outlets;
  HOST_DEVICE double operator()(Index i) const {
    const Vec3d x = position[i];
    bool lost = outlet_at(outlets, x) >= 0;
    for (int k = 0; k < 3; ++k) lost = lost || (!periodic[k] && !(x[k] >= 0 && x[k] <= extent[k]));
    return lost && !plane.beyond(now[i]) ? 1 : 0;
  }
};

struct InBox {
  Span<const Vec3d> position;
  Vec3d lower, upper;
  HOST_DEVICE double operator()(Index i) const {
    const Vec3d x = position[i];
    for (int k = 0; k < 3; ++k)
      if (!(x[k] >= lower[k] && x[k] < upper[k])) return 0;
    return 1;
  }
};

struct SolidInBox {
  InBox box;
  Span<const Quad> heat;
  Real fraction;
  HOST_DEVICE double operator()(Index i) const { return heat[i].w >= fraction ? box(i) : 0; }
};

// Weighted sums of a quantity and of its products with the distance from the point.
struct Moments {
  double plain = 0;
  Vec3d first;
  HOST_DEVICE void add(double weight, double value, Vec3d distance) {
    plain += weight * value;
    first += weight * value * distance;
  }
};

// Inverse of the weights' second moments times a vector, by Cramer's rule.
struct SecondMoments {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  HOST_DEVICE void add(double w, Vec3d d) {
    xx += w * d.x * d.x, yy += w * d.y * d.y, zz += w * d.z * d.z;
    xy += w * d.x * d.y, xz += w * d.x * d.z, yz += w * d.y * d.z;
  }
  HOST_DEVICE Vec3d solve(Vec3d b) const {
    const Vec3d r0{xx, xy, xz}, r1{xy, yy, yz}, r2{xz, yz, zz};
    const double determinant = dot(r0, cross(r1, r2));
    return {dot(b, cross(r1, r2)) / determinant, dot(r0, cross(b, r2)) / determinant,
            dot(r0, cross(r1, b)) / determinant};
  }
};

// Fields in the order of ProfilePoint: velocity, shear rate, viscosity, temperature, solid fraction; and the
// fill.
constexpr int profile_fields = 7;
struct Sample {
  double field[profile_fields];
  double fill;
};

struct InterpolateAtPoint {
  AroundPoint around;
  Span<const Quad> motion, state;
  Span<const Quad> heat;  // may be empty
  Span<const Real> shear_rate;
  Real inverse_support;
  Span<const Quad> point;
  Span<Sample> result;

  // The distance from point to particle in units of the support keeps the moments of order one.
  template <class Visit>
  HOST_DEVICE void for_particles(Vec3 at, Visit visit) const {
    around.for_particles(at, [&](Index j, Vec3 d, Real r2) {
      visit(j, static_cast<double>(state[j].z * around.W.value(r2)), to_double(inverse_support * d));
    });
  }

  HOST_DEVICE void operator()(Index i) const {
    constexpr double ridge = 1e-6;  // for the axis that has no extent in two dimensions
    Moments weights, fields[profile_fields];
    SecondMoments second;
    for_particles(xyz(point[i]), [&](Index j, double w, Vec3d d) {
      const Quad warmth = heat.size > 0 ? heat[j] : Quad{};
      const double value[profile_fields] = {motion[j].x, motion[j].y, motion[j].z, shear_rate[j],
                                            state[j].y,  warmth.x,    warmth.w};
      weights.add(w, 1, d);
      second.add(w, d);
      for (int k = 0; k < profile_fields; ++k) fields[k].add(w, value[k], d);
    });
    Sample sample;
    sample.fill = weights.plain;
    second.xx += ridge * weights.plain, second.yy += ridge * weights.plain,
        second.zz += ridge * weights.plain;
    const Vec3d lever = weights.plain > 0 ? second.solve(weights.first) : Vec3d{};
    const double scale = weights.plain - dot(lever, weights.first);
    for (int k = 0; k < profile_fields; ++k)
      sample.field[k] = (fields[k].plain - dot(lever, fields[k].first)) / scale;
    result[i] = sample;
  }
};

ProfilePoint point_of(const Sample& sample, Vec3d position, double distance) {
  ProfilePoint p;
  p.distance = distance;
  p.position = position;
  p.fill = sample.fill;
  const bool known = sample.fill >= least_fill;
  const auto value = [&](int k) {
    return known ? sample.field[k] : std::numeric_limits<double>::quiet_NaN();
  };
  p.velocity = {value(0), value(1), value(2)};
  // A linear fit may undershoot what cannot be negative.
  p.shear_rate = known ? larger(0.0, value(3)) : value(3);
  p.viscosity = known ? larger(0.0, value(4)) : value(4);
  p.temperature = value(5), p.solid_fraction = value(6);
  return p;
}

}  // namespace

LevelState level_of(const std::vector<ProfilePoint>& line) {
  LevelSearch search;
  for (const ProfilePoint& p : line) search.add(p.distance, p.fill);
  return {search.surface < 0 ? std::numeric_limits<double>::quiet_NaN() : search.surface, search.thickness};
}

PlaneCounters::PlaneCounters(const SimulationSetup& setup)
    : records(setup.planes.size()),
      planes_(setup.planes),
      extent_(setup.domain.upper - setup.domain.lower),
      periodic_(setup.domain.periodic) {
  for (const FrontSetup& plane : planes_)
    place_.push_back(static_cast<Real>(plane.position - setup.domain.lower[plane.axis]));
}

void PlaneCounters::begin(Context& c, const FluidArrays& f, DiagnosticScratch& scratch) {
  for (std::size_t k = 0; k < planes_.size(); ++k)
    records[k].start_behind = ranks().added(
        count(c, scratch, f.count, Behind{f.place.span(), {planes_[k].axis, planes_[k].sign, place_[k]}}));
}

void PlaneCounters::add(const std::vector<Vec3d>& places) {
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const Plane plane{planes_[k].axis, planes_[k].sign, place_[k]};
    for (const Vec3d& x : places) records[k].start_behind += plane.beyond(quad(to_real(x), 0)) ? 0 : 1;
  }
}

void PlaneCounters::advance(Context& c, const FluidArrays& f, Span<const Quad> before,
                            DiagnosticScratch& scratch, Span<const OutletBox> outlets) {
  GatheredSums sums(c, scratch);
  std::vector<PlaneState> now;
  states(f, before, sums, now);
  for (std::size_t k = 0; k < planes_.size(); ++k)
    gather_count(sums, f.count,
                 LostBehind{f.position.span(),
                            f.place.span(),
                            {planes_[k].axis, planes_[k].sign, place_[k]},
                            extent_,
                            {periodic_[0], periodic_[1], periodic_[2]},
                            outlets},
                 [&record = records[k]](std::int64_t lost) { record.lost_behind += lost; });
  sums.read();
  for (std::size_t k = 0; k < planes_.size(); ++k) records[k].passed = now[k].passed;
}

void PlaneCounters::states(const FluidArrays& f, Span<const Quad> before, GatheredSums& sums,
                           std::vector<PlaneState>& result) const {
  result.resize(planes_.size());
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const int axis = planes_[k].axis;
    const Plane plane{axis, planes_[k].sign, place_[k]};
    const bool repeats = periodic_[static_cast<std::size_t>(axis)];
    const Real period = repeats ? static_cast<Real>(extent_[axis]) : Real(0);
    const Record& r = records[k];
    const Crossings crossings{before, f.place.span(), plane, period};
    result[k] = {r.passed, 0, r.lost_behind, r.start_behind};
    gather_terms<AddUp>(sums, f.count, PairOfTerms<Crossings, Behind>{crossings, {f.place.span(), plane}},
                        [&state = result[k]](const Terms<2>& all) {
                          state.passed += static_cast<std::int64_t>(all.value[0]);
                          state.behind = static_cast<std::int64_t>(all.value[1]);
                        });
  }
}

AroundPoint around(const ProfileSource& source) {
  const auto reach = static_cast<Real>(static_cast<double>(source.smoothing.support) + source.drift);
  return {source.cells.grid, source.cells.cell_start, source.fluid.place.span(),
          source.box,        source.smoothing,        reach};
}

void count_in_box(GatheredSums& sums, const FluidArrays& f, const BoxSetup& box, Vec3d origin,
                  std::int64_t& count) {
  gather_count(sums, f.count, InBox{f.position.span(), box.lower - origin, box.upper - origin},
               [&count](std::int64_t all) { count = all; });
}

void count_solid(GatheredSums& sums, const FluidArrays& f, const SolidSetup& solid, Vec3d origin,
                 std::int64_t& count) {
  count = 0;
  if (f.heat.size() == 0) return;
  const InBox box{f.position.span(), solid.box.lower - origin, solid.box.upper - origin};
  gather_count(sums, f.count, SolidInBox{box, f.heat.span(), static_cast<Real>(solid.fraction)},
               [&count](std::int64_t all) { count = all; });
}

std::vector<ProfilePoint> measure_profile(Context& c, const ProfileSource& source, const LineSetup& line,
                                          Vec3d origin) {
  std::vector<Quad> points;
  for (int k = 0; k < line.points; ++k) points.push_back(quad(to_real(line.at(k) - origin), 0));
  Buffer<Quad> point(c, "points of a profile");
  Buffer<Sample> result(c, "samples of a profile");
  point.upload(points);
  result.resize(points.size());
  const FluidArrays& f = source.fluid;
  launch(c, "profile", line.points,
         InterpolateAtPoint{around(source), f.motion.span(), f.state.span(), f.heat.span(),
                            f.shear_rate.span(), 1 / source.smoothing.support, point.span(), result.span()});
  std::vector<Sample> samples;
  result.download(samples);
  join_at_owners(source, points, samples);
  std::vector<ProfilePoint> profile;
  for (int k = 0; k < line.points; ++k)
    profile.push_back(
        point_of(samples[static_cast<std::size_t>(k)], line.at(k), norm(line.at(k) - line.start)));
  return profile;
}

}  // namespace slagflow
