#include <limits>

#include "fluid/diagnostic_sums.hpp"
#include "observation/wall_contact.hpp"

namespace slagflow {

namespace {

using Site = WallContact::Site;

template <class Box>
struct LookAtSite {
  PairContext c;
  ListView list;
  Box box;
  Span<const double> area;
  Span<Site> site;

  HOST_DEVICE void operator()(Index w) const {
    const double own = c.wall.place[w].w == 0 ? area[c.wall.id[w]] : 0;  // else it has vanished
    site[w] = {};
    if (!(own > 0)) return;
    constexpr double touching = 0.25;
    const Quad n = c.wall.normal[w];
    const Vec3 at = xyz(c.wall.place[w]) + n.w * xyz(n), gravity = felt_gravity(w);
    const ListRow row = list.entries(w);
    double fill = 0, sum = 0;
    for (Index k = 0; k < list.length[w]; ++k) {
      const Index f = row.one(k);
      const Vec3 d = box.separation(at, xyz(c.fluid.place[f]));
      const Real r2 = dot(d, d);
      if (r2 >= square(c.flow.support)) continue;
      const double weight = static_cast<double>(c.fluid.state[f].z * c.flow.smoothing.value(r2));
      const Real density = c.fluids[c.fluid.fluid[f]].rest_density + c.fluid.motion[f].w;
      fill += weight;
      sum += weight * static_cast<double>(c.fluid.pressure[f] + density * dot(gravity, d));
    }
    if (fill >= touching) site[w] = {own, sum / fill};
  }

  HOST_DEVICE Vec3 felt_gravity(Index w) const {
    return c.wall.acceleration.size > 0 ? c.flow.gravity - xyz(c.wall.acceleration[w]) : c.flow.gravity;
  }
};

// What is summed of the particles of a body.
struct OfBody {
  Span<const Site> site;
  Span<const double> area;
  Span<const std::uint8_t> body;
  WallView wall;
  std::uint8_t wanted;
  HOST_DEVICE bool counts(Index w) const { return body[wall.id[w]] == wanted && area[wall.id[w]] > 0; }
  HOST_DEVICE bool wet(Index w) const { return counts(w) && site[w].wetted > 0; }
};

struct AreaTerms : OfBody {
  static constexpr int terms = 3;
  HOST_DEVICE Terms<3> operator()(Index w) const {
    if (!counts(w) || wall.place[w].w != 0) return {{0, 0, 0}};
    return {{area[wall.id[w]], site[w].wetted, site[w].wetted * site[w].pressure}};
  }
};

constexpr double none = TakeLargest::start;

struct PressureTerm : OfBody {
  HOST_DEVICE double operator()(Index w) const { return wet(w) ? site[w].pressure : none; }
};

// Of those with the largest pressure the least id, as its negative.
struct PlaceTerm : OfBody {
  const double* pressure;
  HOST_DEVICE double operator()(Index w) const {
    return wet(w) && site[w].pressure == *pressure ? -static_cast<double>(wall.id[w]) : none;
  }
};

struct PlaceOf {
  static constexpr int terms = 3;
  WallView wall;
  const double* negative_id;
  HOST_DEVICE Terms<3> operator()(Index w) const {
    if (-static_cast<double>(wall.id[w]) != *negative_id) return {{0, 0, 0}};
    const Vec3d at = to_double(xyz(wall.place[w]) + wall.normal[w].w * xyz(wall.normal[w]));
    return {{at.x, at.y, at.z}};
  }
};

}  // namespace

WallContact::WallContact(Context& c)
    : context_(c),
      area_(c, "areas of wall particles"),
      body_(c, "walls of wall particles"),
      site_(c, "contact of wall particles") {}

void WallContact::start(const SimulationSetup& s) {
  bodies_ = s.contacts, origin_ = s.domain.lower;
  if (bodies_.empty()) return;
  area_.upload(s.site_area), body_.upload(s.walls.body);
}

void WallContact::states(const PairContext& c, const ListView& list, GatheredSums& sums,
                         std::vector<ContactState>& states) {
  if (bodies_.empty()) return;
  site_.resize(static_cast<Offset>(c.wall.count));
  auto sweep = [&](auto box) {
    launch(context_, "wall contact", c.wall.count,
           LookAtSite<decltype(box)>{c, list, box, area_.span(), site_.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
  states.resize(bodies_.size());
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    gather(c, static_cast<std::uint8_t>(bodies_[k]), sums, states[k]);
}

// The place of the largest pressure is found on the device.
void WallContact::gather(const PairContext& c, std::uint8_t body, GatheredSums& sums, ContactState& state) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const Rows n = c.wall.count;
  const OfBody all{site_.span(), area_.span(), body_.span(), c.wall, body};
  const bool flat = c.flow.dimensions == 2;
  sums.make_room(AreaTerms::terms + 1 + 1 + PlaceOf::terms);
  gather_terms<AddUp>(sums, n, AreaTerms{all}, [&state](const Terms<3>& areas) {
    state.area = areas.value[0], state.wetted = areas.value[1];
    state.mean_pressure = state.wetted > 0 ? areas.value[2] / state.wetted : unknown;
    state.largest_pressure = unknown, state.place = {unknown, unknown, unknown};
  });
  const double* const pressure =
      gather_terms<TakeLargest>(sums, n, OneTerm<PressureTerm>{{all}}, [&state](const Terms<1>& most) {
        if (state.wetted > 0) state.largest_pressure = most.value[0];
      });
  const double* const id =
      gather_terms<TakeLargest>(sums, n, OneTerm<PlaceTerm>{{all, pressure}}, [](const Terms<1>&) {});
  gather_terms<AddUp>(sums, n, PlaceOf{c.wall, id}, [this, &state, flat](const Terms<3>& at) {
    if (!(state.wetted > 0)) return;
    state.place = origin_ + Vec3d{at.value[0], at.value[1], at.value[2]};
    if (flat) state.place.y = 0;
  });
}

}  // namespace slagflow
