// What tells of a launcher.
#include <cstdlib>

#include "backend/ranks.hpp"

namespace slagflow {

// Of a launcher: Open MPI, MPICH and its kin, Slurm.
bool Ranks::launched_with_others() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && std::atoi(value) > 1) return true;
  }
  return false;
}

}  // namespace slagflow
