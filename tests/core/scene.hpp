// Particles placed by hand for tests of one operator: the same numbers as the oracle's world and on the
// device.
#pragma once

#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "fluid/constants.hpp"
#include "neighbours/neighbours.hpp"
#include "neighbours/ordering.hpp"
#include "pressure/density.hpp"
#include "reference.hpp"
#include "viscosity/predictor.hpp"

namespace slagflow::testing_tools {

inline constexpr double epsilon = sizeof(Real) == 4 ? 1.2e-7 : 2.3e-16;

// As the device holds it.
inline double rounded(double a) { return static_cast<double>(static_cast<Real>(a)); }
inline reference::Vec rounded(reference::Vec a) { return {rounded(a.x), rounded(a.y), rounded(a.z)}; }
inline Vec3 to_device(reference::Vec a) { return to_real(Vec3d{a.x, a.y, a.z}); }
inline Quad to_device(reference::Vec a, double w) { return quad(to_device(a), static_cast<Real>(w)); }
inline reference::Vec to_host(Quad q) {
  return {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
}

template <class T>
std::vector<std::remove_const_t<T>> download(Context& context, Span<T> span) {
  std::vector<std::remove_const_t<T>> result(static_cast<std::size_t>(span.size));
  context.copy_to_host(result.data(), span.data, result.size() * sizeof(T));
  return result;
}

template <class T>
Span<const T> host_span(const std::vector<T>& v) {
  return {v.data(), static_cast<Offset>(v.size())};
}

// A neighbour list on the host.
struct HostList {
  std::vector<Offset> slice;
  std::vector<Index> length, base, plain;
  std::vector<Code> code;

  HostList(Context& c, const ListView& v)
      : slice(download(c, v.slice)),
        length(download(c, v.length)),
        base(download(c, v.base)),
        plain(download(c, v.plain)),
        code(download(c, v.code)) {}

  ListView view() const {
    ListView v{{host_span(slice), host_span(length)}, host_span(code), host_span(base), host_span(plain)};
    if (code.empty()) v.code = {};
    return v;
  }
  std::vector<Index> row(Index i) const {
    const ListRow entries = view().entries(i);
    std::vector<Index> result;
    for (Index k = 0; k < length[static_cast<std::size_t>(i)]; ++k) result.push_back(entries.one(k));
    return result;
  }
};

// Uniform random numbers from a fixed seed.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  Vec3d vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size);
    return {x, y, uniform(-size, size)};
  }

 private:
  std::mt19937 engine_;  // its numbers are the same everywhere, unlike those of the standard distributions
};

enum class Surroundings { free, walls, periodic };  // periodic: along x and y, above a floor

struct SceneOptions {
  int dimensions = 3;
  Surroundings surroundings = Surroundings::walls;
  int particles_across = 6;
  double jitter = 0.2;  // in spacings
  unsigned seed = 1;
};

// A jittered block of two fluids: free; above a floor, beside a wall and around a thin plate; or above a
// floor with periodic sides. Pressures of both signs, viscosities over three decades.
class Scene {
 public:
  static constexpr double spacing = 0.01, reach_ratio = 1.1;  // reach of the lists over the support

  explicit Scene(const SceneOptions& options)
      : setup(make_setup(options)),
        fluid(context),
        wall(context),
        fluids(context, "fluids"),
        flow(flow_constants(setup)),
        box(periodic_box(setup)),
        ordering(context, setup.domain.upper, setup.domain.periodic,
                 CellGrid::cover(setup.domain.upper, setup.domain.periodic, reach())),
        fluid_list(context, "pairs"),
        wall_list(context, "wall pairs"),
        wall_to_fluid(context, "walls' pairs"),
        random_(options.seed) {
    place_fluid(options);
    if (options.surroundings != Surroundings::free) place_walls(options);
    set_constants();
  }

  double reach() const { return reach_ratio * setup.support_ratio * spacing; }

