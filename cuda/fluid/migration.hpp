// Particles that go to other ranks.
#pragma once

#include <vector>

#include "fluid/particle_arrays.hpp"

namespace slagflow {

// The rows behind the first `kept` go, so many to each rank, in the order of the ranks; what comes takes
// their place. All arrays that are sorted. Returns how many rows there are then. A call of all ranks.
Index migrate(ParticleArrays&, Index kept, const std::vector<Index>& leaving);

// The rows that the neighbours want, and those of theirs that are wanted here: `border` rows of its own at
// the lower end and at the upper end. A call of all ranks.
struct Borders {
  Index to_below = 0, to_above = 0;
};
Halo meet_neighbours(const Slabs&, Index own, const Borders&);

// Makes the copies behind the rows those of now, in all arrays that are sorted.
void exchange_all(const ParticleArrays&);

}  // namespace slagflow
