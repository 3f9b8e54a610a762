#include <algorithm>
#include <cstring>
#include <iterator>

#include "fluid/diagnostic_sums.hpp"
#include "observation/wall_forces.hpp"
#include "pressure/pair_pressure.hpp"
#include "walls/wall_tension.hpp"

namespace slagflow {

namespace {

using Impulse = WallForces::Impulse;

template <class Box>
struct AddImpulse {
  PairContext c;
  ListView list;
  Box box;
  Real dt, theta;
  Span<const Quad> velocity, explicit_velocity;
  WallYield yield;
  CapillaryView capillary;
  TensionWeight tension_weight;
  Span<const Index> id;
  Span<Impulse> impulse;

  HOST_DEVICE void operator()(Index w) const {
    const ListRow row = list.entries(w);
    const Index pairs = list.length[w];
    if (pairs == 0) return;
    Impulse sum = impulse[id[w]];
    for (Index k = 0; k < pairs; ++k) add_pair(w, row.one(k), sum);
    impulse[id[w]] = sum;
  }

  // As in the predictor: the impulse on the fluid particle; the wall feels its reverse.
  HOST_DEVICE void add_pair(Index w, Index i, Impulse& sum) const {
    const Vec3 d = box.separation(xyz(c.fluid.place[i]), xyz(c.wall.place[w]));
    const Real r2 = dot(d, d);
    if (r2 >= square(c.flow.support)) return;
    const Quad own = c.fluid.state[i], wall = c.wall.velocity[w];
    const Real viscous_weight = c.flow.smoothing.viscous(r2);
    const WallPressures<Real> p = towards_walls(c, i, own.x, wall_tension_limit(c, w));
    const Real volumes = -dt * own.z * c.flow.wall_volume;
    Vec3d pressure = to_double((volumes * pair_pressure_slope(c.flow, p.fluid, c.wall.pressure[w], r2)) * d);
    if (capillary.any())
      pressure +=
          to_double(dt * capillary_pull(capillary, tension_weight, i, d, std::sqrt(r2), c.flow.wall_volume));
    Vec3d viscous;
    if (wall.w >= 0) {
      const WallPairGeometry<Real, Quad> pair{d, c.wall.normal[w], c.wall.back[w]};
      const Real stick = no_slip_factor(pair, c.flow.spacing, wall.w);
      const Real factor = dt * c.flow.operator_factor * own.z * own.y * c.flow.wall_volume;
      const Real weight = factor * stick * viscous_weight;
      const Vec3 mean = theta * xyz(velocity[i]) + (1 - theta) * xyz(explicit_velocity[i]);
      viscous = to_double(couple(c.flow.coupling, weight, d, xyz(wall) - mean));
      if (yield.stress.data) {
        const Real stress = (2 * yield.held[i] - 1) * yield_stress_of(w, i);
        viscous -= to_double(dt * own.z * stress * wall_strain_factor(c.flow, stick, viscous_weight) * d);
      }
    }
    const Vec3d at = to_double(xyz(c.wall.place[w]) + d);
    sum.pressure -= pressure, sum.viscous -= viscous;
    sum.pressure_torque -= cross(at, pressure), sum.viscous_torque -= cross(at, viscous);
    sum.work += dot(pressure + viscous, to_double(xyz(wall)));
    sum.viscous_work += dot(viscous, to_double(xyz(wall)));
    sum.elastic_work +=
        dot(to_double((volumes * pressure_slope(c.flow, p.elastic, Real(0), r2)) * d), to_double(xyz(wall)));
  }

  // It is stored with the pairs of the fluid particle.
  HOST_DEVICE Real yield_stress_of(Index w, Index i) const {
    const ListRow row = c.wall_list.entries(i);
    for (Index k = 0; k < c.wall_list.length[i]; ++k) {
      const Offset at = row.at(k);
      if (row.one(k) == w) return yield.stress[at];
    }
    return 0;
  }
};

// Of one body: the components of the four vectors of an impulse, and the work.
struct LoadTerms {
  static constexpr int terms = 13, work_term = 12;
  Span<const Impulse> impulse;
  Span<const std::uint8_t> body;
  std::uint8_t wanted;

  HOST_DEVICE Terms<terms> operator()(Index i) const {
    Terms<terms> all{};
    if (body[i] != wanted) return all;
    const Impulse& p = impulse[i];
    const Vec3d vectors[4] = {p.pressure, p.viscous, p.pressure_torque, p.viscous_torque};
    for (int k = 0; k < work_term; ++k) all.value[k] = vectors[k / 3][k % 3];
    all.value[work_term] = p.work;
    return all;
  }
};

struct WorkTerms {
  static constexpr int terms = 2;
  Span<const Impulse> impulse;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    return {{impulse[i].viscous_work, impulse[i].elastic_work}};
  }
};

}  // namespace

