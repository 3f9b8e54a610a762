#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/error.hpp"
#include "fluid/constants.hpp"
#include "fluid/diagnostic_sums.hpp"
#include "fluid/lattice_viscosity.hpp"
#include "fluid/solve_state.hpp"
#include "heat/conduction.hpp"
#include "heat/heat.hpp"
#include "heat/heat_sums.hpp"
#include "heat/wall_sites.hpp"

namespace slagflow {

namespace {

// What follows from the enthalpy.
struct StateFromEnthalpy {
  Index begin;
  Materials materials;
  Span<const std::uint8_t> fluid;
  Span<const double> enthalpy;
  Span<Quad> heat, melt;
  HOST_DEVICE void operator()(Index k) const {
    const Index i = begin + k;
    const Material material = materials.of(fluid[i]);
    const MaterialRow row = material.at_enthalpy(enthalpy[i]);
    const Melt now = material.melt(row);
    heat[i] = {row.temperature, row.potential, row.conductivity, row.fraction};
    melt[i] = {now.viscosity, now.yield_stress, now.solid, melt[i].w > 0 ? melt[i].w : now.viscous};
  }
};

struct FindWalls {
  Span<const Index> id;
  Span<Index> wall_at;
  HOST_DEVICE void operator()(Index w) const { wall_at[id[w]] = w; }
};
struct NoWalls {
  Span<Index> wall_at;
  HOST_DEVICE void operator()(Index id) const { wall_at[id] = -1; }
};

struct ContentTerm {
  Span<const FluidConstants> fluids;
  Span<const std::uint8_t> fluid;
  Span<const double> enthalpy;
  HOST_DEVICE double operator()(Index i) const {
    return static_cast<double>(fluids[fluid[i]].mass) * enthalpy[i];
  }
};

// The temperature and its negative.
struct WarmestTerm {
  static constexpr int terms = 2;
  Span<const Quad> heat;
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const auto warmth = static_cast<double>(heat[i].x);
    return {{warmth, -warmth}};
  }
};

struct SetEntered {
  Index begin;
  Span<const double> from;
  Span<double> enthalpy;
  Span<Quad> melt;
  HOST_DEVICE void operator()(Index k) const { enthalpy[begin + k] = from[k], melt[begin + k] = {}; }
};

struct MeanWithBefore {
  Span<const double> before;
  Span<double> now;
  HOST_DEVICE void operator()(Index k) const { now[k] = 0.5 * (before[k] + now[k]); }
};

// Evenly spread: on a circle in the x-z plane, or along a spiral over the sphere (Fibonacci's).
std::vector<Quad> directions(int dimensions) {
  const int count = dimensions == 2 ? 132 : 128;  // of a line of particles just a sixth is open
  constexpr double pi = 3.14159265358979324;
  std::vector<Quad> all;
  for (int k = 0; k < count; ++k) {
    const double along = (k + 0.5) / count, height = 1 - 2 * along, radius = std::sqrt(1 - height * height);
    const double turn = dimensions == 2 ? 2 * pi * along : pi * (1 + std::sqrt(5.0)) * (k + 0.5);
    const Vec3d u = dimensions == 2 ? Vec3d{std::cos(turn), 0, std::sin(turn)}
                                    : Vec3d{radius * std::cos(turn), radius * std::sin(turn), height};
    all.push_back(quad(to_real(u), 0));
  }
  return all;
}

// Of a particle of a plane square lattice the share of its sphere that is open: of the circle arccos(1/2), of
// the sphere the part over a square of one spacing. And how areas grow beyond twice that, so that a particle
// by itself has the surface of a ball of its volume.
struct Openness {
  double flat, exponent;
};
Openness openness(int dimensions) {
  constexpr double pi = 3.14159265358979324, over_square = 1.10257119;
  const double flat = dimensions == 2 ? 1.0 / 6 : over_square / (4 * pi);
  const double ball = dimensions == 2 ? 2 * std::sqrt(pi) : std::cbrt(36 * pi);
  return {flat, std::log(ball / 2) / std::log(1 / (2 * flat))};
}

// Least of rho c / k over a table [s/m^2].
double least_diffusion_time(const MaterialSetup& m, double density) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& c : m.heat_capacity)
    for (const auto& k : m.conductivity) least = std::min(least, density * c[1] / k[1]);
  return least;
}

