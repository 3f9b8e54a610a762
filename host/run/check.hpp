// What can be said of a case before it runs: sizes, time step, dimensionless numbers and cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/geometry/setup_builder.hpp"
#include "host/output/summary_json.hpp"
#include "host/run/check_heat.hpp"
#include "host/run/machine_speed.hpp"
#include "host/run/start_facts.hpp"

namespace slagflow {

// Costs, for estimates only; the time is that of the CPU build, where this machine has not been timed.
// Measured in the dam at 1 mm, 102 000 fluid and 66 600 wall particles: the process holds 2.2 kB a fluid
// particle, the device 1.65 kB of them; 3231 steps take 9.4 minutes on two cores.
inline constexpr double bytes_per_fluid_particle = 2000;
inline constexpr double bytes_per_wall_particle = 300;
inline constexpr double bytes_per_cell = 60;  // of the grid over the domain, beyond a few for each particle
inline constexpr double particle_steps_per_second = 5.8e5;  // fluid particles, two cores
// In particles.vtkhdf and walls.vtkhdf, of a particle in a snapshot.
inline constexpr double bytes_per_snapshot_particle = 70, bytes_per_snapshot_wall = 29;
// Times as long with an exact yield stress: 5 to 15 in flows of the cases, 2.4 where nothing yields.
inline constexpr double exact_yield_cost = 7;

struct FluidNumbers {
  std::string name;
  double reynolds = 0;   // rho U L / eta
  double bingham = 0;    // tau_B L / (eta U), 0 without a yield stress
  double dam = 0;        // N = rho L sqrt(g H) / eta, equation (9) of Tsuboi and Ito 2017
  double capillary = 0;  // eta U / sigma, not-a-number without surface tension
};

struct CaseCheck {
  std::int64_t fluid_particles = 0, wall_particles = 0;
  double spacing = 0, support_radius = 0;  // [m]
  double time_step = 0;                    // [s] largest that the limits allow
  std::string time_step_reason;
  double steps = 0;  // to the end time
  double depth = 0;  // [m] H, extent of the fluid along gravity; without gravity: its smallest extent
  double width = 0;  // [m] L, smaller extent of the fluid across gravity; without gravity: as H
  double speed = 0;  // [m/s] U
  std::string speed_source;
  std::vector<FluidNumbers> fluids;       // numbers that need a speed are not-a-number where there is none
  double sound_speed = 0, mach = 0;       // [m/s], U / sound speed
  std::vector<std::string> sound_speeds;  // a line for each term of the automatic one
  HeatCheck heat;
  double froude = 0;                // U / sqrt(g H)
  double viscosity_correction = 0;  // C of equation (7)
  std::vector<FluidPiece> pieces;   // of the fluid at the start, the largest first
  double fluid_across = 0;          // particles across the thinnest of them; not-a-number without any
  std::vector<ThinnestWall> walls;  // where each is thinnest
  ThinnestWall wall;                // the thinnest of them
  std::string extents;              // of the domain
  std::vector<std::string> files;   // STL files, and what they reach over
  std::string exits;                // of the domain, and what becomes of fluid that leaves elsewhere
  std::int64_t fed = 0;             // particles that inlets bring to the end
  std::vector<std::string> inlets;  // a line each
  double memory = 0;                // [bytes]
  double output = 0;                // [bytes] of the snapshots
  double snapshots = 0;
  double run_time = 0;   // [s]
  MachineSpeed machine;  // by which that is; particle_steps 0: not timed
  double gpu_time = 0;   // [s] a model figure
  bool exact_yield = false;
  std::vector<std::string> warnings;
  std::vector<std::string> advice;  // keys to change, and why
};

// eta is the first parameter of a fluid's rheology (the plastic or the dynamic viscosity). `machine`: what
// this machine computes; without it two cores of the past.
CaseCheck check_case(const BuiltCase& built, const MachineSpeed& machine = {});

// Throws InputError that says how much memory the case needs and how much there is, when it is more than
// that. [bytes]
void require_memory(const BuiltCase& built, double available);

// For people, and for programs: numbers in SI units, by the names above; null where one is not known.
std::string to_text(const CaseCheck& check);
Json to_json(const CaseCheck& check);

}  // namespace slagflow
