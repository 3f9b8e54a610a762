#include "backend/launch.hpp"
#include "heat/conduction.hpp"

namespace slagflow {

namespace {

// Surface temperature of a thick wall, over that of its start [K]: a x|x|/E + B x = B (T - T_0) of (H5), all
// per area; `taken`: E [J/m^2].
HOST_DEVICE double thick_wall(const WallHeatConstants& body, double conductance, double above, double taken) {
  const double sign = above < 0 ? -1 : 1, heat = larger(sign * taken, body.least_taken);
  const double curve = body.absorption / heat, drive = conductance * std::fabs(above);
  const double root = std::sqrt(conductance * conductance + 4 * curve * drive);
  return sign * 2 * drive / (conductance + root);
}

template <class Box>
struct AtSite {
  PairContext c;
  ListView list;
  Box box;
  ConductionStep step;
  Span<const Index> wall_at;
  SiteOutput out;

  // Calls visit(pair, i) for the fluid particles before the site's wall particles.
  template <class Visit>
  HOST_DEVICE void each_pair(Index s, Visit visit) const {
    for (Index m = step.sites.first[s]; m < step.sites.first[s + 1]; ++m) {
      const Index w = wall_at[step.sites.member[m]];
      if (w < 0) continue;
      const ListRow row = list.entries(w);
      for (Index k = 0; k < list.length[w]; ++k) {
        const Index i = row.one(k);
        const WallPair pair = wall_pair(c, step.constants, box, i, w);
        if (pair.area > 0) visit(pair, i);
      }
    }
  }

  HOST_DEVICE Real conductance(const WallPair& pair, Index i, Real wall,
                               const WallHeatConstants& body) const {
    return wall_conductance(step.materials.of(c.fluid.fluid[i]), step.heat[i], pair.distance, wall,
                            body.contact_resistance);
  }

  HOST_DEVICE void operator()(Index s) const {
    const WallHeatConstants& body = step.sites.bodies[step.sites.body[s]];
    const Real area = step.sites.area[s];
    Real wall = body.kind == WallHeat::temperature ? body.temperature : out.temperature[s];
    double covered = 0, conducts = 0, carries = 0;
    each_pair(s, [&](const WallPair& pair, Index i) {
      covered += static_cast<double>(pair.area);
      if (body.kind == WallHeat::flux)
        carries +=
            static_cast<double>(pair.area * (step.heat[i].x + body.flux * pair.distance / step.heat[i].z));
      if (body.kind != WallHeat::semi_infinite) return;
      const auto part = static_cast<double>(pair.area * conductance(pair, i, wall, body));
      conducts += part, carries += part * static_cast<double>(step.heat[i].x - body.temperature);
    });
    if (!(covered > 0 && area > 0)) return;
    if (body.kind == WallHeat::flux) wall = static_cast<Real>(carries / covered);
    if (body.kind == WallHeat::semi_infinite && conducts > 0)
      wall = body.temperature +
             static_cast<Real>(thick_wall(body, conducts / static_cast<double>(area), carries / conducts,
                                          out.taken[s] / static_cast<double>(area)));
    // Of a given flux all that the site's area has, once it is covered.
    const double flux_share = static_cast<double>(area) / larger(covered, 0.5 * static_cast<double>(area));
    const Real share = body.kind == WallHeat::flux ? static_cast<Real>(flux_share) : Real(1);
    double gives = 0;  // [W]
    each_pair(s, [&](const WallPair& pair, Index i) {
      gives += static_cast<double>(
          pair_power(pair, step.heat[i], body,
                     body.kind == WallHeat::flux ? Real(0) : conductance(pair, i, wall, body), wall, share));
    });
    out.temperature[s] = wall, out.share[s] = share;
    out.taken[s] -= step.elapsed * gives;
  }

  // [W] into the fluid particle.
  HOST_DEVICE static Real pair_power(const WallPair& pair, Quad heat, const WallHeatConstants& body,
                                     Real conductance, Real wall, Real share) {
    const Real flux = body.kind == WallHeat::flux ? body.flux : conductance * (wall - heat.x);
    return pair.area * share * flux;
  }
};

template <class Box>
struct InFluid {
  PairContext c;
  Box box;
  ConductionStep step;
  FluidOutput out;

  struct Sums {
    Lanes conducted = 0, fill = 0;
    double from_walls = 0;  // [W]
    Real wall_fill = 0;
  };

  HOST_DEVICE void operator()(Index i) const {
    Sums sums;
    add_fluid(i, sums);
    add_walls(i, sums);
    const Quad place = c.fluid.place[i];
    const Real fill = total(sums.fill) + sums.wall_fill + place.w * step.constants.fill.value(Real(0));
    const double power = static_cast<double>(place.w * total(sums.conducted)) + sums.from_walls;
    const double by_surface = surface_power(i, Real(1) - fill);
    const auto mass = static_cast<double>(c.fluids[c.fluid.fluid[i]].mass);
    out.lost[i] = step.elapsed * by_surface;
    out.enthalpy[i] += step.elapsed * (power - by_surface) / mass;
  }

