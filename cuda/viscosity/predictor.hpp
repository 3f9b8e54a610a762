// Second sweep over the pairs: pressure and gravity predictor, equation (6), and the coefficients of the
// implicit viscous step, which need the same distances.
#pragma once

#include "neighbours/pairs.hpp"
#include "viscosity/linear_system.hpp"

namespace slagflow {

// What the sweep writes, one entry per fluid particle; weights per pair.
struct PredictorOutput {
  Span<Quad> predicted;        // xyz: u* [m/s]
  Span<Quad> by_pressure;      // xyz: force per volume by pressure [N/m^3]
  Span<Quad> given;            // xyz: impulse by pressure of pairing and walls [N s], beyond what the elastic
                               // energy loses
  PairWeightsToWrite weight;   // w_ij [kg/m^2], laid out as the fluid list; 0 beyond the support
  Span<Quad> diagonal;         // xyz: diagonal of A, w: mass [kg]
  Span<Symmetric3> wall;       // wall block B [kg]
  Span<Quad> right_hand_side;  // xyz: m u* + wall part [kg m/s]
};

//   u*_i = v_i + dt (g + a_i - V_i/m_i sum_j V_j (p_i + p_j + pairing_ij) F_ij x_ij)
// with the acceleration a_i by surface tension and
//   pairing_ij = eps [(W(r)/W(dx))^4 - 1]_+ (|p_i| + |p_j|)
// and, for the radial operator, with the mean eta_ij, harmonic between two fluids,
//   w_ij = theta dt C 2(d+2) eta_ij V_i V_j |F_ij| / r^2
// (J. J. Monaghan's radial viscous term in the form of M. Weiler et al., Comput. Graph. Forum 37 (2018) 135).
// The laplacian operator has w_ij |x_ij|^2 = theta dt C 2 eta_ij V_i V_j |F_ij|.
// Wall pairs weigh more by the no-slip factor and go into the block B_i. Needs theta > 0.
void predict_and_assemble(Context&, const PairContext&, const PredictorOutput&, Real dt, Real theta);

}  // namespace slagflow
