#include <algorithm>
#include <cmath>

#include "backend/launch.hpp"
#include "capillarity/surface_tension.hpp"
#include "fluid/diagnostic_sums.hpp"
#include "fluid/lane_math.hpp"
#include "fluid/smoothing/smoothing.hpp"

namespace slagflow {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int intervals = 200;  // of Simpson's rule
// The colour's gradient is taken with Lucy's function whatever the pressure has: of flatter ones drops feel
// too stiff a surface.
constexpr SmoothingKind capillary_kernel = SmoothingKind::lucy;

double simpson_weight(int k) { return k == 0 || k == intervals ? 1 : (k % 2 == 1 ? 4 : 2); }

// int f(sqrt(z^2 + y^2)) dA over the plane at depth z, lengths in h; `power` 2 takes the mean of x_t^2 along.
template <class F>
double over_plane(const F& f, double z, int dimensions, int power) {
  const double reach = std::sqrt(larger(0.0, 1 - square(z))), step = reach / intervals;
  double sum = 0;
  for (int k = 0; k <= intervals; ++k) {
    const double y = k * step;
    const double moment = power == 2 ? (dimensions == 3 ? square(y) / 2 : square(y)) : 1;
    const double measure = dimensions == 3 ? 2 * pi * y : 2;
    sum += simpson_weight(k) * step / 3 * measure * moment * f(std::sqrt(square(y) + square(z)));
  }
  return sum;
}

template <class Box>
struct Stress {
  PairContext c;
  Smoothing smoothing;
  Box box;
  Real noise;       // n0 [1/m]
  Real wall_share;  // k_w/k
  Span<const Real> strength, cosine;
  Span<const Index> wall_id;
  Span<Quad> normal_stress, shear_stress, wall_normal, wall_traction;

  HOST_DEVICE void operator()(Index i) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    Vec3 wetted;  // gradient of the walls' colour, each times the cosine of its contact angle
    const Vec3 s = wall_gradient(i, x, wetted);
    const Vec3 n = fluid_gradient(i, x) + s;
    const Real k = strength[c.fluid.fluid[i]], size = std::sqrt(dot(s, s));
    const Symmetric3 stress = tension(k, n);
    const Vec3 out = size > 0 ? (1 / size) * s : Vec3{};
    normal_stress[i] = {stress.xx, stress.yy, stress.zz, stress.xy};
    shear_stress[i] = {stress.xz, stress.yz, 0, 0};
    wall_normal[i] = quad(out, k * wall_share * dot(s, wetted) / (size + noise));
    wall_traction[i] = quad(c.fluid.state[i].z * (stress * out), 0);
  }

  // factor (|n|^2 - n n)/(|n| + n0)
  HOST_DEVICE Symmetric3 tension(Real factor, Vec3 n) const {
    const Real n2 = dot(n, n), share = factor / (std::sqrt(n2) + noise);
    Symmetric3 result;
    result.add_diagonal(share * n2);
    result.add_outer(-share, n);
    return result;
  }

  HOST_DEVICE Vec3 fluid_gradient(Index i, LaneVec3 x) const {
    LaneVec3 sum;
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const QuadLanes there = gather(c.fluid.place, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (bits(near)) sum += select(near, there.w * smoothing.gradient(r2), Lanes(0)) * d;
    }
    return total(sum);
  }

  HOST_DEVICE Vec3 wall_gradient(Index i, LaneVec3 x, Vec3& wetted) const {
    LaneVec3 sum, with_cosine;
    const ListRow row = c.wall_list.entries(i);
    const Index pairs = c.wall_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.wall.place, j)));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const LaneVec3 gradient = select(near, c.flow.wall_volume * smoothing.gradient(r2), Lanes(0)) * d;
      Real angle[lane_count];
      for (int lane = 0; lane < lane_count; ++lane) angle[lane] = cosine[wall_id[j[lane]]];
      sum += gradient;
      with_cosine += load_lanes(angle) * gradient;
    }
    wetted = total(with_cosine);
    return total(sum);
  }
};

