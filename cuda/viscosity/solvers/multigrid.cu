#include <cmath>

#include "viscosity/solvers/multigrid.hpp"
#include "viscosity/solvers/residual.hpp"

namespace slagflow {

namespace {

constexpr Index direct_aggregates = 24;  // solved by the dense inverse
// A >= least_eigenvalue M: 0.14 to 0.18 was found in stiff blocks of 800 to 23,000 particles. Hence the
// energy of the error r.A^-1 r, which bounds m |error|^2, is at most r.M^-1 r / least_eigenvalue.
constexpr double least_eigenvalue = 0.1;
constexpr double damping = 0.9;  // A <= 2 D for pair systems, so anything below 1 converges

// Rows to aggregates: P^T r.
struct RestrictRows {
  LinearSystem system;
  RowCells rows;
  AggregateView aggregates;
  Span<const Quad> r;
  Span<double> force;
  HOST_DEVICE void operator()(Index a) const {
    const RowRange own = rows.of(aggregates.cell[a]);
    RigidMotion sum;
    for (Index i = own.first; i < own.end; ++i)
      sum += force_at(arm(system, aggregates, i, a), aggregates.grid.scale, to_double(xyz(r[i])));
    store_motion(sum, force.data + static_cast<Offset>(a) * motions);
  }
};

// z = D^-1 r + P e, and r.z.
struct ProlongToRows {
  static constexpr int terms = 1;
  LinearSystem system;
  AggregateView aggregates;
  Span<const Index> owner;
  Span<const double> motion;
  Span<const Quad> r;
  Span<Quad> z;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    const Index a = owner[i];
    const RigidMotion e = load_motion(motion.data + static_cast<Offset>(a) * motions);
    const Vec3 coarse = to_real(e.at(arm(system, aggregates, i, a), aggregates.grid.scale));
    const Quad d = system.diagonal[i];
    const Vec3 here = xyz(r[i]);
    const Vec3 value = Vec3{here.x / d.x, here.y / d.y, here.z / d.z} + coarse;
    z[i] = quad(value, 0);
    return {{dot(to_double(here), to_double(value))}};
  }
};

// Parts to aggregates: T^T r.
struct RestrictParts {
  AggregateView finer, aggregates;
  Span<const double> rest;
  Span<double> force;
  HOST_DEVICE void operator()(Index a) const {
    const AggregateGrid& fine = finer.grid;
    const Index cell = aggregates.cell[a];
    RigidMotion sum;
    for (int child = 0; child < 8; ++child) {
      const int c[3] = {2 * aggregates.grid.along(cell, 0) + (child & 1),
                        2 * aggregates.grid.along(cell, 1) + (child >> 1 & 1),
                        2 * aggregates.grid.along(cell, 2) + (child >> 2)};
      if (!fine.holds(c)) continue;
      const Index part_cell = fine.cell_at(c);
      const Index part = finer.number[part_cell];
      if (part < 0) continue;
      sum += force_of_part(load_motion(rest.data + static_cast<Offset>(part) * motions),
                           arm_of_part(fine, part_cell), aggregates.grid.scale);
    }
    store_motion(sum, force.data + static_cast<Offset>(a) * motions);
  }
};

// z += T e
struct ProlongToParts {
  AggregateView finer, aggregates;
  Span<const double> coarse;
  Span<double> motion;
  HOST_DEVICE void operator()(Index part) const {
    const Index cell = finer.cell[part];
    const Index a = aggregates.number[finer.grid.parent(cell, aggregates.grid)];
    RigidMotion own = load_motion(motion.data + static_cast<Offset>(part) * motions);
    own += motion_of_part(load_motion(coarse.data + static_cast<Offset>(a) * motions),
                          arm_of_part(finer.grid, cell), aggregates.grid.scale);
    store_motion(own, motion.data + static_cast<Offset>(part) * motions);
  }
};

// rest = force - A z, which may take the place of force, some rows of a block row each: one on a GPU, all on
// a CPU, which adds up several rows in the time of one.
struct CoarseResidual {
  static constexpr int rows = lane_count == 1 ? 1 : motions;
  CoarseView matrix;
  Span<const double> force, motion;
  Span<double> rest;
  HOST_DEVICE void operator()(Index n) const {
    const Offset first = static_cast<Offset>(n) * rows, a = first / motions;
    const int k = static_cast<int>(first % motions);
    double sum[rows];
    for (int r = 0; r < rows; ++r) sum[r] = force[first + r];
    for (int slot = 0; slot < neighbour_slots; ++slot) {
      const Index other = matrix.aggregates.neighbour[a * neighbour_slots + slot];
      if (other < 0) continue;
      const double* z = motion.data + static_cast<Offset>(other) * motions;
      const double* block = matrix.entries(static_cast<Index>(a), slot, other);
      const int down = slot < own_slot ? 1 : motions, across = slot < own_slot ? motions : 1;
      for (int l = 0; l < motions; ++l)
        for (int r = 0; r < rows; ++r) sum[r] -= block[(k + r) * down + l * across] * z[l];
    }
    for (int r = 0; r < rows; ++r) rest[first + r] = sum[r];
  }
};

enum class From { zero, motion };

// z += omega D^-1 rest, D the 6 x 6 blocks, or from zero.
struct SmoothBlocks {
  Span<const double> inverse, rest;
  From from;
  Span<double> motion;
  HOST_DEVICE void operator()(Index row) const {
    const Offset a = row / motions;
    const double* d = inverse.data + a * block_entries + static_cast<Offset>(row % motions) * motions;
    double sum = 0;
    for (int l = 0; l < motions; ++l) sum += d[l] * rest[a * motions + l];
    motion[row] = (from == From::zero ? 0 : motion[row]) + damping * sum;
  }
};

struct DenseMultiply {
  Span<const double> matrix, force;
  Span<double> motion;
  HOST_DEVICE void operator()(Index row) const {
    double sum = 0;
    for (Offset l = 0; l < force.size; ++l) sum += matrix[row * force.size + l] * force[l];
    motion[row] = sum;
  }
};

// p = z + beta p
struct NewDirection {
  Span<const Quad> z;
  Span<Quad> p;
  const SolveState* state;
  HOST_DEVICE bool idle() const { return !state->running; }
  HOST_DEVICE void operator()(Index i) const {
    const Real beta = state->beta;
    p[i] = quad(beta == 0 ? xyz(z[i]) : xyz(z[i]) + beta * xyz(p[i]), 0);
  }
};

// u += alpha p, r -= alpha A p
struct Advance {
  static constexpr int terms = 1;
  Span<const Quad> p, product;
  Span<Quad> u, r;
  SolveState* state;
  HOST_DEVICE bool idle() const { return !state->running; }
  HOST_DEVICE Terms<1> operator()(Index i) const {
    const Real alpha = state->alpha;
    u[i] = quad(xyz(u[i]) + alpha * xyz(p[i]), 0);
    const Vec3 value = xyz(r[i]) - alpha * xyz(product[i]);
    r[i] = quad(value, 0);
    return {{dot(to_double(value), to_double(value))}};
  }
};

struct JudgeResidual {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<1>& squared) const {
    state->residual = std::sqrt(squared.value[0]);
    ++state->iterations;
    if (state->residual <= state->limit) state->running = 0;  // as far as rounding shows
  }
};

