// The matrix of the rigid motions of aggregates, in blocks of 6 x 6: P^T A P with P the rigid motions. In
// double precision: a stiff body that moves as a whole is the small difference of large entries.
#pragma once

#include "viscosity/solvers/aggregates.hpp"
#include "viscosity/solvers/rigid_modes.hpp"

namespace slagflow {

constexpr int motions = 6, block_entries = motions * motions;
// Of each pair only one block is kept: of slots own_slot to neighbour_slots - 1.
constexpr int kept_slots = neighbour_slots - own_slot;

struct CoarseView {
  AggregateView aggregates;
  Span<const double> block;    // kept_slots blocks of each aggregate, by rows
  Span<const double> inverse;  // of the own block

  HOST_DEVICE const double* kept(Index i, int slot) const {
    return block.data + (static_cast<Offset>(i) * kept_slots + slot - own_slot) * block_entries;
  }
  // The block that couples aggregate i to `other`, which stands in `slot`: by columns below own_slot.
  HOST_DEVICE const double* entries(Index i, int slot, Index other) const {
    return slot >= own_slot ? kept(i, slot) : kept(other, neighbour_slots - 1 - slot);
  }
  // Entry of the block that couples motion a of aggregate i to motion b of the one in `slot`.
  HOST_DEVICE double entry(Index i, int slot, int a, int b) const {
    if (slot >= own_slot) return kept(i, slot)[a * motions + b];
    const Index other = aggregates.neighbour[static_cast<Offset>(i) * neighbour_slots + slot];
    return kept(other, neighbour_slots - 1 - slot)[b * motions + a];
  }
};

HOST_DEVICE inline Vec3d nearest_image(const PeriodicBox& box, Vec3d d) {
  for (int k = 0; k < 3; ++k) {
    const auto period = static_cast<double>(box.period[k]);
    if (period > 0) d[k] -= period * std::rint(d[k] / period);
  }
  return d;
}

// From the centre of its aggregate to a row's particle [m], in double precision, so that what cancels
// cancels. Isotropic links resist turning as they resist any other motion: there the aggregates only slide.
HOST_DEVICE inline Vec3d arm(const LinearSystem& system, const AggregateView& aggregates, Index row,
                             Index owner) {
  if (system.coupling == PairCoupling::isotropic) return {};
  return nearest_image(system.box,
                       to_double(xyz(system.place[row])) - aggregates.grid.centre(aggregates.steps[owner]));
}

// From the centre of an aggregate of the next coarser level to that of one of its parts [m].
HOST_DEVICE inline Vec3d arm_of_part(const AggregateGrid& finer, Index cell) {
  return {(finer.along(cell, 0) % 2 - 0.5) * finer.width.x, (finer.along(cell, 1) % 2 - 0.5) * finer.width.y,
          (finer.along(cell, 2) % 2 - 0.5) * finer.width.z};
}
// The part's motions as its parent moves; and what the part's forces do to the parent. The parent's scale is
// twice the part's.
HOST_DEVICE inline RigidMotion motion_of_part(RigidMotion parent, Vec3d arm, double scale) {
  return {parent.at(arm, scale), 0.5 * parent.rotation};
}
HOST_DEVICE inline RigidMotion force_of_part(RigidMotion part, Vec3d arm, double scale) {
  RigidMotion result = force_at(arm, scale, part.translation);
  result.rotation += 0.5 * part.rotation;
  return result;
}

class CoarseMatrix {
 public:
  explicit CoarseMatrix(Context&);

  // Finds the aggregates: of rows, the occupied cells, or of those of the next finer level. Waits.
  void find(const RowCells&, Index row_count);
  void find(const CoarseView& finer);
  // The matrix, of the fine system or of the next finer level; may be recorded.
  void assemble(const LinearSystem&, const RowCells&);
  void assemble(const CoarseView& finer);

  Index aggregates() const { return aggregates_.view().count; }
  bool single() const { return aggregates_.view().grid.single(); }
  CoarseView view() const { return {aggregates_.view(), block_.span(), inverse_.span()}; }
  // The aggregate of each row of the fine system.
  Span<const Index> owner() const { return owner_.span(); }

 private:
  void resize();

  Context& context_;
  Aggregates aggregates_;
  Buffer<double> block_, inverse_;
  Buffer<Index> owner_;
};

}  // namespace slagflow
