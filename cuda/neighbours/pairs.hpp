// The particles as a sweep over the pairs sees them.
#pragma once

#include "fluid/params.hpp"
#include "fluid/particles.hpp"
#include "neighbours/neighbours.hpp"

namespace slagflow {

// What a sweep over the pairs of the fluid particles needs.
struct PairContext {
  ListView fluid_list, wall_list;
  FluidView fluid;
  WallView wall;
  Span<const FluidConstants> fluids;
  FlowConstants flow;
  PeriodicBox box;
  Span<const Quad> capillary{};  // xyz: acceleration by surface tension [m/s^2]; empty without
};

}  // namespace slagflow