  // Copies `world` to the device, sorts it and builds the lists. Call after the last change by hand.
  void upload() {
    world.walls_move = walls_move;
    fluids.upload(fluid_constants(setup));
    upload_fluid();
    upload_walls();
    departed.assign(setup.fluids.size(), {});
    ordering.sort(fluid, departed);
    ordering.sort(wall);
    upload_contact();
    const auto r = static_cast<Real>(reach());
    fluid_list.build(ordering.fluid_sources(fluid), fluid.place.span(), box, r, NeighbourList::Pairs::self);
    wall_list.build(ordering.wall_sources(wall), fluid.place.span(), box, r, NeighbourList::Pairs::other);
    wall_to_fluid.build(ordering.fluid_sources(fluid), wall.place.span(), box, r,
                        NeighbourList::Pairs::other);
  }

  PairContext pairs() const {
    return {fluid_list.view(), wall_list.view(), view(fluid), view(wall), fluids.span(), flow, box};
  }
  RowCells rows() const {
    const SourceView s = ordering.fluid_sources(fluid);
    return {s.grid, s.cell_start};
  }

  // Downloads one value per fluid (or wall) particle, in the order of `world`.
  template <class T>
  std::vector<T> by_id(Span<const T> values) {
    return in_order(download(context, values), fluid.id);
  }
  template <class T>
  std::vector<T> by_wall_id(Span<const T> values) {
    return in_order(download(context, values), wall.id);
  }

  SimulationSetup setup;
  reference::World world;
  Context context;
  FluidArrays fluid;
  WallArrays wall;
  Buffer<FluidConstants> fluids;
  FlowConstants flow;
  PeriodicBox box;
  Ordering ordering;
  NeighbourList fluid_list, wall_list, wall_to_fluid;
  DepartureCounts departed;
  bool walls_move = false, walls_have_limits = false;

  // Walls bear 0, 15 or 40 Pa, the fluid 40; a quarter of their pressures is at the limit.
  void give_walls_limits() {
    walls_have_limits = true;
    int k = 0;
    for (reference::Wall& w : world.walls) {
      const double limits[] = {0, 15, 40};
      w.tension_limit = limits[k++ % 3];
      w.pressure = k % 4 == 0 ? -w.tension_limit : std::max(w.pressure, -w.tension_limit);
    }
  }

 private:
  static SimulationSetup make_setup(const SceneOptions& o) {
    SimulationSetup s;
    s.dimensions = o.dimensions, s.spacing = spacing;
    s.gravity = {1.5, 0, -9.81}, s.body_acceleration = {0, o.dimensions == 3 ? 2.0 : 0.0, 1};
    FluidSetup oil{"oil", 900, {RheologyKind::newtonian, {Real(0.3)}}};
    FluidSetup slag{"slag", 2600, {RheologyKind::bingham, {Real(0.5), Real(5), Real(100)}}};
    s.fluids = {oil, slag};
    s.numerics.sound_speed = 7, s.numerics.tension_limit = 40;
    const double side = o.particles_across * spacing;
    s.domain.upper = {side, o.dimensions == 3 ? side : spacing, side};
    if (o.surroundings == Surroundings::periodic) s.domain.periodic = {true, o.dimensions == 3, false};
    return s;
  }

  void place_fluid(const SceneOptions& o) {
    const int across = o.particles_across, deep = o.dimensions == 3 ? across : 1;
    const Vec3d upper = setup.domain.upper;
    for (int k = 0; k < across; ++k)
      for (int j = 0; j < deep; ++j)
        for (int i = 0; i < across; ++i) {
          if (is_plate(o, k)) continue;
          reference::Particle p;
          const Vec3d shift = random_.vector(o.jitter * spacing), v = random_.vector(0.5);
          p.x = {(i + 0.5) * spacing + shift.x, (j + 0.5) * spacing + shift.y, (k + 0.5) * spacing + shift.z};
          p.v = {v.x, v.y, v.z};
          if (o.dimensions == 2) p.x.y = spacing / 2, p.v.y = 0;
          p.x.x = std::min(std::max(p.x.x, 0.0), upper.x), p.x.z = std::min(std::max(p.x.z, 0.0), upper.z);
          p.fluid = k < across / 2 ? 1 : 0;
          const double rest = setup.fluids[static_cast<std::size_t>(p.fluid)].rest_density;
          p.excess = rest * random_.uniform(-0.01, 0.01);
          p.mass = rest * std::pow(spacing, o.dimensions), p.volume = p.mass / (rest + p.excess);
          p.pressure = random_.uniform(-30, 200);
          p.contact = world.particles.size() % 5 == 1 ? 10.0 * (k + 1) : -1e30;
          p.viscosity = std::pow(10, random_.uniform(-1, 2));
          const Vec3d a = rest * random_.vector(20);
          p.by_pressure = {a.x, o.dimensions == 3 ? a.y : 0, a.z};
          world.particles.push_back(p);
        }
  }

