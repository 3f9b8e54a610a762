// Flow curves of the rheologies that a viscometer can tell apart, in simple shear and between concentric
// cylinders.
#pragma once

#include <array>

namespace slagflow {

enum class FlowModel { newtonian, bingham, herschel_bulkley };
inline constexpr std::array<FlowModel, 3> flow_models{FlowModel::newtonian, FlowModel::bingham,
                                                      FlowModel::herschel_bulkley};
const char* name_of(FlowModel model);  // as in a case file

// tau = tau_B + K rate^n. Newtonian: tau_B 0, n 1; Bingham: n 1, K the plastic viscosity.
struct FlowParameters {
  double yield_stress = 0;  // tau_B [Pa]; a fit may try values below 0
  double consistency = 1;   // K [Pa s^n] > 0
  double flow_index = 1;    // n > 0
};

// Concentric cylinders, the inner one (the bob) turns. End effects are not in the equations: a height that
// was corrected for them goes in here.
struct Cylinders {
  double bob_radius = 0;  // [m]
  double cup_radius = 0;  // [m]
  double height = 0;      // [m] of the wetted bob

  double ratio() const { return bob_radius / cup_radius; }
  double bob_stress(double torque) const;   // [N m] -> [Pa]
  double nominal_rate(double omega) const;  // [rad/s] -> shear rate of a Newtonian fluid at the bob [1/s]
};

// Stress [Pa] of the fluid at a shear rate > 0 [1/s].
double shear_stress(const FlowParameters&, double rate);

// Rotation [rad/s] at which the stress at the bob has a value [Pa], of ideal fluids, exact for any gap:
//   Omega = 1/2 int from max(tau_b kappa^2, tau_B) to tau_b of ((tau - tau_B)/K)^(1/n) dtau/tau
// with kappa = bob_radius/cup_radius; the lower limit is the cup, or the surface within which the fluid
// yields. For n = 1 it is the closed form of Reiner and Riwlin. Throws Error when the integral fails.
double rotation(const FlowParameters&, const Cylinders&, double bob_stress);

// The inverse: stress at the bob [Pa] at a rotation > 0 [rad/s].
double bob_stress(const FlowParameters&, const Cylinders&, double omega);

}  // namespace slagflow
