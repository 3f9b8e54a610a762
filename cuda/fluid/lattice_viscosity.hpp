// What the viscous operators make of the viscosity at a finite ratio of support to spacing.
#pragma once

#include "fluid/setup.hpp"

namespace slagflow {

// Effective over nominal viscosity of an operator in a sheared fluid whose particles stand in layers, a
// spacing apart, of a square lattice each (in 2-D: in rows), and slide over each other: the mean over all
// positions of one layer against the other,
//   radial     (d+2) sum_k dx int w x^2 y^2 dA,   y = k dx the distance of the layers, x along the flow
//   laplacian        sum_k dx int w r^2 y^2 dA,   w the viscous weight (smoothing.hpp).
// It tends to 1 as the support grows; that of a lattice at rest, or of random positions, differs by some
// per cent either way.
struct PairWeighting {
  SmoothingKind kernel = SmoothingKind::level;
  ViscousWeight weight = ViscousWeight::lattice;
};
double lattice_viscosity(ViscousOperator, const PairWeighting&, double support_ratio, int dimensions);

}  // namespace slagflow
