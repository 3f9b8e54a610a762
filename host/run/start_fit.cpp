// The fluid of a state in another case: how it comes there, and whether it can.
#include <algorithm>
#include <array>

#include "backend/error.hpp"
#include "heat/material_table.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/wall_depth.hpp"
#include "host/run/start_state.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

// Why a key must stay; empty: it may change.
std::string reason_to_stay(const std::string& key, const Case& c) {
  const std::string end = ".temperature";  // of fluid that had none
  if (begins(key, "region.") && key.size() > end.size() && key.substr(key.size() - end.size()) == end)
    return "";
  if (begins(key, "region.")) return "the fluid is that of the state, no region is filled";
  if (key == "numerics.background_pressure") return "it is in the pressures of the state";
  for (const char* name : {"resolution.spacing", "resolution.dimensions", "resolution.origin"})
    if (key == name) return "the particles are those of the state";
  if (key == "domain.periodic") return "the fluid of the state goes on beyond the faces that it names";
  const bool periodic =
      std::any_of(c.domain.periodic.begin(), c.domain.periodic.end(), [](bool p) { return p; });
  if (periodic && (key == "domain.min" || key == "domain.max"))
    return "the fluid of the state has its periods";
  return "";
}

std::string text_of(const Vec3d& p) { return "(" + show(p.x) + ", " + show(p.y) + ", " + show(p.z) + ") m"; }

// What is wrong, a line each.
class Problems {
 public:
  void add(const std::string& line) { text_ += (text_.empty() ? "" : "\n") + line; }
  void raise() const {
    if (!text_.empty()) throw InputError(text_);
  }

 private:
  std::string text_;
};

// In the domain of its own run particles that have just left are still there: they are counted and removed
// when this one begins.
void check_domain(const BuiltCase& built, const std::vector<KeyChange>& changes, Problems& problems) {
  const DomainSetup& domain = built.setup.domain;
  const bool changed = std::any_of(changes.begin(), changes.end(),
                                   [](const KeyChange& change) { return begins(change.key, "domain."); });
  if (!changed && domain.departure == Departure::remove) return;
  std::size_t count = 0;
  Vec3d first;
  for (const Vec3d& p : built.setup.particles.position) {
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      inside = inside && (domain.periodic[static_cast<std::size_t>(k)] ||
                          (p[k] >= domain.lower[k] && p[k] <= domain.upper[k]));
    if (!inside && count++ == 0) first = p;
  }
  if (count > 0)
    problems.add(built.resolved.place_of("domain") + ": " + std::to_string(count) +
                 " particles of the state are outside of the domain, the first at " + text_of(first) +
                 ": allowed: a domain that holds them");
}

void check_walls(const BuiltCase& built, Problems& problems) {
  constexpr double deep = 0.5;  // [spacings]
  WallDepth depth(built.resolved);
  depth.move_to(built.setup.start_time);
  std::size_t count = 0;
  double deepest = deep * built.resolved.spacing;
  Vec3d where;
  for (const Vec3d& p : built.setup.particles.position) {
    const double d = depth.of(p);
    if (d > deep * built.resolved.spacing) ++count;
    if (d > deepest) deepest = d, where = p;
  }
  if (count > 0)
    problems.add(built.resolved.place_of("wall") + ": " + std::to_string(count) +
                 " particles of the state would be deeper than half a spacing in walls, the deepest " +
                 show(deepest) + " m at " + text_of(where) +
                 ": allowed: walls that are clear of the fluid at " + show(built.setup.start_time) + " s");
}

// The number of each fluid of the state among those of the case; -1: none.
std::vector<int> numbers_of(const Case& before, const Case& after) {
  std::vector<int> numbers;
  for (const FluidSpec& fluid : before.fluids) {
    const auto found = std::find_if(after.fluids.begin(), after.fluids.end(),
                                    [&](const FluidSpec& f) { return f.name == fluid.name; });
    numbers.push_back(found == after.fluids.end() ? -1 : static_cast<int>(found - after.fluids.begin()));
  }
  return numbers;
}

bool same_material(const FluidSpec& a, const FluidSpec& b) {
  return a.material.heat_capacity == b.material.heat_capacity &&
         a.material.solid_fraction == b.material.solid_fraction &&
         a.material.latent_heat == b.material.latent_heat;
}