template <class Box>
struct Divergence {
  PairContext c;
  Smoothing smoothing;
  TensionWeight weight;
  Box box;
  CapillaryView capillary;
  Span<Quad> acceleration;

  HOST_DEVICE static LaneVec3 times(const QuadLanes& normal, const QuadLanes& shear, LaneVec3 d) {
    return SymmetricMatrix3<Lanes>{normal.x, normal.y, normal.z, normal.w, shear.x, shear.y} * d;
  }

  // factor (1 - s s/|s|^2) d
  template <class Face>
  HOST_DEVICE static LaneVec3 along_wall(const Face& normal, Lanes factor, LaneVec3 d) {
    return factor * (d - dot(normal, d) * normal);
  }

  HOST_DEVICE void operator()(Index i) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    const Quad wetted = capillary.wall_normal[i];
    const Quad normal = capillary.normal_stress[i], shear = capillary.shear_stress[i];
    LaneVec3 sum;
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const QuadLanes there = gather(c.fluid.place, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const QuadLanes a = gather(capillary.normal_stress, j), b = gather(capillary.shear_stress, j);
      const QuadLanes sum_normal{a.x + normal.x, a.y + normal.y, a.z + normal.z, a.w + normal.w};
      const QuadLanes sum_shear{b.x + shear.x, b.y + shear.y, Lanes(0), Lanes(0)};
      const Lanes r = root(r2);
      sum += select(near, there.w * weight(r), Lanes(0)) * times(sum_normal, sum_shear, d);
      const QuadLanes wet = gather(capillary.wall_normal, j);
      const Lanes push = select(near, there.w * smoothing.gradient(r2), Lanes(0));
      sum += along_wall(xyz(wet), push * wet.w, d) + along_wall(in_lanes(xyz(wetted)), push * wetted.w, d);
    }
    const Quad own = c.fluid.state[i];
    acceleration[i] = quad((-own.z / own.w) * total(sum) + (1 / own.w) * from_walls(i), 0);
  }

  HOST_DEVICE Vec3 from_walls(Index i) const {
    const Vec3 x = xyz(c.fluid.place[i]);
    Vec3 sum;
    const ListRow row = c.wall_list.entries(i);
    const Index pairs = c.wall_list.length[i];
    for (Index k = 0; k < pairs; ++k) {
      const Vec3 d = box.separation(x, xyz(c.wall.place[row.one(k)]));
      const Real r2 = dot(d, d);
      if (r2 < square(c.flow.support))
        sum += capillary_pull(capillary, weight, i, d, std::sqrt(r2), c.flow.wall_volume);
    }
    return sum;
  }
};

struct Power {
  Span<const Quad> acceleration, velocity, state;
  HOST_DEVICE double operator()(Index i) const {
    return static_cast<double>(state[i].w) *
           dot(to_double(xyz(acceleration[i])), to_double(xyz(velocity[i])));
  }
};

}  // namespace

TensionWeight::TensionWeight(double h, int dimensions)
    : inverse(static_cast<Real>(1 / h)),
      factor(static_cast<Real>(dimensions == 3 ? 189 / (pi * std::pow(h, 5)) : 168 / (pi * std::pow(h, 4)))) {
}

namespace {

// int_0^h W1^2/(W1 + n0) M dz, M the share of int w x_t^2 dV within the fluid.
template <class Weight>
double plane_integral(int dimensions, const Weight& weight) {
  const Smoothing smoothing(capillary_kernel, 1, dimensions);
  const auto value = [&](double r) { return static_cast<double>(smoothing.value(static_cast<Real>(r * r))); };
  const double step = 1.0 / intervals;
  double sum = 0, share = 0.5;
  for (int k = 0; k <= intervals; ++k) {
    const double z = k * step;
    if (k > 0)
      share += step / 6 *
               (over_plane(weight, z - step, dimensions, 2) +
                4 * over_plane(weight, z - step / 2, dimensions, 2) + over_plane(weight, z, dimensions, 2));
    const double n = over_plane(value, z, dimensions, 0);
    sum += simpson_weight(k) * step / 3 * square(n) / (n + colour_noise) * share;
  }
  return sum;
}

}  // namespace

