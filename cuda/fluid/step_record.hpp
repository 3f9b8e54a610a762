// What a step leaves on the device for the host, which reads it all at once.
#pragma once

#include "fluid/solve_state.hpp"

namespace slagflow {

struct StepRecord {
  SolveState solve;
  double taken = 0;                 // energy that viscous forces take from the fluid in the step [J]
  double given = 0;                 // energy that pairing and walls give it by pressure [J]
  double capillary_power = 0;       // of surface tension during the step [W]
  double displacement_squared = 0;  // largest since the lists were built [m^2]
  double approach = 0;              // largest of two cells beyond the skin of the lists [m]
  double compression = 0;           // largest (rho - rho0)/rho0 of the step
};

}  // namespace slagflow