WallHeatConstants constants_of(const WallThermal& wall, double reference) {
  constexpr double n = 1.752, first = 1e-7;  // of (H5)
  WallHeatConstants constants;
  constants.kind = wall.kind;
  constants.temperature = static_cast<Real>(wall.temperature - reference);
  constants.flux = static_cast<Real>(wall.heat_flux);
  constants.contact_resistance = wall.contact > 0 ? static_cast<Real>(1 / wall.contact) : Real(0);
  const double heat = wall.density * wall.heat_capacity;
  constants.absorption = n / (n + 1) * wall.conductivity * heat;
  constants.least_taken = heat * first;
  return constants;
}

}  // namespace

double conduction_time_step(const SimulationSetup& s) {
  constexpr double by_pairs = 0.25, by_surface = 0.5;
  double step = std::numeric_limits<double>::infinity();
  if (!s.thermal.on) return step;
  for (const FluidSetup& f : s.fluids) {
    step = std::min(step, by_pairs * square(s.spacing) * least_diffusion_time(f.material, f.rest_density));
    double least_c = std::numeric_limits<double>::infinity();
    for (const auto& c : f.material.heat_capacity) least_c = std::min(least_c, c[1]);
    const double t = std::max(s.thermal.reference_temperature, s.thermal.ambient_temperature);
    const double transfer =
        s.thermal.surface_heat_transfer +
        (s.thermal.radiation ? 4 * f.material.emissivity * stefan_boltzmann * t * t * t : 0);
    if (transfer > 0) step = std::min(step, by_surface * f.rest_density * least_c * s.spacing / transfer);
  }
  return step;
}

Heat::Heat(Context& c)
    : context_(c),
      rows_(c, "materials"),
      first_row_(c, "first rows of materials"),
      solid_from_(c, "viscosities of solids"),
      emissivity_(c, "emissivities"),
      bodies_(c, "heat of walls"),
      site_of_wall_(c, "sites of wall particles"),
      first_member_(c, "first particles of sites"),
      member_(c, "particles of sites"),
      wall_at_(c, "places of wall particles"),
      site_body_(c, "walls of sites"),
      site_area_(c, "areas of sites"),
      site_temperature_(c, "temperatures of sites"),
      site_share_(c, "shares of sites"),
      site_taken_(c, "heat of sites"),
      lost_(c, "heat of particles"),
      entered_(c, "heat that enters"),
      enthalpy_before_(c, "enthalpies before"),
      taken_before_(c, "heat of sites before"),
      sums_before_(c, "heat sums before"),
      directions_(c, "directions of surfaces"),
      sums_(c, "heat sums") {}

void Heat::upload_materials(const SimulationSetup& s) {
  std::vector<MaterialRow> rows;
  std::vector<Index> first{0};
  std::vector<Real> solid_from, emissivity;
  for (std::size_t k = 0; k < s.fluids.size(); ++k) {
    const FluidSetup& f = s.fluids[k];
    const int yield = yield_stress_parameter(f.rheology.kind);
    const OwnRheology own{static_cast<double>(f.rheology.parameters[0]),
                          yield < 0 ? 0 : static_cast<double>(f.rheology.parameters[yield])};
    tables_.push_back(material_rows(f.material, own, reference_));
    rows.insert(rows.end(), tables_.back().begin(), tables_.back().end());
    first.push_back(static_cast<Index>(rows.size()));
    solid_from.push_back(static_cast<Real>(std::log(f.material.max_viscosity) * (1 - 1e-6)));
    emissivity.push_back(s.thermal.radiation ? static_cast<Real>(f.material.emissivity) : Real(0));
  }
  rows_.upload(rows), first_row_.upload(first), solid_from_.upload(solid_from);
  emissivity_.upload(emissivity);
}

void Heat::upload_bodies(const SimulationSetup& s) {
  std::vector<WallHeatConstants> bodies;
  for (const WallBody& body : s.bodies) bodies.push_back(constants_of(body.thermal, reference_));
  bodies_.upload(bodies);
  bodies_count_ = bodies.size();
  const WallSites sites = wall_sites(s);
  site_bodies_ = sites.body;
  site_of_wall_.upload(sites.of_wall), first_member_.upload(sites.first), member_.upload(sites.member);
  site_body_.upload(sites.body), site_area_.upload({sites.area.begin(), sites.area.end()});
  std::vector<Real> temperature;
  for (const std::uint8_t body : sites.body)
    temperature.push_back(bodies[body].kind == WallHeat::flux ? std::numeric_limits<Real>::quiet_NaN()
                                                              : bodies[body].temperature);
  site_temperature_.upload(temperature);
  site_share_.upload(std::vector<Real>(sites.body.size(), 1));
  site_taken_.upload(std::vector<double>(sites.body.size()));
}

double Heat::enthalpy_at(std::size_t fluid, double temperature) const {
  const std::vector<MaterialRow>& table = tables_.at(fluid);
  const Material material{{table.data(), static_cast<Offset>(table.size())}, 0};
  return material.at_temperature(static_cast<Real>(temperature - reference_)).enthalpy;
}

