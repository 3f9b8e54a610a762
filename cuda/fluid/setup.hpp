// Everything a simulation starts from, in plain host data: what the host layer fills in and hands over.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fluid/material.hpp"
#include "fluid/math.hpp"
#include "fluid/models.hpp"
#include "fluid/motion.hpp"
#include "fluid/openings.hpp"
#include "fluid/smoothing/smoothing.hpp"
#include "fluid/thermal.hpp"

namespace slagflow {

struct FluidSetup {
  std::string name;
  double rest_density = 0;  // [kg/m^3]
  Rheology rheology;
  double surface_tension = 0;  // [N/m]
  MaterialSetup material{};    // where heat is on
};

// What fluid remembers that comes from the state of another simulation; see particles.hpp. One entry per
// particle in each array, or none: then it rests on its lattice under its pressure.
struct FluidMemory {
  std::vector<Real> excess;       // [kg/m^3] density less that at rest
  std::vector<Real> hollow;       // [kg/m^3]
  std::vector<Real> packing;      // density at its first start over that at rest
  std::vector<Vec3> by_pressure;  // [N/m^3]
  std::vector<Index> id;          // ascending
  std::vector<double> enthalpy;   // [J/kg], where heat is on and was on there; or empty
};

// One entry per fluid particle in each array.
struct FluidParticles {
  std::vector<Vec3d> position;        // [m]
  std::vector<Vec3d> velocity;        // [m/s]
  std::vector<double> pressure;       // [Pa], sets the initial density through the equation of state
  std::vector<std::uint8_t> fluid;    // index into SimulationSetup::fluids
  FluidMemory memory{};               // its density goes before the pressure
  std::vector<double> temperature{};  // [K]; empty where heat is off
};

// Wall ('dummy') particles behind the surface. One entry per wall particle in each array.
struct WallParticles {
  std::vector<Vec3d> position;     // [m]
  std::vector<Vec3d> normal;       // unit vector from the wall into the open
  std::vector<double> depth;       // [m] > 0, distance below the surface along the normal
  std::vector<std::uint8_t> body;  // index into SimulationSetup::bodies
  // In a plate thinner than its particle layers: the opposite face. Depth 0: none. May be left empty.
  std::vector<Vec3d> back_normal;
  std::vector<double> back_depth;  // [m]
};

enum class WallSlip { no_slip, free_slip, partial_slip };

// A rigid velocity field: velocity + angular_velocity x (position - center).
struct RigidVelocity {
  Vec3d velocity;          // [m/s]
  Vec3d angular_velocity;  // [rad/s]
  Vec3d center;            // [m]

