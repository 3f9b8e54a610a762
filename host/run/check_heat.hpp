// What can be said of the heat of a case before it runs.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/setup_builder.hpp"
#include "host/output/summary_json.hpp"
#include "host/run/start_facts.hpp"

namespace slagflow {

struct FluidHeat {
  std::string name;
  double diffusivity = 0;     // [m^2/s] alpha, largest over temperature
  double half_cell_biot = 0;  // (h + 4 eps sigma T^3) spacing / 2 k, at the start's hottest temperature
  double stefan = 0;          // c (T - T_solid) / L; not-a-number without latent heat
  double nahme = 0;           // eta U^2 b / k, b = -d ln eta / dT
  double resolved_from = 0;   // [s] 1.4 spacing^2 / alpha: from then on heat to walls is right within 5 %
  double creep = 0;           // [1/s] rho g H / eta_max: at which a crust under its own weight gives way
};
struct WallContactHeat {
  std::string wall, fluid;
  double temperature = 0;  // [K] where they touch at first, without contact resistance
};
struct ThickWallHeat {
  std::string wall;
  double thickness = 0;  // [m] as drawn
  double felt = 0;       // [s] from which on it is felt that it ends: sqrt(alpha t) is half of the thickness
};

struct HeatCheck {
  bool on = false;
  double time_step = 0;   // [s] (H11)
  double flow_until = 0;  // [s]; infinite: all the time
  std::vector<FluidHeat> fluids;
  std::vector<WallContactHeat> contacts;
  std::vector<ThickWallHeat> thick_walls;
  std::vector<std::string> warnings;
};

// `speed` U and `depth` H as of the case's other numbers [m/s], [m].
HeatCheck check_heat(const BuiltCase&, double speed, double depth, const std::vector<ThinnestWall>&);
std::string to_text(const HeatCheck&);
Json to_json(const HeatCheck&);

}  // namespace slagflow