WallForces::WallForces(Context& c)
    : context_(c),
      impulse_(c, "wall impulses"),
      all_(c, "wall impulses"),
      body_(c, "walls of wall impulses") {}

void WallForces::start(const std::vector<std::uint8_t>& body) {
  impulse_.upload(std::vector<Impulse>(body.size()));
  body_.upload(body);
}

void WallForces::add(const PairContext& c, const ListView& list, const WallArrays& wall,
                     const WallForceStep& step) {
  const TensionWeight tension_weight(static_cast<double>(c.flow.support), c.flow.dimensions);
  auto sweep = [&](auto box) {
    const AddImpulse<decltype(box)> body{c,
                                         list,
                                         box,
                                         static_cast<Real>(step.dt),
                                         static_cast<Real>(step.theta),
                                         step.velocity,
                                         step.explicit_velocity,
                                         step.yield,
                                         step.capillary,
                                         tension_weight,
                                         wall.id.span(),
                                         impulse_.span()};
    launch(context_, "wall forces", wall.count, if_converged(step.solve, body));
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

void WallForces::follow(const std::vector<Index>& before, const std::vector<Index>& now) {
  std::vector<Index> old = before, own = now, gone;
  std::sort(old.begin(), old.end()), std::sort(own.begin(), own.end());
  std::set_difference(old.begin(), old.end(), own.begin(), own.end(), std::back_inserter(gone));
  struct Passed {
    Index id;
    Impulse impulse;
  };
  std::vector<Impulse> impulse;
  impulse_.download(impulse);
  std::vector<Passed> going;
  for (const Index id : gone) going.push_back({id, impulse[static_cast<std::size_t>(id)]});
  const std::vector<std::byte> bytes = ranks().gathered(going.data(), going.size() * sizeof(Passed));
  std::vector<Passed> all(bytes.size() / sizeof(Passed));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  // What no rank has any more, as a wall has vanished, stays with the first.
  for (const Index id : gone) impulse[static_cast<std::size_t>(id)] = {};
  std::vector<std::uint8_t> taken;
  for (const Passed& p : all) taken.push_back(std::binary_search(own.begin(), own.end(), p.id) ? 1 : 0);
  std::vector<std::uint8_t> anywhere = taken;
  ranks().join(anywhere.data(), anywhere.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (taken[k] != 0 || (anywhere[k] == 0 && ranks().first()))
      impulse[static_cast<std::size_t>(all[k].id)] = all[k].impulse;
  impulse_.upload(impulse);
}

void WallForces::keep(const std::vector<Index>& now) {
  std::vector<Impulse> impulse;
  impulse_.download(impulse);
  std::vector<std::uint8_t> own(impulse.size());
  for (const Index id : now) own[static_cast<std::size_t>(id)] = 1;
  std::vector<std::uint8_t> anywhere = own;
  ranks().join(anywhere.data(), anywhere.size());
  for (std::size_t id = 0; id < impulse.size(); ++id)
    if (own[id] == 0 && !(anywhere[id] == 0 && ranks().first())) impulse[id] = {};
  impulse_.upload(impulse);
}

Span<const WallForces::Impulse> WallForces::of_all() {
  if (!ranks().several()) return impulse_.span();
  std::vector<Impulse> impulse;
  impulse_.download(impulse);
  ranks().join(impulse.data(), impulse.size() * sizeof(Impulse));
  all_.upload(impulse);
  return all_.span();
}

void WallForces::load(std::size_t body, GatheredSums& sums, WallLoad& load) {
  const Span<const Impulse> impulse = of_all();
  const auto n = static_cast<Index>(impulse.size);
  gather_terms<AddUp>(sums, n, LoadTerms{impulse, body_.span(), static_cast<std::uint8_t>(body)},
                      [&load](const Terms<LoadTerms::terms>& all) {
                        Vec3d* const vectors[4] = {&load.pressure, &load.viscous, &load.pressure_torque,
                                                   &load.viscous_torque};
                        for (int k = 0; k < LoadTerms::work_term; ++k)
                          (*vectors[k / 3])[k % 3] = all.value[k];
                        load.work = all.value[LoadTerms::work_term];
                      });
}

void WallForces::work(GatheredSums& sums, WallWork& work) {
  const Span<const Impulse> impulse = of_all();
  gather_terms<AddUp>(
      sums, static_cast<Index>(impulse.size), WorkTerms{impulse},
      [&work](const Terms<2>& all) { work.viscous = all.value[0], work.elastic = all.value[1]; });
}

}  // namespace slagflow