  Vec3d at(Vec3d position) const { return velocity + cross(angular_velocity, position - center); }
  bool zero() const { return norm(velocity) == 0 && norm(angular_velocity) == 0; }
};

struct WallBody {
  std::string name;
  WallSlip slip = WallSlip::no_slip;
  double slip_length = 0;     // [m], of partial slip
  double contact_angle = 90;  // [degrees], within a fluid with surface tension
  double tension_limit = -1;  // [Pa], of its pairs with fluid, up to the numerics'; < 0: wall_tension_limit()
  // Of the material, along the surface; the shape stays where it is, as in belts and turning cylinders.
  RigidVelocity surface{};
  WallMotion motion{};
  WallThermal thermal{};
};

enum class Departure { remove, stop };  // what happens to a particle that leaves through a face

struct DomainSetup {
  Vec3d lower, upper;  // [m]
  std::array<bool, 3> periodic{false, false, false};
  Departure departure = Departure::remove;
};

// radial: pair forces along the line between the particles, div(2 eta D); keeps angular momentum.
// laplacian: div(eta grad v), as the paper's equation (2) is usually discretised; resists rigid rotation.
enum class ViscousOperator { radial, laplacian };

// explicit_step: v = u* - dt K v / m, with the time step of equation (5); implicit_step: equation (7).
enum class ViscousStepping { implicit_step, explicit_step };

// On what the explicit part of Crank-Nicolson acts: the old velocity, or u* as equation (7) is printed, which
// puts an error f dt/2 into the steady state.
enum class ExplicitPart { old_velocity, predicted };

// regularised: a yield stress is a high viscosity at low shear rates. exact: unyielded fluid is rigid
// (exact_yield.hpp); implicit backward Euler steps with the radial operator only.
enum class YieldModel { regularised, exact };

enum class ViscousSolver { multigrid, conjugate_gradient, sor, jacobi };

// Who repeats the iterations of multigrid and conjugate_gradient until they have converged: the host, which
// looks after each batch, or the device.
enum class SolverLoop { batch, conditional };

// How the weights of viscous pairs are stored (pair_weights.hpp).
enum class StoredWeights { brief, full };

// What fluid bears below zero pressure. viscous: what its own viscous stress can ask for; what expands beyond
// that is void. limit: the same everywhere, walls too, and the density goes on falling: for fluid without a
// free surface, where no void can be.
enum class TensionModel { viscous, limit };

struct NumericsSetup {
  SmoothingKind kernel = SmoothingKind::level;
  ViscousWeight viscous_weight = ViscousWeight::lattice;
  double sound_speed = 0;          // [m/s]
  double courant = 0.8;            // dt <= courant (h/2) / sound_speed
  double max_time_step = 0;        // [s], 0: no further limit
  double density_diffusion = 0.1;  // delta of Fourtakas et al. 2019
  TensionModel tension = TensionModel::viscous;
  double tension_limit = 1e5;       // [Pa] >= 0, the most that fluid bears: that of the air's pressure
  double anti_pairing = -1;         // epsilon of the term that keeps pairs apart, < 0: anti_pairing(setup)
  double background_pressure = -1;  // [Pa], in the start pressures already; < 0: not known yet
  double shifting = -1;             // A of the particle shifting (shifting.hpp), <= 0: none
  double viscosity_correction = 0;  // 0: from the kernel and the lattice (lattice_viscosity.hpp)
  ViscousStepping viscous_step = ViscousStepping::implicit_step;
  double diffusion_number = 0.1;  // d_i of equation (5), of the explicit step
  YieldModel yield = YieldModel::regularised;
  int yield_iterations = 200;     // of the exact yield stress, most in a step
  double yield_augmentation = 0;  // in rho spacing^2 / dt, its speed of convergence only; 0: adapted
  ViscousOperator viscous_operator = ViscousOperator::radial;
  ExplicitPart explicit_part = ExplicitPart::old_velocity;
  double theta = 1;    // 1 backward Euler, 0.5 Crank-Nicolson
  double skin = 0.06;  // of the neighbour list, in support radii
  ViscousSolver solver = ViscousSolver::multigrid;
  SolverLoop solver_loop = SolverLoop::batch;
  StoredWeights weights = StoredWeights::brief;
  double tolerance = 1e-2;  // rms velocity error of the solve, in gravity kicks g dt
  int max_iterations = 200;
  double relaxation = 1.2;  // omega of SOR
};

// A fluid this many times faster than sound has run away.
constexpr double runaway_mach = 3;

// When a run stops because its state cannot be true any more.
struct LimitSetup {
  int interval = 10;                  // steps between looks
  double max_speed = 0;               // [m/s], 0: runaway_mach times the sound speed
  double max_compression = 0.3;       // (rho - rho0)/rho0; a flat blow at a tenth of the sound speed has 0.22
  double max_lost_fraction = 1;       // of the particles, through all faces of the domain
  double min_time_step_ratio = 1e-3;  // of the acoustic time step
  double max_energy_growth = 0.05;    // of kinetic and dissipated energy and the weight of one spacing
};

// A count of the fluid beyond a plane: how much has passed, where its front is.
// value = axis component of position, sign +1: beyond means larger, -1: smaller.
struct FrontSetup {
  int axis = 2;
  int sign = -1;
  double position = 0;  // [m]
};

// A box whose volume of fluid is measured.
struct BoxSetup {
  Vec3d lower, upper;  // [m]
};

// A box in which particles are counted whose solid fraction is not below this.
struct SolidSetup {
  BoxSetup box;
  double fraction = 0.5;
};

// A line along which the fluid is measured.
struct LineSetup {
  Vec3d start, end;  // [m]
  int points = 2;    // >= 2, evenly spaced, both ends included

  Vec3d at(int k) const { return start + (end - start) * (k / (points - 1.0)); }
};

// A rectangle whose two sides particles go through, counted one by one.
struct RectangleSetup {
  Vec3d center, normal, u, v;     // [m]; unit vectors square to each other
  double half_u = 0, half_v = 0;  // [m] along u and v
};

// Columns of points in which the free surface is looked for.
struct SurfaceSetup {
  std::vector<LineSetup> columns;
};

struct SimulationSetup {
  int dimensions = 3;          // 2: a single layer in the x-z plane, y is ignored
  double spacing = 0;          // [m]
  double support_ratio = 2.6;  // support radius / spacing
  Vec3d gravity{0, 0, -9.81};  // [m/s^2]
  Vec3d body_acceleration{};   // [m/s^2], added to gravity but without hydrostatic pressure
  std::vector<FluidSetup> fluids;
  FluidParticles particles;
  WallParticles walls;
  std::vector<WallBody> bodies;
  std::vector<InletSetup> inlets;  // their wall particles are the last of the walls
  std::vector<OutletSetup> outlets;
  DomainSetup domain;
  NumericsSetup numerics;
  LimitSetup limits;
  ThermalSetup thermal;
  double start_time = 0;  // [s] of the clock by which walls move
  double last_step = 0;   // [s] that the step before the start took: velocities are half of it behind
  // [s], 0: none. The steps before it are cut so that one ends there; going on beyond it is allowed.
  double end_time = 0;
  std::vector<FrontSetup> fronts;
  std::vector<FrontSetup> planes;  // through which the flow is measured, along their sign
  std::vector<BoxSetup> boxes;
  std::vector<SolidSetup> solids;
  std::vector<LineSetup> lines;
  std::vector<LineSetup> levels;  // on which the surface is looked for
  std::vector<RectangleSetup> rectangles;
  std::vector<SurfaceSetup> surfaces;
  std::vector<std::size_t> contacts;    // bodies whose contact with fluid is measured
  std::vector<double> site_area;        // [m^2] of each wall particle's share of such a surface, and of those
                                        // of walls that heat passes; or empty
  std::vector<std::size_t> residences;  // outlets at which the ages of particles are measured
  bool measure_walls = false;           // the forces on walls; they are known without it where walls move
  bool time_parts = false;  // times each part of a step: a CUDA build launches it kernel by kernel
};

}  // namespace slagflow