void Heat::start(const SimulationSetup& s, const std::vector<double>& remembered, FluidArrays& fluid) {
  on_ = s.thermal.on;
  if (!on_) return;
  friction_ = s.thermal.viscous_heating;
  reference_ = s.thermal.reference_temperature, last_time_ = s.start_time;
  constants_.factor = static_cast<Real>(2 / lattice_viscosity(ViscousOperator::laplacian,
                                                              {s.numerics.kernel, s.numerics.viscous_weight},
                                                              s.support_ratio, s.dimensions));
  constants_.fill = Smoothing(SmoothingKind::lucy, s.support_ratio * s.spacing, s.dimensions);
  directions_.upload(directions(s.dimensions));
  constants_.directions = directions_.span();
  constants_.flat_share = static_cast<Real>(openness(s.dimensions).flat);
  constants_.drop_exponent = static_cast<Real>(openness(s.dimensions).exponent);
  constants_.reference = static_cast<Real>(reference_);
  constants_.ambient = static_cast<Real>(s.thermal.ambient_temperature);
  constants_.surface_transfer = static_cast<Real>(s.thermal.surface_heat_transfer);
  longest_step_ = conduction_time_step(s);
  upload_materials(s), upload_bodies(s);
  const FluidParticles& p = s.particles;
  std::vector<double> enthalpy = remembered;
  if (enthalpy.empty())
    for (std::size_t i = 0; i < p.fluid.size(); ++i)
      enthalpy.push_back(enthalpy_at(p.fluid[i], p.temperature.at(i)));
  for (std::size_t i = 0; i < p.fluid.size(); ++i) start_ += particle_mass(s, p.fluid[i]) * enthalpy[i];
  for (std::size_t kind = 0; kind < s.fluids.size(); ++kind) masses_.push_back(particle_mass(s, kind));
  fluid.enthalpy.use(), fluid.heat.use(), fluid.melt.use();
  fluid.enthalpy.upload(enthalpy);
  fluid.heat.upload(std::vector<Quad>(enthalpy.size())),
      fluid.melt.upload(std::vector<Quad>(enthalpy.size()));
  sums_.upload(std::vector<double>(heat_sums));
  update(fluid, 0);
}

void Heat::update(FluidArrays& fluid, Index first) {
  launch(context_, "state of heat", fluid.count - first,
         StateFromEnthalpy{first, materials(), fluid.fluid.span(), fluid.enthalpy.span(), fluid.heat.span(),
                           fluid.melt.span()});
}

void Heat::launch_update(FluidArrays& fluid, const SolveState* solve) {
  launch(context_, "state of heat", fluid.count,
         if_converged(solve, StateFromEnthalpy{0, materials(), fluid.fluid.span(), fluid.enthalpy.span(),
                                               fluid.heat.span(), fluid.melt.span()}));
}

void Heat::reserve(Index count) { lost_.resize(count); }

bool Heat::due(double step_end, double dt, bool asked) const {
  constexpr double share = 0.1;
  if (!on_ || !(step_end > last_time_)) return false;
  return asked || step_end + dt - last_time_ > share * longest_step_;
}

SiteView Heat::sites() const {
  return {static_cast<Index>(site_bodies_.size()),
          site_of_wall_.span(),
          first_member_.span(),
          member_.span(),
          site_body_.span(),
          site_area_.span(),
          site_temperature_.span(),
          site_share_.span(),
          bodies_.span()};
}

void Heat::conduct(const PairContext& c, const ListView& wall_to_fluid, double step_end, FluidArrays& fluid) {
  Section timer(context_, "heat");
  const ConductionStep step{materials(),       constants_,         sites(),
                            fluid.heat.span(), emissivity_.span(), step_end - last_time_};
  lost_.resize(fluid.count);
  if (!site_bodies_.empty()) {
    const auto ids = static_cast<Index>(site_of_wall_.size());
    wall_at_.resize(ids);
    launch(context_, "no walls", ids, NoWalls{wall_at_.span()});
    launch(context_, "find walls", c.wall.count, FindWalls{c.wall.id, wall_at_.span()});
    conduct_to_walls(context_, c, wall_to_fluid, step, wall_at_.span(),
                     {site_temperature_.span(), site_share_.span(), site_taken_.span()});
  }
  conduct_in_fluid(context_, c, step, {fluid.enthalpy.span(), lost_.span()});
  launch_reduction<AddUp>(context_, "heat lost by surfaces", fluid.count, HeatTerm{lost_.span()},
                          AddHeat{sums_.span().data + heat_by_surface});
  update(fluid, 0);
  last_time_ = step_end;
}

