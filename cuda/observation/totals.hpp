// What is told of a simulation: sums over the fluid, fronts, planes, profiles, the loads of walls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid/math.hpp"
#include "fluid/thermal.hpp"

namespace slagflow {

struct FrontState {
  std::int64_t passed = 0;  // particles beyond the plane, those that left through a face beyond it included
  Vec3d mean_position;      // [m] of those beyond it that are still in the domain
  double extreme = 0;       // [m] leading coordinate along the axis
};

// What has passed a plane, in particles. passed + behind + lost_behind = start_behind, unless the axis is
// periodic.
struct PlaneState {
  std::int64_t passed = 0;        // along the plane's direction less against it, since the start
  std::int64_t behind = 0;        // in the domain, not beyond the plane
  std::int64_t lost_behind = 0;   // left the domain while behind the plane
  std::int64_t start_behind = 0;  // behind at the start
};

// The fluid at a point of a line; not-a-number where there is too little of it.
struct ProfilePoint {
  double distance = 0;    // [m] from the start of the line
  Vec3d position;         // [m]
  Vec3d velocity;         // [m/s]
  double shear_rate = 0;  // [1/s]
  double viscosity = 0;   // [Pa s]
  // Where heat is on; the temperature is relative to that of reference where measure_profile() gives it.
  double temperature = 0, solid_fraction = 0;  // [K], 1
  double fill = 0;                             // sum of V_j W: 1 inside of the fluid
};

// What the fluid did to a wall since the start, as integrals over time: forces [N s], torques [N m s] about
// the origin; and the work the wall did on the fluid [J].
struct WallLoad {
  Vec3d pressure, viscous;
  Vec3d pressure_torque, viscous_torque;
  double work = 0;
};

// Where fluid is on a line, by its fill of a half [m] from the start: the farthest end of fluid, not-a-number
// without any, and the length in fluid.
struct LevelState {
  double surface = 0, thickness = 0;
};

// Particles that went through a rectangle since the start, along its normal and against it, by fluid.
struct FluxState {
  std::vector<std::int64_t> forward, backward;
};

// Where fluid is on a wall, and its pressure on the surface; without fluid the pressures are not-a-number.
struct ContactState {
  double area = 0, wetted = 0;  // [m^2]; [m] with two dimensions
  double mean_pressure = 0;     // [Pa] over the wetted area
  double largest_pressure = 0;  // [Pa]
  Vec3d place;                  // [m] of that
};

// How long particles were in the domain before they came to an outlet, by those that have; not-a-number
// without any. Those of the start came at the start.
struct ResidenceState {
  std::int64_t left = 0;
  double mean = 0, deviation = 0;       // [s]
  std::array<double, 5> percentiles{};  // [s] 5, 25, 50, 75 and 95 %
  double mean_inside = 0;               // [s] age of the fluid in the domain
};

struct Totals {
  std::int64_t particles = 0;                  // fluid particles in the domain
  std::array<std::int64_t, 6> departed{};      // through -x +x -y +y -z +z
  double mass_start = 0;                       // [kg] at the start
  double mass_in = 0;                          // [kg] in the domain
  double mass_left = 0;                        // [kg] departed, or taken by outlets
  double mass_fed = 0;                         // [kg] by inlets
  std::vector<std::int64_t> fed, removed;      // particles, by inlet and by outlet
  std::vector<double> fed_mass, removed_mass;  // [kg]
  double max_speed = 0;                        // [m/s]
  double kinetic_energy = 0;                   // [J]
  double potential_energy = 0;                 // [J], -sum m (gravity + body acceleration) . x
  double dissipated_energy = 0;                // [J], by viscosity since the start
  double max_density_error = 0;     // largest (rho - rho0)/rho0; expansion, as in spray, is not counted
  std::int64_t in_thin_sheets = 0;  // particles in sheets below three across (observation/sheets.hpp)
  double min_density_ratio = 1;     // smallest rho/rho0
  Vec3d momentum;                   // [kg m/s]
  Vec3d angular_momentum;           // [kg m^2/s] about the origin
  std::vector<FrontState> fronts;   // one per SimulationSetup::fronts
  std::vector<PlaneState> planes;   // one per SimulationSetup::planes
  std::vector<LevelState> levels;   // one per SimulationSetup::levels
  std::vector<FluxState> fluxes;    // one per SimulationSetup::rectangles
  std::vector<std::vector<LevelState>> surfaces;  // one per column of each SimulationSetup::surfaces
  std::vector<ContactState> contacts;             // one per SimulationSetup::contacts
  std::vector<ResidenceState> residences;         // one per SimulationSetup::residences
  std::vector<std::int64_t> boxes;                // particles in each of SimulationSetup::boxes
  bool heat_is_on = false;
  HeatBalance heat;
  std::vector<std::int64_t> solids;  // particles, one per SimulationSetup::solids
  double impulse_time = 0;           // [s] until which their impulses were gathered: that of the velocities
  std::vector<WallLoad> walls;       // one per SimulationSetup::bodies where SimulationSetup::measure_walls
};

}  // namespace slagflow