  // (H3): within a fluid by the potential, between two with the harmonic mean.
  HOST_DEVICE void add_fluid(Index i, Sums& sums) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    const Quad own = step.heat[i];
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const QuadLanes there = gather(c.fluid.place, j);
      const LaneVec3 d = box.separation(x, xyz(there));
      const Lanes r2 = dot(d, d);
      const LaneMask near = (r2 < Lanes(square(c.flow.support))) & first_lanes(pairs - k);
      if (!bits(near)) continue;
      const Lanes volume = select(near, there.w, Lanes(0));
      const QuadLanes other = gather(step.heat, j);
      Lanes difference = other.y - Lanes(own.y);
      if (c.fluids.size > 1) {
        const Lanes mean = Real(2) * own.z * other.z / (own.z + other.z);
        difference = select(same(c.fluid.fluid, j, c.fluid.fluid[i]), difference, mean * (other.x - own.x));
      }
      sums.conducted += conduction_weight(c, step.constants, r2) * volume * difference;
      sums.fill += volume * step.constants.fill.value(r2);
    }
  }

  HOST_DEVICE void add_walls(Index i, Sums& sums) const {
    const ListRow row = c.wall_list.entries(i);
    const Index pairs = c.wall_list.length[i];
    const Vec3 x = xyz(c.fluid.place[i]);
    for (Index k = 0; k < pairs; ++k) {
      const Index w = row.one(k);
      const Vec3 d = box.separation(x, xyz(c.wall.place[w]));
      const Real r2 = dot(d, d);
      if (!(r2 < square(c.flow.support))) continue;
      sums.wall_fill += c.flow.wall_volume * step.constants.fill.value(r2);
      const Index s = step.sites.count > 0 ? step.sites.of_wall[c.wall.id[w]] : Index(-1);
      if (s >= 0) sums.from_walls += static_cast<double>(wall_power(i, w, s));
    }
  }

  HOST_DEVICE Real wall_power(Index i, Index w, Index s) const {
    const WallHeatConstants& body = step.sites.bodies[step.sites.body[s]];
    const WallPair pair = wall_pair(c, step.constants, box, i, w);
    const Real wall = step.sites.temperature[s];
    const Real conductance = body.kind == WallHeat::flux
                                 ? Real(0)
                                 : wall_conductance(step.materials.of(c.fluid.fluid[i]), step.heat[i],
                                                    pair.distance, wall, body.contact_resistance);
    return AtSite<Box>::pair_power(pair, step.heat[i], body, conductance, wall, step.sites.share[s]);
  }

  // Whether a place at `from` from the particle is within a spacing of another particle of the list.
  HOST_DEVICE bool covered(const ListView& list, Index i, Span<const Quad> places, Vec3 from) const {
    const Vec3 x = xyz(c.fluid.place[i]);
    const ListRow row = list.entries(i);
    for (Index k = 0; k < list.length[i]; ++k) {
      const Vec3 d = box.separation(xyz(places[row.one(k)]), x);
      if (Real(2) * dot(from, d) > dot(d, d)) return true;
    }
    return false;
  }

  // (H6): what of the sphere of a spacing about the particle is in no sphere of another.
  HOST_DEVICE Real area(Index i) const {
    const HeatConstants& h = step.constants;
    Index open = 0;
    for (Offset k = 0; k < h.directions.size; ++k) {
      const Vec3 from = c.flow.spacing * xyz(h.directions[k]);
      if (!covered(c.fluid_list, i, c.fluid.place, from) && !covered(c.wall_list, i, c.wall.place, from))
        ++open;
    }
    const Real share = static_cast<Real>(open) / static_cast<Real>(h.directions.size) / h.flat_share;
    const Real flat = c.flow.dimensions == 3 ? square(c.flow.spacing) : c.flow.spacing;
    return flat * (share <= 2 ? share : Real(2) * std::pow(Real(0.5) * share, h.drop_exponent));
  }

  // (H7): [W] lost by a particle whose fill lacks `deficit` of one.
  HOST_DEVICE double surface_power(Index i, Real deficit) const {
    constexpr Real inside = Real(0.01);
    const HeatConstants& h = step.constants;
    if (!(deficit > inside)) return 0;
    const Real radiance = step.emissivity[c.fluid.fluid[i]] * Real(stefan_boltzmann);
    if (!(radiance > 0 || h.surface_transfer > 0)) return 0;
    const Real exposed = area(i);
    if (!(exposed > 0)) return 0;
    const Material material = step.materials.of(c.fluid.fluid[i]);
    const Quad own = step.heat[i];
    const Real half = Real(0.5) * c.flow.spacing;
    constexpr int passes = 6;
    Real surface = own.x, flux = 0;
    for (int pass = 0; pass < passes; ++pass) {
      const MaterialRow row = material.at_temperature(surface);
      const Real t = h.reference + surface, t2 = square(t), a2 = square(h.ambient);
      flux = radiance * (t2 + a2) * (t + h.ambient) * (t - h.ambient) + h.surface_transfer * (t - h.ambient);
      const Real slope = Real(4) * radiance * t2 * t + h.surface_transfer;
      const Real missing = own.y - row.potential - half * flux;
      surface += missing / (row.conductivity + half * slope);
    }
    return static_cast<double>(exposed * flux);
  }
};

}  // namespace

void conduct_to_walls(Context& context, const PairContext& c, const ListView& wall_to_fluid,
                      const ConductionStep& step, Span<const Index> wall_at, const SiteOutput& out) {
  auto sweep = [&](auto box) {
    launch(context, "heat at walls", step.sites.count,
           AtSite<decltype(box)>{c, wall_to_fluid, box, step, wall_at, out});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

void conduct_in_fluid(Context& context, const PairContext& c, const ConductionStep& step,
                      const FluidOutput& out) {
  auto sweep = [&](auto box) {
    launch(context, "conduction", c.fluid.count, InFluid<decltype(box)>{c, box, step, out});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
}

}  // namespace slagflow
