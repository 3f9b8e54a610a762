#include "backend/launch.hpp"
#include "viscosity/solvers/dense_inverse.hpp"

namespace slagflow {

namespace {

// A row of the matrix with all its zeros.
struct FillRow {
  CoarseView matrix;
  Index size;
  Span<double> dense;
  HOST_DEVICE void operator()(Index row) const {
    double* out = dense.data + static_cast<Offset>(row) * size;
    for (Index l = 0; l < size; ++l) out[l] = 0;
    const Index a = row / motions;
    for (int slot = 0; slot < neighbour_slots; ++slot) {
      const Index other = matrix.aggregates.neighbour[static_cast<Offset>(a) * neighbour_slots + slot];
      if (other < 0) continue;
      for (int l = 0; l < motions; ++l) out[other * motions + l] = matrix.entry(a, slot, row % motions, l);
    }
  }
};

// Sweeps one pivot. All pivots swept make the inverse, but for its sign.
struct SweepPivot {
  // Entries one by one on a GPU, by rows on a CPU.
  static constexpr bool by_rows = lane_count > 1;
  Span<const double> from;
  Index size, pivot;
  double sign;  // of what is stored
  Span<double> to;
  HOST_DEVICE void operator()(Index n) const {
    const Index row = by_rows ? n : n / size;
    const Index first = by_rows ? 0 : n % size, last = by_rows ? size : first + 1;
    const double* own = from.data + static_cast<Offset>(row) * size;
    const double* across = from.data + static_cast<Offset>(pivot) * size;
    double* out = to.data + static_cast<Offset>(row) * size;
    const double d = 1 / across[pivot], factor = own[pivot] * d;
    for (Index l = first; l < last; ++l)
      out[l] = sign * (row == pivot ? across[l] * d : own[l] - factor * across[l]);
    if (first <= pivot && pivot < last) out[pivot] = sign * (row == pivot ? -d : factor);
  }
};

}  // namespace

void DenseInverse::resize(Index aggregates) {
  size_ = aggregates * motions;
  const Offset entries = static_cast<Offset>(size_) * size_;
  now_.resize(entries), next_.resize(entries);
}

void DenseInverse::launch_inversion(const CoarseView& matrix) {
  static_assert(motions % 2 == 0);  // so that the last of the pivots leaves its result in now_
  launch(context_, "coarsest matrix", size_, FillRow{matrix, size_, now_.span()});
  Span<double> from = now_.span(), to = next_.span();
  const Index parts = SweepPivot::by_rows ? size_ : size_ * size_;
  for (Index pivot = 0; pivot < size_; ++pivot) {
    const double sign = pivot + 1 == size_ ? -1 : 1;
    launch(context_, "coarsest inverse", parts, SweepPivot{from, size_, pivot, sign, to});
    const Span<double> last = from;
    from = to, to = last;
  }
}

}  // namespace slagflow
