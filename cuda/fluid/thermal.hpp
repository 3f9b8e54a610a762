// What of a simulation concerns heat, in plain host data.
#pragma once

#include <limits>
#include <vector>

#include "fluid/math.hpp"

namespace slagflow {

inline constexpr double stefan_boltzmann = 5.670374e-8;  // [W/(m^2 K^4)]

struct ThermalSetup {
  bool on = false;
  double ambient_temperature = 0;    // [K]
  double surface_heat_transfer = 0;  // [W/(m^2 K)]
  bool radiation = false;
  bool viscous_heating = false;
  double flow_until = std::numeric_limits<double>::infinity();  // [s] from which on nothing moves
  double reference_temperature = 0;  // [K] hottest fluid of the start: what is stored is relative to it
};

// adiabatic: nothing passes. temperature: held. flux: given. semi_infinite: a thick wall that takes up heat
// from its surface on, by the integral method with one number a site.
enum class WallHeat : int { adiabatic, temperature, flux, semi_infinite };

struct WallThermal {
  WallHeat kind = WallHeat::adiabatic;
  double temperature = 0;                                   // [K] held, or of a thick wall at the start
  double heat_flux = 0;                                     // [W/m^2] into the fluid
  double contact = 0;                                       // h_c [W/(m^2 K)] of the contact; 0: perfect
  double conductivity = 0, density = 0, heat_capacity = 0;  // of a thick wall [W/(m K)], [kg/m^3], [J/(kg K)]
};

// Where the heat is and went [J] since the start; with two dimensions of a metre of width.
struct HeatBalance {
  double content = 0;  // sum m h of the fluid, above that at 298.15 K
  double start = 0;    // the same at the start
  double fed = 0, left = 0;
  double surface = 0;               // lost to the surroundings
  std::vector<double> walls;        // lost to each body
  double viscous = 0;               // gained
  double coolest = 0, hottest = 0;  // [K] of the fluid; not-a-number without any
  // What has come or gone without a trace: content + what was lost - what was gained - start.
  double error() const {
    double taken = surface;
    for (const double wall : walls) taken += wall;
    return content + taken + left - fed - viscous - start;
  }
};

}  // namespace slagflow
