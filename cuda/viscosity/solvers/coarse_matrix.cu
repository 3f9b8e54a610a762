#include "backend/launch.hpp"
#include "viscosity/solvers/coarse_matrix.hpp"

namespace slagflow {

namespace {

HOST_DEVICE inline double* kept_block(Span<double> block, Index i, int slot) {
  return block.data + (static_cast<Offset>(i) * kept_slots + slot - own_slot) * block_entries;
}

HOST_DEVICE inline void clear_blocks(Span<double> block, Index i) {
  for (int k = 0; k < kept_slots * block_entries; ++k) kept_block(block, i, own_slot)[k] = 0;
}

struct FindOwners {
  RowCells rows;
  Span<const Index> cell;
  Span<Index> owner;
  HOST_DEVICE void operator()(Index a) const {
    const RowRange own = rows.of(cell[a]);
    for (Index i = own.first; i < own.end; ++i) owner[i] = a;
  }
};

// Of a particle about its own centre, in m scale^2: without it the turning of a lone particle, or of a line
// of particles about itself, would be no motion at all, and the matrix singular.
constexpr double particle_inertia = 0.01;

// The sum of w d d^T, or of w |d|^2 I, over links.
struct LinkSum {
  double xx, yy, zz, xy, xz, yz;

  HOST_DEVICE void add(PairCoupling coupling, double w, Vec3d d) {
    if (coupling == PairCoupling::isotropic) {
      const double weight = w * dot(d, d);
      xx += weight, yy += weight, zz += weight;
      return;
    }
    const Vec3d s = w * d;
    xx += s.x * d.x, yy += s.y * d.y, zz += s.z * d.z;
    xy += s.x * d.y, xz += s.x * d.z, yz += s.y * d.z;
  }
  HOST_DEVICE void add(const LinkSum& b) {
    xx += b.xx, yy += b.yy, zz += b.zz, xy += b.xy, xz += b.xz, yz += b.yz;
  }
};

// The sum of B^T S B over rows, B the velocity at a row's arm: translations, rotations (the lower triangle)
// and between them.
struct RigidSum {
  LinkSum slide;
  Vec3d mixed[3];  // rotations by translations, in columns
  double turn[6];  // 00 10 11 20 21 22

  HOST_DEVICE void add(const LinkSum& s, Vec3d r, double scale) {
    slide.add(s);
    const Vec3d arm = r * (1 / scale);
    const Vec3d column[3] = {cross(arm, {s.xx, s.xy, s.xz}), cross(arm, {s.xy, s.yy, s.yz}),
                             cross(arm, {s.xz, s.yz, s.zz})};
    for (int k = 0; k < 3; ++k) mixed[k] += column[k];
    // The velocities at the arm of turns about the axes.
    const Vec3d x = arm.y * column[2] - arm.z * column[1];
    const Vec3d y = arm.z * column[0] - arm.x * column[2];
    const Vec3d z = arm.x * column[1] - arm.y * column[0];
    turn[0] += x.x, turn[1] += x.y, turn[2] += y.y;
    turn[3] += x.z, turn[4] += y.z, turn[5] += z.z;
  }
  HOST_DEVICE void expand(double (&entries)[motions][motions]) const {
    const double sliding[3][3] = {
        {slide.xx, slide.xy, slide.xz}, {slide.xy, slide.yy, slide.yz}, {slide.xz, slide.yz, slide.zz}};
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        entries[k][l] = sliding[k][l];
        entries[3 + k][l] = entries[l][3 + k] = mixed[l][k];
        entries[3 + k][3 + l] = turn[k > l ? k * (k + 1) / 2 + l : l * (l + 1) / 2 + k];
      }
  }
};

// P^T A P of the rows of one aggregate. The force of a radial link acts along the line between i and j, so
// its moment is the same whether it is taken at i or at j: both aggregates may be moved at i, and of all
// links from i to one other aggregate only the sum matters. Isotropic links do without moments.
struct AssembleRows {
  LinearSystem system;
  RowCells rows;
  AggregateView aggregates;
  Span<const Index> owner;
  Span<double> block;

  HOST_DEVICE void operator()(Index a) const {
    clear_blocks(block, a);
    RigidSum sums[kept_slots] = {};
    const RowRange own = rows.of(aggregates.cell[a]);
    double inertia = 0;
    for (Index i = own.first; i < own.end; ++i) {
      add_row(a, i, sums);
      inertia += particle_inertia * static_cast<double>(system.diagonal[i].w);
    }
    double entries[motions][motions];
    for (int n = 0; n < kept_slots; ++n) {
      sums[n].expand(entries);
      n == 0 ? store_own(a, entries, inertia) : store_link(a, own_slot + n, entries);
    }
  }

