// Fits flow curves: least squares, confidence intervals, choice of the model.
#pragma once

#include <optional>
#include <vector>

#include "host/rheometry/rheometry_models.hpp"

namespace slagflow {

// What was measured. Without cylinders `rate` is the shear rate [1/s] and `stress` [Pa] the fluid's; with
// cylinders `rate` is the rotation [rad/s] and `stress` that at the bob.
struct FlowCurve {
  std::vector<double> rate, stress;
  std::optional<Cylinders> cylinders;
};

// absolute: the same error of the stress in all points, as of a torque sensor; relative: the same share of
// it.
enum class ErrorModel { absolute, relative };

struct Estimate {
  double value = 0;
  double low = 0, high = 0;  // 95 % confidence interval; both the value where it is not a free parameter
};

struct FlowFit {
  FlowModel model = FlowModel::newtonian;
  Estimate yield_stress, consistency, flow_index;
  int free_parameters = 0;     // of the curve; the size of the error is one more
  bool at_zero_yield = false;  // the best yield stress was not above 0: it is held at 0
  double residual = 0;         // root of the mean squared residual [Pa], or relative
  double aicc = 0;

  FlowParameters parameters() const { return {yield_stress.value, consistency.value, flow_index.value}; }
};

// The least number of points with which a model can be fitted and compared: AICc needs two more than free
// parameters and the size of the error.
int points_needed(FlowModel model);

// The stress of the model at each of the rates, as it would have been measured.
std::vector<double> stresses(const FlowParameters&, const std::vector<double>& rates,
                             const std::optional<Cylinders>&);

// Least squares by Levenberg and Marquardt. The interval of a parameter is +- t s, s from the covariance
// s^2 (J^T J)^-1 with s^2 = sum r^2/(N - p), t of Student's distribution with N - p degrees of freedom.
//   AICc = N ln(sum r^2/N) + 2k + 2k(k + 1)/(N - k - 1), k = p + 1.
// Throws InputError with fewer than points_needed(model), Error when the iteration fails.
FlowFit fit(FlowModel model, const FlowCurve&, ErrorModel);

// All models for which there are enough points and that converge, best first by AICc; of equals the one that
// comes first in flow_models, as when a Bingham fluid's yield stress is held at 0.
std::vector<FlowFit> fit_all(const FlowCurve&, ErrorModel);

}  // namespace slagflow
