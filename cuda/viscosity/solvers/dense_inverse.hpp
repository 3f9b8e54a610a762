// The coarsest matrix inverted as a whole, on the device.
#pragma once

#include "viscosity/solvers/coarse_matrix.hpp"

namespace slagflow {

class DenseInverse {
 public:
  explicit DenseInverse(Context& c)
      : context_(c), now_(c, "coarsest inverse"), next_(c, "coarsest inverse") {}

  // Takes the memory for so many aggregates.
  void resize(Index aggregates);
  // Inverts a matrix of that many, by launches that may be recorded. The matrix must be symmetric and
  // positive definite; the order of operations is fixed.
  void launch_inversion(const CoarseView&);

  // By rows, of motions * aggregates entries each.
  Span<const double> span() const { return now_.span(); }

 private:
  Context& context_;
  Index size_ = 0;
  Buffer<double> now_, next_;
};

}  // namespace slagflow