// Where a material has changed the fluid keeps its temperature, else its enthalpy, which tells more of it.
void keep_temperatures(const Case& before, const Case& after, const std::vector<int>& numbers,
                       FluidParticles& p) {
  bool changed = false;
  std::vector<std::vector<MaterialRow>> tables;
  for (std::size_t k = 0; k < before.fluids.size(); ++k) {
    const bool there = numbers[k] >= 0;
    changed = changed ||
              (there && !same_material(before.fluids[k], after.fluids[static_cast<std::size_t>(numbers[k])]));
    tables.push_back(material_rows(before.fluids[k].material, {before.fluids[k].parameters[0], 0}, 0));
  }
  if (!changed) return;
  for (std::size_t i = 0; i < p.fluid.size(); ++i) {
    const std::vector<MaterialRow>& table = tables[p.fluid[i]];
    const Material material{{table.data(), static_cast<Offset>(table.size())}, 0};
    p.temperature.push_back(static_cast<double>(material.at_enthalpy(p.memory.enthalpy[i]).temperature));
  }
  p.memory.enthalpy.clear();
}

// Fluid of a state without heat has in a case with heat the temperature that the case gives it.
void add_temperatures(const Case& c, FluidParticles& p) {
  if (!c.thermal.on || !p.temperature.empty() || !p.memory.enthalpy.empty()) return;
  for (const std::uint8_t kind : p.fluid) {
    const auto region = std::find_if(c.regions.begin(), c.regions.end(),
                                     [&](const RegionSpec& r) { return r.fluid == kind; });
    if (region == c.regions.end())
      throw InputError(c.file + ": the state has no temperatures, and the case has no region of fluid '" +
                       c.fluids[kind].name + "': allowed: one, whose temperature the fluid takes");
    p.temperature.push_back(region->temperature);
  }
}

}  // namespace

void start_from(const StartState& start, BuiltCase& built) {
  FluidState state = fluid_state(start.checkpoint.state);
  const Case &before = start.before, &after = built.resolved;
  const std::vector<int> numbers = numbers_of(before, after);
  FluidParticles& p = state.particles;
  if (!p.memory.enthalpy.empty() && after.thermal.on) keep_temperatures(before, after, numbers, p);
  const double softer = square(before.numerics.sound_speed / after.numerics.sound_speed);
  for (std::size_t i = 0; i < p.position.size(); ++i) {
    const std::size_t kind = p.fluid[i];
    if (kind >= numbers.size() || numbers[kind] < 0)
      throw InputError(after.file + ": fluid '" +
                       (kind < numbers.size() ? before.fluids[kind].name : std::to_string(kind)) +
                       "' of the state is none of the case: allowed: fluids of the same names");
    const FluidSpec &old = before.fluids[kind], &now = after.fluids[static_cast<std::size_t>(numbers[kind])];
    const double denser = now.density / old.density, excess = static_cast<double>(p.memory.excess[i]);
    const double changed = excess * denser * softer;
    const auto filled = [](double e, double rest) { return 1 + larger(e / rest, -0.5); };
    const double kept = filled(changed, now.density) / filled(excess, old.density);
    p.memory.excess[i] = static_cast<Real>(changed);
    p.memory.packing[i] = static_cast<Real>(static_cast<double>(p.memory.packing[i]) * kept);
    p.memory.hollow[i] = static_cast<Real>(static_cast<double>(p.memory.hollow[i]) * denser);
    p.memory.by_pressure[i] = static_cast<Real>(denser) * p.memory.by_pressure[i];
    p.fluid[i] = static_cast<std::uint8_t>(numbers[kind]);
    p.pressure.push_back(square(after.numerics.sound_speed) * changed);
  }
  add_temperatures(after, p);
  if (std::any_of(after.walls.begin(), after.walls.end(),
                  [](const WallSpec& w) { return w.thermal.kind == WallHeat::semi_infinite; }))
    built.warnings.push_back(
        "walls that are semi_infinite begin at their temperature: the heat that they had taken up in the "
        "other run "
        "is not carried over; slagflow resume keeps it");
  built.setup.particles = std::move(p);
  built.setup.start_time = state.time, built.setup.last_step = state.last_step;
}

void require_startable(const StartState& start, const BuiltCase& built,
                       const std::vector<KeyChange>& changes) {
  Problems problems;
  bool walls = false;
  for (const KeyChange& change : changes) {
    const std::string reason = reason_to_stay(change.key, start.before);
    walls = walls || begins(change.key, "wall.");
    if (!reason.empty())
      problems.add(built.resolved.place_of(change.key) + ": key '" + change.key + "': value " +
                   (change.after.empty() ? "none" : change.after) + ": " + reason +
                   ": allowed: " + (change.before.empty() ? "none" : change.before));
  }
  if (built.setup.particles.position.empty()) problems.add(start.text() + ": holds no fluid");
  problems.raise();
  check_domain(built, changes, problems);
  if (walls) check_walls(built, problems);
  const double time = built.setup.start_time, end = built.resolved.output.last_time();
  if (end <= time)
    problems.add(built.resolved.place_of("output.end_time") +
                 ": key 'output.end_time': the run would end at " + show(end) + " s, the state is of " +
                 show(time) + " s and its clock goes on: allowed: --set output.end_time=SECONDS beyond that");
  problems.raise();
}

}  // namespace slagflow
