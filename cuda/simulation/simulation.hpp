// The simulation: owns all particle data on the device and advances it step by step.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "backend/device.hpp"
#include "fluid/saved_state.hpp"
#include "fluid/setup.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// Host copies of the state, in order of particle id. Vectors are reused between calls.
struct FluidSnapshot {
  double time = 0;                       // [s]
  std::vector<Vec3d> position;           // [m]
  std::vector<Vector3<float>> velocity;  // [m/s]
  std::vector<float> pressure;           // [Pa]
  std::vector<float> density;            // [kg/m^3]
  std::vector<float> viscosity;          // [Pa s]
  std::vector<float> shear_rate;         // [1/s]
  std::vector<float> shear_stress;       // [Pa]
  std::vector<float> thickness;          // [m] of the sheet that the particle is in
  std::vector<std::uint8_t> yielded;     // 1 where that exceeds the yield stress
  std::vector<std::uint8_t> fluid;       // index of the fluid
  std::vector<std::int64_t> id;          // constant through the run
  bool heat = false;                     // whether it is on:
  std::vector<float> temperature;        // [K]
  std::vector<float> solid_fraction;     // of the volume
};

// The fluid of a state, with which another simulation can begin.
struct FluidState {
  FluidParticles particles;  // in order of ids, with what they remember; without pressures
  double time = 0;           // [s]
  double last_step = 0;      // [s] that the step before took
};

// What a saved state holds of that, as arrays for a file of its own; the lower corner of the domain it was
// in [m].
SavedState fluid_arrays(const SavedState&, Vec3d lower);
// The same of a snapshot, which knows neither void nor the last step: the fluid then rests, as it were, under
// its pressure.
SavedState fluid_arrays(const FluidSnapshot&, const std::vector<FluidSetup>& fluids);
// Throws Error when an array is missing or does not fit.
FluidState fluid_state(const SavedState& fluid_arrays);

// Calls v(name, unit, meaning, values) for each array besides the positions, by the name it has in files.
template <class Visitor>
void describe(Visitor& v, const FluidSnapshot& s) {
  v("Velocity", "m/s", "velocity", s.velocity);
  v("Pressure", "Pa", "pressure", s.pressure);
  v("Density", "kg/m^3", "density", s.density);
  v("Viscosity", "Pa s", "dynamic viscosity", s.viscosity);
  v("ShearRate", "1/s", "shear rate", s.shear_rate);
  v("ShearStress", "Pa", "magnitude of the viscous stress", s.shear_stress);
  v("SheetThickness", "m", "thickness of the sheet, thread or drop, up to 4.5 spacings", s.thickness);
  v("Yielded", "1", "1 where the stress exceeds the yield stress", s.yielded);
  v("Fluid", "1", "index of the fluid, in the order of the case", s.fluid);
  v("ParticleId", "1", "number of the particle, constant through the run", s.id);
  if (!s.heat) return;
  v("Temperature", "K", "temperature", s.temperature);
  v("SolidFraction", "1", "share of solids in the volume", s.solid_fraction);
}

struct WallSnapshot {
  double time = 0;
  bool moves = false;              // whether positions change, or particles vanish, during the run
  std::vector<Vec3d> position;     // [m]
  std::vector<float> pressure;     // [Pa]
  std::vector<std::uint8_t> body;  // index of the body
  bool heat = false;               // whether it is on:
  std::vector<float> temperature;  // [K] of the surface; not-a-number where no heat passes
};

template <class Visitor>
void describe(Visitor& v, const WallSnapshot& s) {
  v("Pressure", "Pa", "pressure", s.pressure);
  v("Wall", "1", "index of the wall, in the order of the case", s.body);
  if (s.heat) v("Temperature", "K", "of the surface; not-a-number where no heat passes", s.temperature);
}

enum class Reading { fluid, fluid_and_walls };

// Host copies of a simulation's state under way; see Simulation::start_reading(). Ends before the simulation.
class StateTransfer {
 public:
  StateTransfer();
  ~StateTransfer();
  StateTransfer(const StateTransfer&) = delete;
  StateTransfer& operator=(const StateTransfer&) = delete;

  bool under_way() const;
  // Waits until all has arrived, and gives it; the walls as they are where they were not read. Any thread may
  // do so while the simulation steps on. Throws Error when the device has failed.
  void finish(FluidSnapshot&, WallSnapshot&);

 private:
  friend class Simulation;
  struct Data;
  std::unique_ptr<Data> data_;
};

struct PeakCompression {
  double value = 0;  // (rho - rho0)/rho0
  double time = 0;   // [s]
};

struct SolveReport {
  int iterations = 0;
  double residual = 0;        // ||b - A u|| / ||b||, of the true residual
  double velocity_error = 0;  // bound of the rms velocity error [m/s]: ||r|| / (m sqrt(N))
  bool converged = true;
};

struct SolverTotals {
  std::int64_t steps = 0, iterations = 0;
  int max_iterations = 0;
  double worst_residual = 0;
  // With an exact yield stress: its iterations, and the solves that ended at the most allowed.
  std::int64_t yield_iterations = 0, yield_unconverged = 0;
  std::int64_t retried = 0;  // solves that did not converge and were repeated with half the time step
};

class Simulation {
 public:
  // Copies the setup to the device. Throws Error on impossible input or lack of memory.
  explicit Simulation(const SimulationSetup& setup);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  // Advances by one time step. Throws Error when the state cannot go on: not-a-number, unconverged solve, a
  // compression beyond its limit, or, looked at every few steps, another of SimulationSetup::limits.
  void step();
  // Looks at the limits now. Throws Error as step does.
  void require_sound();

  double time() const;       // [s]
  double time_step() const;  // [s] of the last step; of the coming one before the first
  // [s] over which the last step changed the velocities: they are those of half a step before time().
  double velocity_time_step() const;
  std::int64_t steps() const;
  std::int64_t particles() const;          // fluid, in the domain as of the last build of the lists
  std::int64_t particles_of_rank() const;  // of those
  std::int64_t copies_of_rank() const;     // of particles that other ranks have
  // [m] of the fluid, in no order; with several ranks on the first
  std::vector<Vec3d> positions() const;
  Totals totals();
  // Where fluid particles are that may be inside walls, and may be beside an edge (penetration.hpp) [m].
  std::vector<Vec3d> below_wall_faces();
  PeakCompression largest_compression() const;  // of any particle in any step
  SolveReport last_solve() const;
  SolverTotals solver_totals() const;
  double neighbours_mean() const;  // fluid and wall particles within the support radius, itself not counted
  std::int64_t list_builds() const;
  std::size_t device_bytes() const;               // memory held on the device
  std::map<std::string, double> timings() const;  // [s] by part of the step
  DeviceCounts device_counts() const;             // what the host has asked of the device

  // The whole state, and back: a simulation made from the same setup and restored goes on to the same bits.
  // Throws Error when the state does not belong to the setup or to this build's precision.
  SavedState save() const;
  void restore(const SavedState&);

  void read(FluidSnapshot&);
  void read(FluidSnapshot&, WallSnapshot&);
  // The same without waiting: what is there now arrives while steps go on, and StateTransfer::finish() gives
  // it. With nothing under way in the transfer. A CPU build copies at once. Throws Error when memory ends.
  void start_reading(StateTransfer&, Reading);
  // Along SimulationSetup::lines[line].
  std::vector<ProfilePoint> profile(std::size_t line) const;
  // In the columns of SimulationSetup::surfaces[index].
  std::vector<LevelState> surface(std::size_t index) const;

 private:
  friend class StateTransfer;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slagflow