// Where the diagonal alone was not enough.
struct WantLevels {
  SolveState* state;
  int most_iterations;
  HOST_DEVICE void operator()(Index) const {
    SolveState& s = *state;
    s.wants_levels = !s.converged && s.residual > s.limit && s.iterations < most_iterations ? 1 : 0;
  }
};

struct StartAgain {
  SolveState* state;
  int most_iterations;
  HOST_DEVICE void operator()(Index) const {
    state->most_iterations = most_iterations;
    state->wants_levels = 0;
    state->running = 1;
    ++state->level_starts;
  }
};

// The energy of the error is bounded by r.z.
struct JudgeEnergy {
  SolveState* state;
  double bound;
  bool first;
  HOST_DEVICE void operator()(const Terms<1>& rz) const {
    SolveState& s = *state;
    s.beta = first ? 0 : static_cast<Real>(rz.value[0] / s.rz);
    s.rz = rz.value[0];
    if (s.rz <= bound) s.converged = 1;
    s.running = !s.converged && s.iterations < s.most_iterations ? 1 : 0;
  }
};

struct Ignore {
  HOST_DEVICE void operator()(const Terms<1>&) const {}
};

// The true residual, when iterations have ended.
struct ResidualAtEnd : Residual {
  const SolveState* state;
  HOST_DEVICE bool idle() const { return state->running || state->level_starts == 0; }
};