  HOST_DEVICE void add_row(Index a, Index i, RigidSum* total) const {
    const Vec3d here = to_double(xyz(system.place[i]));
    LinkSum sums[kept_slots] = {};  // to the following slots; the first: all that row i is held by
    LinkSum inner = {};             // in a rigid aggregate these do nothing; with aggregates that have
                                    // drifted here from farther away they are left out
    LinkSum* sum = nullptr;
    Index last = -1;
    const ListRow row = system.links.entries(i);
    const bool periodic = system.box.any();
    const Vec3d short_period = aggregates.grid.short_period();
    for (Index k = 0; k < system.links.length[i]; ++k) {
      const Offset at = row.at(k);
      const Index j = row.one(k), b = owner[j];
      if (b != last) {
        const int slot = aggregates.grid.slot(aggregates.steps[a], aggregates.steps[b]);
        sum = slot == own_slot || slot < 0 ? &inner : &sums[larger(0, slot - own_slot)];
        last = b;
      }
      Vec3d d = here - to_double(xyz(system.place[j]));
      const auto weight = static_cast<double>(system.weight.one(at));
      if (periodic) {
        const Vec3d direct = d;
        d = nearest_image(system.box, d);
        if (differ_by(direct, d, short_period)) {
          sums[0].add(system.coupling, weight, d);
          add_across(a, i, j, weight, d);
          continue;
        }
      }
      sum->add(system.coupling, weight, d);
    }
    add_sums(a, i, sums, total);
  }

  HOST_DEVICE static bool differ_by(Vec3d a, Vec3d b, Vec3d period) {
    for (int k = 0; k < 3; ++k)
      if (std::fabs(a[k] - b[k]) > 0.5 * period[k] && period[k] > 0) return true;
    return false;
  }

  // A link across the faces of a ring of one or two cells: the centre of the other aggregate is on its other
  // side as well, so each end is moved at its own place.
  HOST_DEVICE void add_across(Index a, Index i, Index j, double weight, Vec3d d) const {
    const Index b = owner[j];
    const int slot = aggregates.grid.slot(aggregates.steps[a], aggregates.steps[b]);
    if (slot < own_slot) return;
    const bool radial = system.coupling == PairCoupling::radial;
    const double scale = aggregates.grid.scale;
    for (int axis = 0; axis < (radial ? 1 : 3); ++axis) {
      Vec3d s = std::sqrt(weight) * d;
      if (!radial) s = {}, s[axis] = std::sqrt(weight * dot(d, d));
      const RigidMotion left = force_at(arm(system, aggregates, i, a), scale, s);
      const RigidMotion right = force_at(arm(system, aggregates, j, b), scale, s);
      double* entries = kept_block(block, a, slot);
      for (int k = 0; k < motions; ++k)
        for (int l = 0; l < motions; ++l) entries[k * motions + l] -= left[k] * right[l];
    }
  }

  HOST_DEVICE void add_sums(Index a, Index i, LinkSum* sums, RigidSum* total) const {
    const Vec3d r = arm(system, aggregates, i, a);
    const double scale = aggregates.grid.scale;
    const Symmetric3 wall = system.wall[i];
    const auto mass = static_cast<double>(system.diagonal[i].w);
    sums[0].add({mass + wall.xx, mass + wall.yy, mass + wall.zz, wall.xy, wall.xz, wall.yz});
    for (int n = 1; n < kept_slots; ++n) {
      if (sums[n].xx + sums[n].yy + sums[n].zz == 0) continue;
      total[n].add(sums[n], r, scale);
      sums[0].add(sums[n]);
    }
    total[0].add(sums[0], r, scale);
  }

  HOST_DEVICE void store_own(Index a, const double (&entries)[motions][motions], double inertia) const {
    double* out = kept_block(block, a, own_slot);
    for (int k = 0; k < motions; ++k)
      for (int l = 0; l < motions; ++l)
        out[k * motions + l] += entries[k][l] + (k == l && k > 2 ? inertia : 0);
  }

  // The forces turned, and their moments taken about the centre of the other aggregate.
  HOST_DEVICE void store_link(Index a, int slot, const double (&entries)[motions][motions]) const {
    Vec3d offset;
    if (system.coupling == PairCoupling::radial)
      offset = aggregates.grid.offset(slot) * (1 / aggregates.grid.scale);
    double* out = kept_block(block, a, slot);
    for (int k = 0; k < motions; ++k) {
      const double* row = entries[k];
      const Vec3d shift = cross(offset, {row[0], row[1], row[2]});
      for (int l = 0; l < 3; ++l) {
        out[k * motions + l] -= row[l];
        out[k * motions + 3 + l] += shift[l] - row[3 + l];
      }
    }
  }
};

// T^T A T from the next finer level, T the motions of the parts as their aggregate moves.
struct AssembleParts {
  CoarseView finer;
  AggregateView aggregates;
  Span<double> block;

