// The implicit viscous step: owns the linear system and its solution.
//   m u_i + theta dt K u = m u*_i - (1 - theta) dt K v,  K the pair operator (predictor.hpp), v the old
//   velocity
// or, as the paper prints it, u*
// Weights and directions of K are those of the start of the step; what turns as a rigid body is not held back
// (Chords in linear_system.hpp).
#pragma once

#include "fluid/setup.hpp"
#include "viscosity/exact_yield.hpp"
#include "viscosity/predictor.hpp"
#include "viscosity/solvers/multigrid.hpp"
#include "viscosity/solvers/solver.hpp"

namespace slagflow {

struct AddAndGuess;

class ViscousStep {
 public:
  ViscousStep(Context&, const NumericsSetup&);

  // Predictor, assembly and solve. `kick`: velocity scale of the stop test [m/s] (one gravity kick g dt, or
  // what stands for it); `mass`: the smallest particle mass [kg]; `way`: how long the particles then move
  // with the velocities [s]. Returns with velocity() = u^{k+1}; fluid.increment is read as the first guess
  // and set to that of the next step: what this one added and half of how that has changed. (All of the
  // change makes noise grow.)
  struct Step {
    double dt, kick, mass;
    double way = 0;
  };
  SolveResult advance(const PairContext&, const RowCells&, const Step&, Offset pair_capacity, FluidArrays&);

  // The same in parts. reserve() takes the memory (but that of an exact yield stress), and finds the
  // aggregates of multigrid where the device is to go on with it by itself. begin()
  // waits for nothing; what comes behind it and is idle
  // unless the solve has converged may be launched at once. finish() is told what read() gave, and when that
  // had not converged, goes on until it has: then what was idle is to be launched again. post() is the first
  // part of a read(), which is read_posted() then.
  void reserve(Index count, Offset pair_capacity, const RowCells&);
  void begin(const PairContext&, const RowCells&, const Step&, FluidArrays&);
  // Whether begin() goes on with multigrid on the device, whose levels are those of these rows alone.
  bool goes_on_with_levels(const RowCells& rows) const { return device_loop() && multigrid_.prepared(rows); }
  StepRecord read() { return work_.read(context_); }
  void post() { work_.post(context_); }
  StepRecord read_posted() { return work_.read_posted(context_); }
  SolveResult finish(const StepRecord& now, const PairContext&, const RowCells&, const Step&, FluidArrays&);
  StepRecord* record() { return work_.record.span().data; }
  // Leaves in the record what the viscous forces of the step take from the fluid as it moves by u dt,
  // -sum m (u - u*).(u + v)/2, which is what they dissipate less the work of moving walls, and what pairing
  // and walls give it [J]. Before the particles move.
  void launch_energy(const FluidArrays&);

  // Keeps the weights of pairs in 16 bits, of this unit [kg/m^2].
  void shorten_weights(double unit) { unit_ = unit; }

  // Sets the first guess to nothing.
  void forget(FluidArrays&);

  template <class Visitor>
  void save(Visitor& v) {
    if (exact_yield_stress()) yield_.save(v);
  }

  ExactYield& exact_yield() { return yield_; }
  Span<const Quad> velocity() const { return velocity_.span(); }
  // Of the copies of other ranks' particles: before a step, and once it is solved.
  void poison_halos(FluidArrays& fluid) {
    poison(context_, fluid.count, predicted_, velocity_, work_.direction, work_.residual, fluid.increment,
           fluid.last_increment);
  }
  void exchange_velocity(const Rows& rows) { exchange(context_, rows, velocity_); }
  // Of the step: u*, and w_ij of each entry of the fluid list [kg].
  Span<const Quad> predicted() const { return predicted_.span(); }
  PairWeights weights() const;
  // The share of the viscous forces that velocity() gives, theta or 0; and what gives the rest, until the
  // fluid moves on.
  double implicit_share() const;
  Span<const Quad> explicit_velocity(const FluidArrays&) const;
  // The pairs with the directions and viscosities that the step took, and its stresses on walls besides.
  PairContext as_solved(const PairContext&) const;
  WallYield wall_yield() const;
  // What an exact yield stress took of the motion of each particle [J]; empty without one. Of pairs
  // as_solved().
  Span<const double> yield_work(const PairContext&, const Step&);

 private:
  bool exact_yield_stress() const { return numerics_.yield == YieldModel::exact; }
  bool device_loop() const { return numerics_.solver_loop == SolverLoop::conditional; }
  bool is_explicit() const { return numerics_.viscous_step == ViscousStepping::explicit_step; }
  // theta of the matrix, which an explicit step takes whole.
  double assembled_share() const { return is_explicit() ? 1 : numerics_.theta; }
  LinearSystem system(const PairContext&) const;
  double wanted_residual(const Step&, Index count) const;
  Chords chords(const Step&, const FluidArrays&) const;
  void assemble(const PairContext&, const Step&, FluidArrays&);
  int most_by_diagonal(int patience) const;
  void begin_solve(const LinearSystem&, const RowCells&, const Step&, FluidArrays&);
  SolveResult go_on(const LinearSystem&, const RowCells&, const SolveState& now, double energy,
                    Buffer<Quad>& increment);
  SolveResult by_multigrid(const LinearSystem&, const RowCells&, const SolveLimits&, const SolveState& begun,
                           Buffer<Quad>& increment);
  void add_increment(const Buffer<Quad>& increment);
  AddAndGuess end_solve(FluidArrays&);
  Augmentation augmentation(const PairContext&, const Step&, double largest_factor) const;
  SolveResult solve_exact(const LinearSystem&, const PairContext&, const RowCells&, const Step&,
                          FluidArrays&);
  // Of the iteration with an exact yield stress.
  struct ExactProgress {
    double allowed = 0;   // velocity error [m/s]
    double scale = 0;     // [kg] of its residual
    double rounding = 0;  // of the strain rates, as a velocity error [m/s]
    int iterations = 0;
    bool rates_agree = false, settled = false;
  };
  void start_exact(const LinearSystem&, const Chords&);
  SolveState start_inner(const LinearSystem&, const PairContext&, const Step&, const ExactProgress&,
                         Buffer<Quad>& increment);
  void judge(const ExactYield::Misfit&, double speed, ExactProgress&) const;

  Context& context_;
  NumericsSetup numerics_;
  Buffer<Quad> given_, base_, predicted_, velocity_, diagonal_, right_hand_side_;
  Buffer<Symmetric3> wall_;
  Buffer<Real> weight_;
  Buffer<ShortWeight> short_weight_;  // in its place
  double unit_ = 0;                   // [kg/m^2] of them; 0: none
  SolverWorkspace work_;
  Multigrid multigrid_;
  bool needs_levels_ = false;  // whether the last solve went on with multigrid
  ExactYield yield_;
};

}  // namespace slagflow