  // A layer of the block is a plate, with fluid on both sides.
  static bool is_plate(const SceneOptions& o, int layer) {
    return o.surroundings == Surroundings::walls && layer == o.particles_across / 2;
  }

  // Three layers below the floor z = 0 and, unless the sides are periodic, beside the wall x = 0.
  void place_walls(const SceneOptions& o) {
    const int across = o.particles_across, deep = o.dimensions == 3 ? across : 1;
    const bool side = o.surroundings == Surroundings::walls;
    for (int k = -3; k < across; ++k)
      for (int j = 0; j < deep; ++j)
        for (int i = side ? -3 : 0; i < across; ++i) {
          const bool plate = is_plate(o, k) && i >= 0;
          if (k >= 0 && i >= 0 && !plate) continue;
          reference::Wall w;
          w.x = {(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing};
          w.normal = k < 0 || plate ? reference::Vec{0, 0, 1} : reference::Vec{1, 0, 0};
          w.depth = (plate ? 0.5 : (k < 0 ? -k - 0.5 : -i - 0.5)) * spacing;
          if (plate) w.back_normal = {0, 0, -1}, w.back_depth = spacing / 2;
          w.pressure = random_.uniform(-30, 200);
          w.sticks = k < 0 || plate || j % 2 == 0;
          if (i % 2 == 0) w.slip_length = random_.uniform(0, 3 * spacing);
          world.walls.push_back(w);
        }
  }

  void set_constants() {
    const NumericsSetup& n = setup.numerics;
    world.dimensions = setup.dimensions, world.spacing = spacing,
    world.support = setup.support_ratio * spacing;
    world.sound_speed = n.sound_speed, world.diffusion = n.density_diffusion;
    world.tension_limit = n.tension_limit, world.anti_pairing = anti_pairing(setup);
    world.kernel = static_cast<reference::Kernel>(n.kernel);
    world.weight = static_cast<reference::Weight>(n.viscous_weight);
    world.viscous_tension = n.tension != TensionModel::limit;
    world.wall_tension_limit = common_wall_tension_limit(setup);
    world.correction = viscosity_correction(setup);
    const Vec3d g = setup.gravity, b = setup.body_acceleration;
    world.gravity = {g.x, g.y, g.z}, world.body_acceleration = {b.x, b.y, b.z};
    const auto& p = setup.domain.periodic;
    world.period = {p[0] ? setup.domain.upper.x : 0, p[1] ? setup.domain.upper.y : 0, 0};
    world.fluids = {{900, rounded(0.3), 0, 1}, {2600, 0.5, 5, 100}};
  }

  // Rounds the world to what the device holds, so that only the arithmetic differs.
  void upload_fluid() {
    std::vector<Vec3d> position;
    std::vector<Quad> place, motion, by_pressure, state;
    std::vector<std::uint8_t> kind;
    std::vector<Index> id;
    std::vector<Real> pressure, packing, hollow;
    for (reference::Particle& p : world.particles) {
      p.x = rounded(p.x), p.v = rounded(p.v), p.excess = rounded(p.excess), p.pressure = rounded(p.pressure);
      p.volume = rounded(p.volume), p.mass = rounded(p.mass), p.viscosity = rounded(p.viscosity);
      p.by_pressure = rounded(p.by_pressure), p.hollow = rounded(p.hollow);
      position.push_back({p.x.x, p.x.y, p.x.z});
      place.push_back(to_device(p.x, p.volume)), motion.push_back(to_device(p.v, p.excess));
      by_pressure.push_back(to_device(p.by_pressure, 0));
      state.push_back(to_device({p.pressure, p.viscosity, p.volume}, p.mass));
      packing.push_back(static_cast<Real>(p.packing)), hollow.push_back(static_cast<Real>(p.hollow));
      kind.push_back(static_cast<std::uint8_t>(p.fluid)), id.push_back(static_cast<Index>(id.size()));
      pressure.push_back(static_cast<Real>(p.pressure));
    }
    fluid.resize(static_cast<Index>(id.size()));
    fluid.position.upload(position), fluid.place.upload(place), fluid.motion.upload(motion);
    fluid.packing.upload(packing), fluid.state.upload(state), fluid.fluid.upload(kind), fluid.id.upload(id),
        fluid.pressure.upload(pressure), fluid.hollow.upload(hollow);
    fluid.by_pressure.upload(by_pressure), fluid.increment.upload(std::vector<Quad>(id.size())),
        fluid.last_increment.upload(std::vector<Quad>(id.size())),
        fluid.shear_rate.upload(std::vector<Real>(id.size()));
  }

  // Set anew in each step, it does not go with the particles.
  void upload_contact() {
    std::vector<Real> contact;
    for (const Index id : download(context, fluid.id.span()))
      contact.push_back(static_cast<Real>(world.particles[static_cast<std::size_t>(id)].contact));
    fluid.contact.upload(contact);
  }

  void upload_walls() {
    std::vector<Quad> place, normal, back, velocity, acceleration, moved;
    std::vector<Index> id;
    std::vector<Real> pressure, tension_limit;
    for (reference::Wall& w : world.walls) {
      w.x = rounded(w.x), w.v = rounded(w.v), w.depth = rounded(w.depth), w.pressure = rounded(w.pressure);
      w.back_depth = rounded(w.back_depth), w.slip_length = rounded(w.slip_length);
      place.push_back(to_device(w.x, 0)), normal.push_back(to_device(w.normal, w.depth));
      back.push_back(to_device(w.back_normal, w.back_depth));
      velocity.push_back(to_device(w.v, w.sticks ? w.slip_length : -1));
      w.acceleration = rounded(w.acceleration), acceleration.push_back(to_device(w.acceleration, 0));
      w.moved = rounded(w.moved), moved.push_back(to_device(w.moved, 0));
      tension_limit.push_back(static_cast<Real>(world.limit(w)));
      pressure.push_back(static_cast<Real>(w.pressure)), id.push_back(static_cast<Index>(id.size()));
    }
    wall.resize(static_cast<Index>(id.size()));
    wall.place.upload(place), wall.normal.upload(normal), wall.back.upload(back),
        wall.velocity.upload(velocity);
    wall.pressure.upload(pressure), wall.id.upload(id);
    if (walls_move) wall.acceleration.upload(acceleration), wall.moved.upload(moved);
    if (walls_have_limits) wall.tension_limit.upload(tension_limit);
  }

  template <class T>
  std::vector<T> in_order(const std::vector<T>& values, const Buffer<Index>& ids) {
    const std::vector<Index> id = download(context, ids.span());
    std::vector<T> result(id.size());
    for (std::size_t i = 0; i < id.size(); ++i) result[static_cast<std::size_t>(id[i])] = values[i];
    return result;
  }

  Random random_;
};

// The kinds of scene that every operator is tried on.
inline std::vector<SceneOptions> all_scenes() {
  return {{3, Surroundings::walls, 6, 0.2, 1},    {3, Surroundings::periodic, 6, 0.2, 2},
          {3, Surroundings::free, 5, 0.3, 3},     {2, Surroundings::walls, 9, 0.2, 4},
          {2, Surroundings::periodic, 8, 0.2, 5}, {2, Surroundings::free, 7, 0.3, 6}};
}

inline std::string scene_name(const SceneOptions& o) {
  const char* names[] = {"Free", "Walls", "Periodic"};
  return std::string(names[static_cast<int>(o.surroundings)]) + std::to_string(o.dimensions) + "D";
}

// What GoogleTest prints for a scene.
inline void PrintTo(const SceneOptions& o, std::ostream* out) { *out << scene_name(o); }

}  // namespace slagflow::testing_tools