void Heat::conduct_twice(const PairContext& c, const ListView& wall_to_fluid, double step_end,
                         FluidArrays& fluid) {
  const double begin = last_time_;
  enthalpy_before_.copy_from(fluid.enthalpy), taken_before_.copy_from(site_taken_);
  sums_before_.copy_from(sums_);
  conduct(c, wall_to_fluid, step_end, fluid);
  last_time_ = begin;
  conduct(c, wall_to_fluid, step_end, fluid);
  const auto halve = [&](Buffer<double>& now, const Buffer<double>& before) {
    launch(context_, "mean of two steps", static_cast<Index>(now.size()),
           MeanWithBefore{before.span(), now.span()});
  };
  halve(fluid.enthalpy, enthalpy_before_), halve(site_taken_, taken_before_), halve(sums_, sums_before_);
  update(fluid, 0);
}

void Heat::enter(Index first, const std::vector<std::uint8_t>& kinds, const std::vector<double>& temperatures,
                 FluidArrays& fluid) {
  std::vector<double> enthalpy;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    enthalpy.push_back(enthalpy_at(kinds[k], temperatures[k]));
    fed_ += masses_[kinds[k]] * enthalpy.back();
  }
  entered_.upload(enthalpy);
  launch(context_, "heat that enters", static_cast<Index>(enthalpy.size()),
         SetEntered{first, entered_.span(), fluid.enthalpy.span(), fluid.melt.span()});
  update(fluid, first);
}

double Heat::content(const FluidArrays& fluid, Span<const FluidConstants> fluids,
                     DiagnosticScratch& scratch) const {
  return total(context_, scratch, fluid.count,
               ContentTerm{fluids, fluid.fluid.span(), fluid.enthalpy.span()});
}

// Not-a-number without fluid.
void Heat::extremes(const FluidArrays& fluid, GatheredSums& sums, double& coolest, double& hottest) const {
  coolest = hottest = std::numeric_limits<double>::quiet_NaN();
  if (fluid.count == 0) return;
  gather_terms<TakeLargest>(sums, fluid.count, WarmestTerm{fluid.heat.span()},
                            [this, &coolest, &hottest](const Terms<2>& most) {
                              coolest = reference_ - most.value[1], hottest = reference_ + most.value[0];
                            });
}

void Heat::balance(const FluidArrays& fluid, Span<const FluidConstants> fluids, GatheredSums& sums,
                   HeatBalance& balance) const {
  balance.start = start_, balance.fed = fed_, balance.left = left_;
  gather_total(sums, fluid.count, ContentTerm{fluids, fluid.fluid.span(), fluid.enthalpy.span()},
               [&balance](double all) { balance.content = all; });
  double* const kept = sums.place(heat_sums, [&balance](const double* values) {
    balance.surface = values[heat_by_surface], balance.viscous = values[heat_by_friction];
  });
  context_.copy_on_device(kept, sums_.span().data, heat_sums * sizeof *kept);
  extremes(fluid, sums, balance.coolest, balance.hottest);
  std::vector<double> taken;
  site_taken_.download(taken);  // waits
  balance.walls.assign(bodies_count_, 0);
  for (std::size_t s = 0; s < taken.size(); ++s) balance.walls[site_bodies_[s]] += taken[s];
}

void Heat::require_possible(const FluidArrays& fluid, double time, DiagnosticScratch& scratch) const {
  constexpr double coldest = 20, hottest = 8000;  // [K]
  if (!on_ || fluid.count == 0) return;
  GatheredSums sums(context_, scratch);
  double least = 0, most = 0;
  extremes(fluid, sums, least, most);
  sums.read();
  if (least >= coldest && most <= hottest) return;
  throw Error("the fluid has from " + std::to_string(least) + " to " + std::to_string(most) + " K at " +
              std::to_string(time) + " s, and can have " + std::to_string(coldest) + " to " +
              std::to_string(hottest) +
              " K: heat comes or goes without end, as by a wall's heat_flux; see heat_to_... in history.csv");
}

std::vector<float> Heat::wall_temperatures() const {
  std::vector<Index> site;
  std::vector<Real> temperature;
  site_of_wall_.download(site), site_temperature_.download(temperature);
  std::vector<float> result;
  for (const Index s : site)
    result.push_back(s < 0 ? std::numeric_limits<float>::quiet_NaN()
                           : static_cast<float>(
                                 reference_ + static_cast<double>(temperature[static_cast<std::size_t>(s)])));
  return result;
}

}  // namespace slagflow
