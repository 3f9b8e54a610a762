#include "host/measures/measures.hpp"

#include <algorithm>

#include "backend/error.hpp"
#include "host/geometry/inlets.hpp"
#include "host/measures/measure_contact.hpp"
#include "host/measures/measure_flux.hpp"
#include "host/measures/measure_force.hpp"
#include "host/measures/measure_front.hpp"
#include "host/measures/measure_heat.hpp"
#include "host/measures/measure_level.hpp"
#include "host/measures/measure_mixing.hpp"
#include "host/measures/measure_residence.hpp"
#include "host/measures/measure_surface.hpp"
#include "host/measures/measure_volume.hpp"
#include "host/measures/profiles.hpp"

namespace slagflow {
namespace {

// The setup lists what is measured by kind, in the order of the case; this counts along.
struct Counts {
  std::size_t fronts = 0, planes = 0, boxes = 0, lines = 0, levels = 0;
  std::size_t fluxes = 0, surfaces = 0, contacts = 0, residences = 0, solids = 0;
};

std::unique_ptr<Measure> make_probe(const MeasureSpec& spec, const SimulationSetup& setup, Counts& next) {
  switch (spec.type) {
    case MeasureType::flux:
      return std::make_unique<FluxMeasure>(spec, setup, next.fluxes++);
    case MeasureType::surface:
      return std::make_unique<SurfaceMeasure>(spec, setup, next.surfaces++);
    case MeasureType::mixing:
      return std::make_unique<MixingMeasure>(spec, setup);
    case MeasureType::contact:
      return std::make_unique<ContactMeasure>(spec, setup, next.contacts++);
    case MeasureType::solid:
      return std::make_unique<SolidMeasure>(spec, setup, next.solids++);
    case MeasureType::heat:
      return std::make_unique<HeatMeasure>(spec, setup);
    default:
      return std::make_unique<ResidenceMeasure>(spec, setup, next.residences++);
  }
}

std::unique_ptr<Measure> make_measure(const MeasureSpec& spec, const SimulationSetup& setup, std::int64_t fed,
                                      Counts& next) {
  const auto all = static_cast<std::int64_t>(setup.particles.position.size()) + fed;
  const double particles = static_cast<double>(std::max<std::int64_t>(all, 1));
  const double dx = setup.spacing, volume = setup.dimensions == 2 ? dx * dx : dx * dx * dx;
  switch (spec.type) {
    case MeasureType::jet: {
      const std::size_t index = next.fronts++;
      return std::make_unique<JetMeasure>(spec, setup.fronts.at(index), index, particles, dx);
    }
    case MeasureType::flow_rate: {
      const std::size_t index = next.planes++;
      const FrontSetup& plane = setup.planes.at(index);
      const bool periodic = setup.domain.periodic[static_cast<std::size_t>(plane.axis)];
      return std::make_unique<FlowMeasure>(
          spec, FlowMeasure::Geometry{plane, index, volume, setup.dimensions, periodic});
    }
    case MeasureType::volume:
      return std::make_unique<VolumeMeasure>(spec, next.boxes++, volume, setup.dimensions);
    case MeasureType::force: {
      const auto body = static_cast<std::size_t>(spec.wall);
      return std::make_unique<ForceMeasure>(spec, setup.bodies.at(body).name, setup.dimensions);
    }
    case MeasureType::level:
      return std::make_unique<LevelMeasure>(spec, next.levels++);
    case MeasureType::profile:
      return std::make_unique<ProfileMeasure>(spec, setup.lines.at(next.lines++));
    case MeasureType::front: {
      const std::size_t index = next.fronts++;
      return std::make_unique<FrontMeasure>(spec, setup.fronts.at(index), index, particles);
    }
    default:
      return make_probe(spec, setup, next);
  }
}

}  // namespace

Measures::Measures(const Case& c, const SimulationSetup& setup) {
  Counts next;
  // By the end of the case: where a run is told to pause changes nothing.
  const std::int64_t fed = fed_particles(setup, c.output.end_time) - fed_particles(setup, setup.start_time);
  for (const MeasureSpec& spec : c.measures) measures_.push_back(make_measure(spec, setup, fed, next));
}

std::vector<std::string> Measures::columns() const {
  std::vector<std::string> names;
  for (const auto& m : measures_)
    for (const std::string& ending : m->columns()) names.push_back(m->name() + "_" + ending);
  return names;
}

std::vector<double> Measures::update(double time, const Totals& totals, const ReadSnapshot& read) {
  std::vector<double> values;
  for (const auto& m : measures_)
    for (const double value : m->update({time, totals, read})) values.push_back(value);
  return values;
}

std::vector<double> Measures::state() const {
  std::vector<double> state;
  for (const auto& m : measures_)
    for (const double value : m->state()) state.push_back(value);
  return state;
}

void Measures::restore(const std::vector<double>& state) {
  const std::size_t wanted = this->state().size();
  if (state.size() != wanted)
    throw Error("checkpoint: " + std::to_string(state.size()) + " numbers of measures, the case's have " +
                std::to_string(wanted));
  const double* next = state.data();
  for (const auto& m : measures_) {
    m->restore(next);
    next += m->state().size();
  }
}

bool Measures::arrived(const std::string& name) const {
  return std::any_of(measures_.begin(), measures_.end(),
                     [&](const auto& m) { return m->name() == name && m->arrived(); });
}

Json Measures::summary() const {
  Json all = Json::object();
  for (const auto& m : measures_) all.set(m->name(), m->summary());
  return all;
}

std::vector<std::string> Measures::lines() const {
  std::vector<std::string> lines;
  for (const auto& m : measures_) lines.push_back(m->name() + " (" + m->type() + "): " + m->line());
  return lines;
}

}  // namespace slagflow
