// One step of conduction: what passes between particles, at walls and at free surfaces.
#pragma once

#include "heat/heat_params.hpp"

namespace slagflow {

// What a step reads of the fluid beside the pairs, and writes.
struct ConductionStep {
  Materials materials;
  HeatConstants constants;
  SiteView sites;
  Span<const Quad> heat;        // of each particle
  Span<const Real> emissivity;  // of each fluid
  double elapsed;               // [s]
};
struct SiteOutput {
  Span<Real> temperature, share;
  Span<double> taken;  // [J]
};
struct FluidOutput {
  Span<double> enthalpy, lost;  // [J/kg], [J]
};

// First what each site of the walls becomes and takes, then what the fluid does; both by the same pairs and
// the same numbers, so that nothing is lost between them. `wall_at`: place of each wall particle by id, -1
// for those that vanished.
void conduct_to_walls(Context&, const PairContext&, const ListView& wall_to_fluid, const ConductionStep&,
                      Span<const Index> wall_at, const SiteOutput&);
void conduct_in_fluid(Context&, const PairContext&, const ConductionStep&, const FluidOutput&);

}  // namespace slagflow