struct JudgeEnd {
  SolveState* state;
  HOST_DEVICE void operator()(const Terms<2>& sums) const {
    SolveState& s = *state;
    s.residual = std::sqrt(sums.value[0]);
    if (s.converged) return;
    const bool no_more = s.iterations >= s.most_iterations;
    s.converged = s.residual <= (no_more ? 2 : 1) * s.limit ? 1 : 0;
  }
};

}  // namespace

Multigrid::Multigrid(Context& c) : context_(c), dense_(c), preconditioned_(c, "preconditioned residual") {}

void Multigrid::launch_start(const LinearSystem& system, const RowCells& rows, const SolveLimits& limits,
                             Problem problem) {
  SolveState* state = problem.work.state();
  launch(context_, "start again", 1, StartAgain{state, limits.max_iterations});
  precondition(system, rows, problem.work.residual.span(), preconditioned_.span(),
               JudgeEnergy{state, limits.energy * least_eigenvalue, true});
}

void Multigrid::launch_iterations(const LinearSystem& system, const RowCells& rows, const SolveLimits& limits,
                                  Problem problem) {
  constexpr int at_a_time = 2;
  const Rows n = system.size;
  SolverWorkspace& work = problem.work;
  const auto r = work.residual.span(), p = work.direction.span(), z = preconditioned_.span();
  const auto product = work.product.span();
  SolveState* state = work.state();
  for (int k = 0; k < at_a_time; ++k) {
    launch(context_, "direction", n, NewDirection{z, p, state});
    exchange_while(context_, n, &state->running, work.direction);
    launch_reduction<AddUp>(context_, "multiply", n, while_running(state, Multiply{system, p, product}),
                            JudgeDirection{state});
    launch_reduction<AddUp>(context_, "advance", n, Advance{p, product, problem.u.span(), r, state},
                            JudgeResidual{state});
    precondition(system, rows, r, z, JudgeEnergy{state, limits.energy * least_eigenvalue, false});
  }
}

void Multigrid::launch_end(const LinearSystem& system, Problem problem) {
  SolveState* state = problem.work.state();
  exchange(context_, system.size, problem.u);
  launch_reduction<AddUp>(context_, "residual", system.size,
                          ResidualAtEnd{{system, problem.u.span(), problem.work.residual.span()}, state},
                          JudgeEnd{state});
}

void Multigrid::launch_solve(const LinearSystem& system, const RowCells& rows, const SolveLimits& limits,
                             Problem problem) {
  SolveState* state = problem.work.state();
  state_ = state;
  launch(context_, "levels wanted", 1, WantLevels{state, limits.max_iterations});
  context_.repeat_while(&state->wants_levels, [&] {
    build(system, rows);
    launch_start(system, rows, limits, problem);
  });
  context_.repeat_while(&state->running, [&] { launch_iterations(system, rows, limits, problem); });
  launch_end(system, problem);
  state_ = nullptr;
}

SolveState Multigrid::solve(const LinearSystem& system, const RowCells& rows, const SolveLimits& limits,
                            SolveState now, Problem problem) {
  constexpr int most_starts = 3;
  prepare(rows, static_cast<Index>(system.place.size));
  build(system, rows);
  state_ = problem.work.state();
  while (!now.converged && now.residual > now.limit && now.iterations < limits.max_iterations &&
         now.level_starts < most_starts) {
    launch_start(system, rows, limits, problem);
    do {
      launch_iterations(system, rows, limits, problem);
      launch_end(system, problem);
      now = problem.work.read(context_).solve;
    } while (now.running);
  }
  state_ = nullptr;
  if (now.residual <= 2 * now.limit) now.converged = 1;
  return now;
}

bool Multigrid::prepared(const RowCells& rows) const {
  return rows.arrangement != 0 && rows.arrangement == arrangement_;
}