  HOST_DEVICE void operator()(Index a) const {
    clear_blocks(block, a);
    const AggregateGrid& fine = finer.aggregates.grid;
    const Index cell = aggregates.cell[a];
    for (int child = 0; child < 8; ++child) {
      const int c[3] = {2 * aggregates.grid.along(cell, 0) + (child & 1),
                        2 * aggregates.grid.along(cell, 1) + (child >> 1 & 1),
                        2 * aggregates.grid.along(cell, 2) + (child >> 2)};
      if (!fine.holds(c)) continue;
      const Index part = finer.aggregates.number[fine.cell_at(c)];
      if (part >= 0) add_part(a, part);
    }
  }

  HOST_DEVICE void add_part(Index a, Index part) const {
    const AggregateGrid& fine = finer.aggregates.grid;
    for (int from = 0; from < neighbour_slots; ++from) {
      const Index other = finer.aggregates.neighbour[static_cast<Offset>(part) * neighbour_slots + from];
      if (other < 0) continue;
      const Index other_cell = finer.aggregates.cell[other];
      const int slot = aggregates.grid.slot(aggregates.steps[a],
                                            aggregates.grid.steps(fine.parent(other_cell, aggregates.grid)));
      if (slot < own_slot) continue;
      add_block(kept_block(block, a, slot), part, from, other_cell);
    }
  }

  HOST_DEVICE void add_block(double* entries, Index part, int from, Index other_cell) const {
    const AggregateGrid& fine = finer.aggregates.grid;
    const double scale = aggregates.grid.scale;
    const Vec3d left = arm_of_part(fine, finer.aggregates.cell[part]), right = arm_of_part(fine, other_cell);
    for (int l = 0; l < motions; ++l) {
      RigidMotion unit;
      (l < 3 ? unit.translation[l] : unit.rotation[l - 3]) = 1;
      const RigidMotion v = motion_of_part(unit, right, scale);
      double column[motions];
      for (int k = 0; k < motions; ++k) {
        column[k] = 0;
        for (int n = 0; n < motions; ++n) column[k] += finer.entry(part, from, k, n) * v[n];
      }
      const RigidMotion force = force_of_part(load_motion(column), left, scale);
      for (int k = 0; k < motions; ++k) entries[k * motions + l] += force[k];
    }
  }
};

struct InvertBlocks {
  Span<const double> block;
  Span<double> inverse;
  HOST_DEVICE void operator()(Index a) const {
    double entries[block_entries];
    const double* own = block.data + static_cast<Offset>(a) * kept_slots * block_entries;
    for (int k = 0; k < block_entries; ++k) entries[k] = own[k];
    invert(entries, motions);
    double* out = inverse.data + static_cast<Offset>(a) * block_entries;
    for (int k = 0; k < block_entries; ++k) out[k] = entries[k];
  }
};

}  // namespace

CoarseMatrix::CoarseMatrix(Context& c)
    : context_(c),
      aggregates_(c),
      block_(c, "coarse blocks"),
      inverse_(c, "coarse inverses"),
      owner_(c, "aggregates of rows") {}

void CoarseMatrix::resize() {
  constexpr Offset margin_percent = 10;
  block_.resize(static_cast<Offset>(aggregates()) * kept_slots * block_entries, margin_percent);
  inverse_.resize(static_cast<Offset>(aggregates()) * block_entries, margin_percent);
}

void CoarseMatrix::find(const RowCells& rows, Index row_count) {
  aggregates_.find(rows);
  resize();
  owner_.resize(row_count);
  const AggregateView a = aggregates_.view();
  launch(context_, "owners", a.count, FindOwners{rows, a.cell, owner_.span()});
}

void CoarseMatrix::find(const CoarseView& finer) {
  aggregates_.find(finer.aggregates);
  resize();
}

void CoarseMatrix::assemble(const LinearSystem& system, const RowCells& rows) {
  const AggregateView a = aggregates_.view();
  launch(context_, "assemble aggregates", a.own,
         FromAggregate<AssembleRows>{{system, rows, a, owner_.span(), block_.span()}, a.first_own});
  if (rows.halo) gather_own(context_, a, block_, static_cast<Offset>(kept_slots) * block_entries);
  launch(context_, "invert blocks", a.count, InvertBlocks{block_.span(), inverse_.span()});
}

void CoarseMatrix::assemble(const CoarseView& finer) {
  const AggregateView a = aggregates_.view();
  launch(context_, "assemble aggregates", a.count, AssembleParts{finer, a, block_.span()});
  launch(context_, "invert blocks", a.count, InvertBlocks{block_.span(), inverse_.span()});
}

}  // namespace slagflow
