// Heat of the fluid: conduction, what surfaces and walls take, and what temperature makes of the rheology.
#pragma once

#include <vector>

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/setup.hpp"
#include "fluid/solve_state.hpp"
#include "heat/heat_params.hpp"
#include "viscosity/pair_weights.hpp"

namespace slagflow {

// (H11): the longest stable step of explicit conduction [s], infinite where heat is off:
//   dt <= min(0.25 rho c dx^2/k, 0.5 rho c dx/(h + 4 eps sigma T^3)).
double conduction_time_step(const SimulationSetup&);

// [s] of a step of heat alone, so long after the first of them: as long as is stable, the first ones shorter,
// since what meets hot fluid takes heat as the root of time at first.
inline double cooling_time_step(double longest, double elapsed) {
  constexpr double growth = 0.1;
  return smaller(longest, growth * (growth * longest + elapsed));
}

class Heat {
 public:
  explicit Heat(Context&);

  // Before the fluid is sorted and the walls forget where their faces are. The fluid takes its temperatures,
  // or the enthalpies that it remembers [J/kg].
  void start(const SimulationSetup&, const std::vector<double>& remembered, FluidArrays&);
  bool any() const { return on_; }

  double longest_step() const { return longest_step_; }
  // Conduction is due when it is `asked` for, or when the step after this one would end more than a tenth of
  // longest_step() after the last time. It is taken to the end of the step.
  bool due(double step_end, double dt, bool asked) const;
  // (H3), (H4), (H5), (H7) since the last time, of the particles as the pairs see them.
  void conduct(const PairContext&, const ListView& wall_to_fluid, double step_end, FluidArrays&);
  // The same to second order in the step: the mean of where it began and where two such steps lead
  // (SSPRK(2,2), Shu and Osher, J. Comput. Phys. 77 (1988) 439). Stable, monotone and exact in its sums as
  // one of them is.
  void conduct_twice(const PairContext&, const ListView& wall_to_fluid, double step_end, FluidArrays&);

  // Particles from `first` on have come in at these temperatures [K].
  void enter(Index first, const std::vector<std::uint8_t>& kinds, const std::vector<double>& temperatures,
             FluidArrays&);
  // What of the heat is in the fluid; `note_left` takes the difference for what left since `content` was.
  double content(const FluidArrays&, Span<const FluidConstants>, DiagnosticScratch&) const;
  void note_left(double before, double after) { left_ += before - after; }

  // (H8) of an accepted step. `weight`: w_ij of each entry of the fluid list, times the step.
  struct Friction {
    PairWeights weight;
    Span<const Quad> predicted, solved;
    const SolveState* solve;
    Real implicit_dt;             // [s]
    Span<const double> by_yield;  // [J] of each particle, of an exact yield stress besides; may be empty
  };
  // Memory for it, which what is recorded may not take.
  void reserve(Index count);
  void launch_friction(const PairContext&, const Friction&, FluidArrays&);

  void balance(const FluidArrays&, Span<const FluidConstants>, GatheredSums&, HeatBalance&) const;
  // Throws Error where fluid is colder or hotter than anything that is liquid or solid.
  void require_possible(const FluidArrays&, double time, DiagnosticScratch&) const;
  // [K] of each wall particle by id, that of its site; not-a-number where no heat passes.
  std::vector<float> wall_temperatures() const;
  double reference() const { return reference_; }
  Materials materials() const { return {rows_.span(), first_row_.span(), solid_from_.span()}; }
  double enthalpy_at(std::size_t fluid, double temperature) const;  // [J/kg]

  template <class Visitor>
  void save(Visitor& v) {
    if (!on_) return;
    v.number(last_time_), v.number(start_), v.number(fed_), v.number(left_);
    v.as_many("site_temperature", site_temperature_), v.as_many("site_taken", site_taken_);
    v.as_many("heat_sums", sums_);
  }

 private:
  void extremes(const FluidArrays&, GatheredSums&, double& coolest, double& hottest) const;  // [K]
  void upload_materials(const SimulationSetup&);
  void upload_bodies(const SimulationSetup&);
  void update(FluidArrays&, Index first);
  void launch_update(FluidArrays&, const SolveState*);
  SiteView sites() const;

  Context& context_;
  bool on_ = false, friction_ = false;
  HeatConstants constants_;
  double reference_ = 0, longest_step_ = 1e300, last_time_ = 0;
  double start_ = 0, fed_ = 0, left_ = 0;
  std::vector<std::vector<MaterialRow>> tables_;  // of each fluid
  std::vector<double> masses_;                    // [kg] of a particle of each fluid
  std::vector<std::uint8_t> site_bodies_;
  std::size_t bodies_count_ = 0;
  Buffer<MaterialRow> rows_;
  Buffer<Index> first_row_;
  Buffer<Real> solid_from_, emissivity_;
  Buffer<WallHeatConstants> bodies_;
  Buffer<Index> site_of_wall_, first_member_, member_, wall_at_;
  Buffer<std::uint8_t> site_body_;
  Buffer<Real> site_area_, site_temperature_, site_share_;
  Buffer<double> site_taken_;  // [J]
  Buffer<double> lost_;        // [J] of each particle by its surface, or gained by friction, in one go
  Buffer<double> entered_;     // [J/kg]
  // Enthalpies, and what sites and sums hold, before a step in two.
  Buffer<double> enthalpy_before_, taken_before_, sums_before_;
  Buffer<Quad> directions_;  // unit vectors
  Buffer<double> sums_;      // [J] surface, friction
};

}  // namespace slagflow
