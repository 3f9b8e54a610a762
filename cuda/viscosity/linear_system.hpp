// The linear system of the implicit viscous step, as the solvers see it: no smoothing functions, no rheology.
//   (A u)_i = m_i u_i + B_i u_i + sum_j w_ij d_ij (d_ij . (u_i - u_j))  or, isotropic, w_ij |d_ij|^2 (u_i -
//   u_j)
// with w_ij = w_ji >= 0 and d_ij = -d_ji, hence A symmetric and positive definite: A >= m. Of a pair only the
// weight is stored; d_ij comes from places, which a processor's cache has at hand.
#pragma once

#include <type_traits>

#include "backend/buffer.hpp"
#include "backend/rows.hpp"
#include "fluid/lane_math.hpp"
#include "neighbours/cells.hpp"
#include "neighbours/neighbours.hpp"
#include "viscosity/pair_weights.hpp"

namespace slagflow {

// What turns as a rigid body moves along chords x' = x + u dt, which keep |x_ij| where x_ij.u_ij + dt
// u_ij^2/2 is nought. In the second term the velocities of the last step serve: a plug left them rigid.
// Forces along x_ij keep the angular momentum.
struct Chords {
  Span<const Quad> velocity;  // xyz: of the last step [m/s]
  Real turn = 0;              // [s] half of the way, of the share that is implicit
  HOST_DEVICE Lanes added(LaneVec3 slip) const { return turn * dot(slip, slip); }
};

struct LinearSystem {
  Rows size;
  ListView links;                    // the particles that row i may be linked to
  PairWeights weight;                // w_ij [kg/m^2] of each entry of `links`; 0 beyond the end of a row
  Span<const Quad> place;            // xyz: [m] whose differences are d_ij
  Span<const Quad> diagonal;         // xyz: diagonal of A [kg], w: mass [kg]
  Span<const Symmetric3> wall;       // B_i [kg]
  Span<const Quad> right_hand_side;  // [kg m/s]
  PeriodicBox box;
  PairCoupling coupling = PairCoupling::radial;

  // Calls use(links, coupling) with links of the box, or of an open one, and, in lanes, of one kind of
  // weights, and the coupling as a constant: what `use` calls is compiled, and inlined, for each. (On a GPU
  // it costs registers.)
  template <class Use>
  HOST_DEVICE_INLINED void as_one_of(Use use) const {
    box.any() ? with_weights(box, use) : with_weights(OpenBox{}, use);
  }
  template <class Box, class Weights>
  struct Links {
    Box box;
    Weights weight;
  };

  // Calls visit(j, w_ij, d_ij) for the links of row i, a register of them at a time; j: their numbers.
  template <class Box, class Weights, class Visit>
  HOST_DEVICE_INLINED void for_links(const Links<Box, Weights>& space, Index i, Visit visit) const {
    const LaneVec3 centre = in_lanes(xyz(place[i]));
    const ListRow row = links.entries(i);
    const Index n = links.length[i];
    for (Index k = 0; k < n; k += lane_count) {
      const Lanes w = space.weight.load(row.at(k));
      const Entries j = row[k];
      space.weight.foresee(row.at(k)), row.foresee(k);
      visit(j, w, space.box.separation(centre, xyz(gather(place, j))));
    }
  }

  // (A u)_i
  HOST_DEVICE Vec3 apply(Index i, Span<const Quad> u) const {
    const Vec3 here = xyz(u[i]);
    const LaneVec3 centre = in_lanes(here);
    LaneVec3 sum;
    as_one_of([&](const auto& space, auto how) {
      for_links(space, i, [&](const Entries& j, Lanes w, LaneVec3 d) {
        sum += couple(how, w, d, centre - xyz(gather(u, j)));
      });
    });
    return on_diagonal(i, here) + total(sum);
  }

  // sum_j w_ij d_ij turn v_ij^2, which distances kept along chords add to A u: d_ij.u_ij + turn v_ij^2 in
  // place of d_ij.u_ij, v the velocities of the last step and 2 turn the way [s].
  HOST_DEVICE Vec3 along_chords(Index i, const Chords& chords) const {
    if (!(chords.turn > 0)) return {};
    const LaneVec3 centre = in_lanes(xyz(chords.velocity[i]));
    LaneVec3 sum;
    as_one_of([&](const auto& space, auto) {
      for_links(space, i, [&](const Entries& j, Lanes w, LaneVec3 d) {
        sum += (w * chords.added(centre - xyz(gather(chords.velocity, j)))) * d;
      });
    });
    return total(sum);
  }

