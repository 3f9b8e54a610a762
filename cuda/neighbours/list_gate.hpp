// Whether a step has to look at what became of the neighbour lists.
#pragma once

#include <cmath>

#include "fluid/math.hpp"
#include "fluid/step_record.hpp"

namespace slagflow {

struct ListReach {
  double support = 0;     // h [m]
  double fluid_skin = 0;  // a pair of fluid particles not listed is at least h + skin apart when listed
  double wall_skin = 0;   // the same for a fluid and a wall particle
  double width = 0;       // narrowest width of a cell [m]
};

enum class Verdict { hold, broken, open };

// What the largest displacements [m] since the particles were sorted tell already.
HOST_DEVICE inline Verdict judge(double fluid_moved, double walls_moved, const ListReach& reach) {
  if (fluid_moved <= 0.5 * reach.fluid_skin && fluid_moved + walls_moved <= reach.wall_skin)
    return Verdict::hold;
  const double farthest = reach.width - 0.5 * reach.support;
  return fluid_moved <= farthest && walls_moved <= farthest ? Verdict::open : Verdict::broken;
}

// Shut while no particle has moved far enough to matter, and once one has moved too far; after the first look
// each step counts, as what counts is added up.
struct ListGate {
  const StepRecord* record;  // null: the host has decided that it is open
  const Index* opened;       // since the particles were sorted
  ListReach reach;

  HOST_DEVICE bool shut() const {
    if (!record) return false;
    if (!record->solve.converged) return true;
    const Verdict verdict = judge(std::sqrt(record->displacement_squared), 0, reach);
    return verdict == Verdict::broken || (verdict == Verdict::hold && !*opened);
  }
};

template <class Body>
struct IfOpen : Body {
  ListGate gate;
  HOST_DEVICE bool idle() const { return gate.shut(); }
};

}  // namespace slagflow