void Multigrid::prepare(const RowCells& rows, Index row_count) {
  if (prepared(rows)) return;
  Section timer(context_, "multigrid levels");
  preconditioned_.resize(row_count);
  used_ = 0;
  do {
    if (levels_.size() == used_) levels_.push_back(std::make_unique<Level>(context_));
    Level& level = *levels_[used_];
    used_ == 0 ? level.matrix.find(rows, row_count) : level.matrix.find(levels_[used_ - 1]->matrix.view());
    const Offset size = static_cast<Offset>(level.matrix.aggregates()) * motions;
    level.force.resize(size), level.motion.resize(size), level.rest.resize(size);
    ++used_;
  } while (levels_[used_ - 1]->matrix.aggregates() > direct_aggregates &&
           !levels_[used_ - 1]->matrix.single());
  dense_.resize(levels_[used_ - 1]->matrix.aggregates());
  arrangement_ = rows.arrangement;
  context_.arrange_anew();  // other numbers of launches
}

void Multigrid::build(const LinearSystem& system, const RowCells& rows) {
  Section timer(context_, "multigrid build");
  levels_.front()->matrix.assemble(system, rows);
  for (std::size_t k = 1; k < used_; ++k) levels_[k]->matrix.assemble(levels_[k - 1]->matrix.view());
  dense_.launch_inversion(levels_[used_ - 1]->matrix.view());
}

template <class Body>
void Multigrid::launch_level(const char* label, Index n, const Body& body) {
  launch(context_, label, n, while_running(state_, body));
}

void Multigrid::residual(Level& level, Span<double> rest) {
  launch_level("coarse residual", static_cast<Index>(level.force.size()) / CoarseResidual::rows,
               CoarseResidual{level.matrix.view(), level.force.span(), level.motion.span(), rest});
}

// A W cycle for A z = force, from z = 0.
void Multigrid::cycle(std::size_t number) {
  Level& level = *levels_[number];
  const auto rows = static_cast<Index>(level.force.size());
  if (coarsest(number)) {
    launch_level("coarsest solve", rows,
                 DenseMultiply{dense_.span(), level.force.span(), level.motion.span()});
    return;
  }
  Level& coarser = *levels_[number + 1];
  const AggregateView fine = level.matrix.view().aggregates, coarse = coarser.matrix.view().aggregates;
  const Span<const double> inverse = level.matrix.view().inverse;
  const auto visit_coarser = [&] {
    cycle(number + 1);
    launch_level("prolong", fine.count,
                 ProlongToParts{fine, coarse, coarser.motion.span(), level.motion.span()});
  };
  launch_level("smooth", rows, SmoothBlocks{inverse, level.force.span(), From::zero, level.motion.span()});
  residual(level, level.rest.span());
  launch_level("restrict", coarse.count,
               RestrictParts{fine, coarse, level.rest.span(), coarser.force.span()});
  visit_coarser();
  if (!coarsest(number + 1)) {
    // What is left of the forces there: T^T (r - A T e) = T^T r - (T^T A T) e.
    residual(coarser, coarser.force.span());
    visit_coarser();
  }
  residual(level, level.rest.span());
  launch_level("smooth", rows, SmoothBlocks{inverse, level.rest.span(), From::motion, level.motion.span()});
}

template <class Finish>
void Multigrid::precondition(const LinearSystem& system, const RowCells& rows, Span<const Quad> r,
                             Span<Quad> z, Finish finish) {
  Level& finest = *levels_.front();
  const AggregateView a = finest.matrix.view().aggregates;
  launch_level("restrict", a.own,
               FromAggregate<RestrictRows>{{system, rows, a, r, finest.force.span()}, a.first_own});
  if (rows.halo && (!state_ || goes_on_with(context_, &state_->running)))
    gather_own(context_, a, finest.force, motions);
  cycle(0);
  const ProlongToRows prolong{system, a, finest.matrix.owner(), finest.motion.span(), r, z};
  launch_reduction<AddUp>(context_, "prolong", system.size, while_running(state_, prolong), finish);
}

void Multigrid::precondition(const LinearSystem& system, const RowCells& rows, Span<const Quad> r,
                             Span<Quad> z) {
  precondition(system, rows, r, z, Ignore{});
}

}  // namespace slagflow