  // (A u)_i and (A v)_i in one pass over the links, what chords add to u included.
  struct Two {
    Vec3 u, v;
  };
  HOST_DEVICE Two apply(Index i, Span<const Quad> u, Span<const Quad> v, const Chords& chords) const {
    const LaneVec3 last = in_lanes(xyz(chords.velocity[i]));
    const LaneVec3 here_u = in_lanes(xyz(u[i])), here_v = in_lanes(xyz(v[i]));
    LaneVec3 sum_u, sum_v;
    as_one_of([&](const auto& space, auto how) {
      for_links(space, i, [&](const Entries& j, Lanes w, LaneVec3 d) {
        sum_u += couple(how, w, d, here_u - xyz(gather(u, j)));
        if (chords.turn > 0) sum_u += (w * chords.added(last - xyz(gather(chords.velocity, j)))) * d;
        sum_v += couple(how, w, d, here_v - xyz(gather(v, j)));
      });
    });
    return {on_diagonal(i, xyz(u[i])) + total(sum_u), on_diagonal(i, xyz(v[i])) + total(sum_v)};
  }

 private:
  template <PairCoupling coupling>
  using Constant = std::integral_constant<PairCoupling, coupling>;

  template <class Box, class Use>
  HOST_DEVICE_INLINED void with_weights(const Box& space, Use use) const {
    if constexpr (lane_count == 1)
      use(Links<Box, PairWeights>{space, weight}, coupling);
    else if (weight.brief.data)
      with_coupling(Links<Box, BriefWeights>{space, {weight.brief.data, weight.unit}}, use);
    else
      with_coupling(Links<Box, FullWeights>{space, {weight.full.data}}, use);
  }
  template <class Space, class Use>
  HOST_DEVICE_INLINED void with_coupling(const Space& space, Use use) const {
    if (coupling == PairCoupling::radial)
      use(space, Constant<PairCoupling::radial>());
    else
      use(space, Constant<PairCoupling::isotropic>());
  }
  HOST_DEVICE Vec3 on_diagonal(Index i, Vec3 here) const { return diagonal[i].w * here + wall[i] * here; }
};

// What a stationary solver needs of row i: b - A u and the 3x3 diagonal block of A. The point diagonal would
// not do: the outer product of an oblique link is up to three times as large as its diagonal.
struct RelaxationRow {
  Vec3 residual;
  Symmetric3 block;

  HOST_DEVICE RelaxationRow(const LinearSystem& system, Index i, Span<const Quad> u) : block(system.wall[i]) {
    const Vec3 here = xyz(u[i]);
    const LaneVec3 centre = in_lanes(here);
    const Real mass = system.diagonal[i].w;
    LaneVec3 sum;
    SymmetricMatrix3<Lanes> links;
    system.as_one_of([&](const auto& space, auto how) {
      system.for_links(space, i, [&](const Entries& j, Lanes w, LaneVec3 d) {
        sum += couple(how, w, d, centre - xyz(gather(u, j)));
        add_coupling(how, w, d, links);
      });
    });
    residual = xyz(system.right_hand_side[i]) - mass * here - block * here - total(sum);
    block += total(links);
    block.add_diagonal(mass);
  }
};

// Rows in the order of cells, for solvers that need independent sets of rows or groups of neighbours: when
// the cells are found rows of two cells that do not touch are not linked, later few are.
struct RowCells {
  CellGrid grid;
  Span<const Index> cell_start;
  std::uint64_t arrangement = 0;  // the same only while the cells hold the same rows; 0: never
  const Halo* halo = nullptr;     // where other ranks have the rows of other planes

  // Of a cell of the whole grid; none where the rank has no copies of them.
  HOST_DEVICE RowRange of(Index cell) const {
    const Index stride = grid.cells_of_plane(), plane = cell / stride, local = grid.local_plane(plane);
    if (local < 0) return {0, 0};
    const Index at = cell + (local - plane) * stride;
    return {cell_start[at], cell_start[at + 1]};
  }
};

struct SolveLimits {
  double residual = 0;  // stop when ||b - A u|| is at most this [kg m/s]
  double energy = 0;    // or when an upper bound of the error's r.A^-1 r is at most this [kg m^2/s^2]
  int max_iterations = 200;
  double relaxation = 1.2;    // of SOR
  double start_residual = 0;  // ||b - A u|| of the first guess
};

struct SolveResult {
  int iterations = 0;
  double residual = 0;         // ||b - A u|| at the end, evaluated from u
  double right_hand_side = 0;  // ||b||
  bool converged = false;
  int yield_iterations = 0;  // of an exact yield stress (exact_yield.hpp)
};

}  // namespace slagflow