double plane_surface_tension(int dimensions) {
  const double factor = dimensions == 3 ? 189 / pi : 168 / pi;
  return plane_integral(dimensions, [&](double r) { return factor * square(r * (1 - r)); });
}

double plane_wall_tension(int dimensions) {
  const Smoothing smoothing(capillary_kernel, 1, dimensions);
  return plane_integral(dimensions, [&](double r) {
    return -static_cast<double>(smoothing.gradient(static_cast<Real>(r * r)));
  });
}

SurfaceTension::SurfaceTension(Context& c, const SimulationSetup& s)
    : context_(c),
      strength_(c, "surface tensions"),
      cosine_(c, "contact angles"),
      normal_stress_(c, "capillary stresses"),
      shear_stress_(c, "capillary stresses"),
      wall_normal_(c, "capillary wall normals"),
      wall_traction_(c, "capillary wall tractions"),
      acceleration_(c, "capillary accelerations") {
  on_ = std::any_of(s.fluids.begin(), s.fluids.end(),
                    [](const FluidSetup& f) { return f.surface_tension > 0; });
  if (!on_) return;
  const double scale = 1 / plane_surface_tension(s.dimensions);
  wall_share_ = static_cast<Real>(plane_surface_tension(s.dimensions) / plane_wall_tension(s.dimensions));
  std::vector<Real> strength, cosine;
  for (const FluidSetup& f : s.fluids) strength.push_back(static_cast<Real>(f.surface_tension * scale));
  for (const std::uint8_t body : s.walls.body)
    cosine.push_back(static_cast<Real>(std::cos(pi / 180 * s.bodies[body].contact_angle)));
  strength_.upload(strength), cosine_.upload(cosine);
}

CapillaryView SurfaceTension::view() const {
  return {normal_stress_.span(), shear_stress_.span(), wall_normal_.span(), wall_traction_.span()};
}

void SurfaceTension::reserve(Index count) {
  if (!on_) return;
  normal_stress_.resize(count), shear_stress_.resize(count);
  wall_normal_.resize(count), wall_traction_.resize(count), acceleration_.resize(count);
}

void SurfaceTension::update(const PairContext& c, Span<const Index> wall_id) {
  if (!on_) return;
  Section timer(context_, "surface tension");
  const Rows n = c.fluid.count;
  const Smoothing smoothing(capillary_kernel, static_cast<double>(c.flow.support), c.flow.dimensions);
  const TensionWeight weight(c.flow.support, c.flow.dimensions);
  const auto noise = static_cast<Real>(colour_noise) / c.flow.support;
  auto sweep = [&](auto box) {
    launch(context_, "capillary stress", n,
           Stress<decltype(box)>{c, smoothing, box, noise, wall_share_, strength_.span(), cosine_.span(),
                                 wall_id, normal_stress_.span(), shear_stress_.span(), wall_normal_.span(),
                                 wall_traction_.span()});
    exchange(context_, n, normal_stress_, shear_stress_, wall_normal_, wall_traction_);
    launch(context_, "capillary acceleration", n,
           Divergence<decltype(box)>{c, smoothing, weight, box, view(), acceleration_.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

void SurfaceTension::launch_power(const FluidArrays& fluid, Span<const Quad> velocity, StepRecord* record) {
  if (!on_) return;
  const OneTerm<Power> body{{acceleration_.span(), velocity, fluid.state.span()}};
  launch_reduction<AddUp>(context_, "capillary power", fluid.count, if_converged(&record->solve, body),
                          KeepTerms<1>{&record->capillary_power});
}

}  // namespace slagflow
