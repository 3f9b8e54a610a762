// How thick the fluid is around each of its particles.
#pragma once

#include "fluid/diagnostic_scratch.hpp"
#include "neighbours/pairs.hpp"

namespace slagflow {

// Below three particles across a sheet is thinner than the method can carry: it tears by itself. [spacings]
constexpr double thin_sheet = 2.75;

// A particle sees, within the support radius, fluid over some length along the direction in which that varies
// least; with a spacing on top that is the thickness of its sheet, thread or drop. Near a surface of thick
// fluid it sees too little: the largest that it and its neighbours see is taken. Tells up to 4.5
// spacings, and of what is thicker no more than that. Walls do not count as fluid.
class SheetThickness {
 public:
  explicit SheetThickness(Context&);

  // [m] of each particle, until the next call.
  const Buffer<Real>& measure(const PairContext&);
  // Particles in what is thinner than three spacings.
  void count_thin(const PairContext&, GatheredSums&, std::int64_t& count);
  // What the last call gave.
  const Buffer<Real>& thickness() const { return thickness_; }

 private:
  Context& context_;
  Buffer<Real> seen_, thickness_;
};

// Eigenvector of the smallest eigenvalue of a symmetric matrix, of length 1.
HOST_DEVICE Vec3 least_axis(Symmetric3);

}  // namespace slagflow
