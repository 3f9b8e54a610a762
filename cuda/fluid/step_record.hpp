// What a step leaves on the device for the host, which reads it all at once.
#pragma once

#include "fluid/solve_state.hpp"

namespace slagflow {

struct StepRecord {
  SolveState solve;
  double taken = 0;                 // energy that viscous forces take from the fluid in the step [J]
  double given = 0;                 // energy that pairing and walls give it by pressure [J]
  double capillary_power = 0;       // of surface tension during the step [W]
  double displacement_squared = 0;  // largest since the particles were sorted into cells [m^2]
  double worn = 0;                  // above 0: rows of the lists do not hold and were not filled anew
  double speed_squared = 0;         // largest [m^2/s^2]
  double compression = 0;           // largest (rho - rho0)/rho0 of the step
};

}  // namespace slagflow
