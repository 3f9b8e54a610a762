// What a simulation holds; shared by the sources that step it and read it.
#pragma once

#include <optional>

#include "backend/launch_graph.hpp"
#include "backend/side_copy.hpp"
#include "capillarity/surface_tension.hpp"
#include "fluid/constants.hpp"
#include "heat/heat.hpp"
#include "neighbours/list_age.hpp"
#include "neighbours/neighbours.hpp"
#include "neighbours/ordering.hpp"
#include "observation/diagnostics.hpp"
#include "observation/measures.hpp"
#include "observation/penetration.hpp"
#include "observation/rectangles.hpp"
#include "observation/residence.hpp"
#include "observation/sheets.hpp"
#include "observation/wall_contact.hpp"
#include "observation/wall_forces.hpp"
#include "observation/watch.hpp"
#include "openings/inlets.hpp"
#include "pressure/density.hpp"
#include "simulation/simulation.hpp"
#include "viscosity/viscous.hpp"
#include "walls/moving_walls.hpp"

namespace slagflow {

// Which rows of all that is saved a rank has.
struct SavedRows {
  PartOfRows fluid, walls, cells;
};

struct Simulation::State {
  explicit State(const SimulationSetup& s);

  SimulationSetup setup;
  Context context;
  FlowConstants flow;
  PeriodicBox box;
  ListReach reach;
  Buffer<FluidConstants> fluids;
  FluidArrays fluid;
  WallArrays wall;
  MovingWalls walls;
  Inlets inlets;
  Ordering ordering;
  NeighbourList fluid_list, wall_list, wall_to_fluid;
  ListAge list_age;
  WallForces wall_forces;
  SurfaceTension surface_tension;
  Buffer<Quad> list_places;  // of the fluid when all lists were built
  double list_time = 0;      // [s], of those places
  double lists_worn = 0;     // above 0: they do not hold and are to be built anew
  Buffer<Real> scratch;
  ViscousStep::Step solve_step{};  // of the solve under way
  std::optional<StepRecord> last;  // of the last step, when it tells how far the particles have moved
  ViscousStep viscous;
  Heat heat;
  DiagnosticScratch diagnostics;
  Watch watch;
  PlaneCounters planes;
  FluxCounters rectangles;
  WallContact contact;
  Residence residence;
  BelowFaces below_faces;
  SheetThickness sheets;

  double time = 0, dt = 0, full_dt = 0, displacement = 0, capillary_work = 0;
  double last_dt = 0;  // [s] that the last step took; 0 before the first
  // Once the flow is over, what stands in place of `time` and `dt` as others see them.
  double heat_time = 0, heat_dt = 0;
  double taken = 0;  // [J] by viscous forces from the fluid: what they dissipate less the work of walls
  double given = 0;  // [J] to the fluid by pairing and the pressure of walls
  std::int64_t steps = 0, builds = 0;
  std::uint64_t arrangement = 0;  // of the rows in the cells: another one for each build of the lists
  PeakCompression largest_compression;
  double start_mass = 0;
  Index start_count = 0;  // more than any id of the start
  DepartureCounts departed;
  SolveReport report;
  SolverTotals solver;
  LaunchGraph step_graph;
  Buffer<std::uint8_t> yielded;  // for snapshots
  SideStream side_stream;
  StateTransfer own_transfer;

  void take_stock();
  void deal_out();
  void upload_fluid();
  void upload_walls();
  void sort_walls();
  std::vector<Index> own_walls() const;  // ids
  void rebuild();
  double largest_wall_displacement() const {
    return larger(walls.largest_displacement(list_time, time), inlets.largest_displacement(list_time, time));
  }
  void place_walls();
  bool feed();
  void enter_heat(Index before, const FedParticles&);
  double longest_step() const { return smaller(stable_time_step(setup), heat.longest_step()); }
  void add_friction();
  Index next_id() const { return start_count + static_cast<Index>(inlets.all_fed()); }
  double fed_mass() const;
  void tell_openings(Totals&) const;
  void tell_passed(Totals&) const;
  std::array<NeighbourList*, 3> lists();
  std::array<ListedParticles, 3> listed() const;  // what each of them is made of
  void build_lists();
  SourceView moving_wall_sources() const;
  ListAge::Particles fluid_for_age() const;
  ListAge::Particles walls_for_age() const;
  void renew_lists(const ListGate&);
  void follow_moving_walls();
  std::array<std::vector<std::uint8_t>, 3> list_bits;  // of each list, while a state is saved or restored
  NeighbourList::Doubtful doubtful(const ListedParticles&) const;
  SavedRows saved_rows(Index fluid_rows) const;
  void meet_neighbours(const Borders&);
  void remember_lists();
  void restore_walls();
  void rebuild_lists_as_saved();
  bool exact_yield() const { return setup.numerics.yield == YieldModel::exact; }
  bool lists_hold() const;
  PairContext pairs() const;
  double kick();
  double now() const { return larger(time, heat_time); }
  bool flow_is_over() const;
  double flow_end() const;
  void cool();
  void choose_time_step();
  double step_across(double fluid_speed) const;
  double time_after_step() const;
  double velocity_step() const;
  ViscousStep::Step viscous_step();
  void reserve_step();
  double levels_recorded() const;
  void launch_step();
  RowCells row_cells() const;
  SolveResult finish_solve(const StepRecord&);
  void launch_move();
  StepRecord solve_and_move();
  void solve(const StepRecord&);
  [[noreturn]] void give_up(const SolveResult&);
  bool ended_at_yield_iterations(const SolveResult&) const;
  bool knows_wall_forces() const;
  void add_wall_forces();
  void shift();
  void gather(GatheredSums&, Totals&);
  ProfileSource profile_source() const;
  std::vector<ProfilePoint> profile(const LineSetup&);
  void look();
  void check_finite();
  void check_departure() const;
  void measure_stress(Span<Real> result);  // [Pa] of each particle
};

}  // namespace slagflow
