#include "host/rheometry/rheometry_fit.hpp"

#define EIGEN_MPL2_ONLY       // nothing of Eigen under another licence
#define EIGEN_DONT_VECTORIZE  // three unknowns; gcc 12 warns of its own AVX-512 header
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unsupported/Eigen/NonLinearOptimization>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_student.hpp"

namespace slagflow {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Which parameters are free, and their order as unknowns: tau_B, ln K, ln n. The logarithms keep K and n
// positive during the iteration; intervals are of K and n themselves.
struct Unknowns {
  bool yield_stress, flow_index;

  Eigen::Index count() const { return 1 + (yield_stress ? 1 : 0) + (flow_index ? 1 : 0); }
  Eigen::Index consistency() const { return yield_stress ? 1 : 0; }
  FlowParameters parameters(const VectorXd& x) const {
    FlowParameters f;
    if (yield_stress) f.yield_stress = x[0];
    f.consistency = std::exp(x[consistency()]);
    if (flow_index) f.flow_index = std::exp(x[consistency() + 1]);
    return f;
  }
  VectorXd vector(const FlowParameters& f) const {
    VectorXd x(count());
    if (yield_stress) x[0] = f.yield_stress;
    x[consistency()] = std::log(f.consistency);
    if (flow_index) x[consistency() + 1] = std::log(f.flow_index);
    return x;
  }
};

// Of K in Pa s^n and of n.
constexpr double most_consistency = 1e9, least_index = 0.02, most_index = 20;
bool within_limits(const FlowParameters& f, double share) {
  return f.consistency < share * most_consistency && f.consistency * most_consistency > 1 / share &&
         f.flow_index < share * most_index && f.flow_index > least_index / share;
}

// What Eigen minimises: the squares of the residuals.
struct Problem {
  const FlowCurve& curve;
  Unknowns unknowns;
  std::vector<double> error;  // of each stress [Pa], up to a factor

  Eigen::Index values() const { return static_cast<Eigen::Index>(error.size()); }

  // A trial out of the limits is far from the readings.
  int operator()(const VectorXd& x, VectorXd& residuals) const {
    constexpr double far = 1e9;
    const FlowParameters f = unknowns.parameters(x);
    residuals.setConstant(values(), far);
    if (!within_limits(f, 1)) return 0;
    const std::vector<double> model = stresses(f, curve.rate, curve.cylinders);
    for (std::size_t i = 0; i < model.size(); ++i)
      residuals[static_cast<Eigen::Index>(i)] = (model[i] - curve.stress[i]) / error[i];
    return 0;
  }

  // Central differences, a cube root of the rounding error apart.
  int df(const VectorXd& x, MatrixXd& jacobian) const {
    constexpr double apart = 6e-6;
    jacobian.resize(values(), x.size());
    VectorXd above, below;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const bool stress = unknowns.yield_stress && k == 0;
      const double step = apart * (stress ? *std::max_element(curve.stress.begin(), curve.stress.end()) : 1);
      VectorXd y = x;
      y[k] = x[k] + step, (*this)(y, above);
      y[k] = x[k] - step, (*this)(y, below);
      jacobian.col(k) = (above - below) / (2 * step);
    }
    return 0;
  }
};

std::vector<double> errors_of(const FlowCurve& curve, ErrorModel errors) {
  if (errors == ErrorModel::relative) return curve.stress;
  return std::vector<double>(curve.stress.size(),
                             *std::max_element(curve.stress.begin(), curve.stress.end()));
}

// A straight line through the nominal flow curve.
FlowParameters first_guess(const FlowCurve& curve, const Unknowns& unknowns) {
  const double scale = curve.cylinders ? curve.cylinders->nominal_rate(1) : 1;
  const auto n = static_cast<double>(curve.rate.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < curve.rate.size(); ++i) {
    const double rate = scale * curve.rate[i];
    x += rate, y += curve.stress[i], xx += rate * rate, xy += rate * curve.stress[i];
  }
  const double spread = n * xx - x * x;
  double slope = spread > 0 ? (n * xy - x * y) / spread : 0;
  if (!unknowns.yield_stress || !(slope > 0)) slope = xy / xx;
  return {unknowns.yield_stress ? std::max(0.0, (y - slope * x) / n) : 0, slope, 1};
}

// A minimum that was found: where, sum of the squared residuals, covariance up to the factor s^2.
struct Minimum {
  VectorXd x;
  double sum = std::numeric_limits<double>::infinity();
  VectorXd covariance;  // diagonal of (J^T J)^-1
  bool inside = false;  // not where the limits of K and n are: the readings decide on the curve

  bool found() const { return x.size() > 0; }
  bool better_than(const Minimum& other) const { return inside != other.inside ? inside : sum < other.sum; }
};

// With J P = Q R it is P R^-1 R^-T P^T.
VectorXd covariance_diagonal(const MatrixXd& jacobian) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(jacobian);
  const Eigen::Index p = jacobian.cols();
  const MatrixXd upper = qr.matrixR().topLeftCorner(p, p);
  const MatrixXd inverse = upper.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(p, p));
  return qr.colsPermutation() * inverse.rowwise().squaredNorm();
}

Minimum minimise(const Problem& problem, const FlowParameters& guess) {
  Eigen::LevenbergMarquardt<const Problem> search(problem);
  search.parameters.xtol = 1e-10;
  search.parameters.ftol = 1e-15;
  search.parameters.gtol = 1e-12;
  search.parameters.maxfev = 500;
  Minimum found;
  VectorXd x = problem.unknowns.vector(guess);
  const Eigen::LevenbergMarquardtSpace::Status status = search.minimize(x);
  if (status == Eigen::LevenbergMarquardtSpace::ImproperInputParameters ||
      status == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation)
    return found;
  MatrixXd jacobian;
  problem.df(x, jacobian);
  found.covariance = covariance_diagonal(jacobian);
  if (!found.covariance.allFinite()) return found;
  found.x = x;
  found.sum = search.fnorm * search.fnorm;
  found.inside = within_limits(problem.unknowns.parameters(x), 0.99);
  return found;
}

// The best minimum from several starts: the sum of squares of a power law may have more than one.
Minimum best_minimum(const Problem& problem) {
  const FlowParameters guess = first_guess(problem.curve, problem.unknowns);
  Minimum best = minimise(problem, guess);
  if (!problem.unknowns.flow_index) return best;
  for (const double n : {0.4, 0.7}) {
    const FlowParameters other{0.5 * guess.yield_stress, guess.consistency, n};
    Minimum found = minimise(problem, other);
    if (found.better_than(best)) best = std::move(found);
  }
  return best;
}

Estimate estimate(double value, double deviation, double t) {
  return {value, value - t * deviation, value + t * deviation};
}

// Throws Error when there is none within the limits; one with a yield stress below 0 is not asked to be, as
// it is fitted again.
FlowFit fit_with(const Unknowns& unknowns, FlowModel model, const FlowCurve& curve, ErrorModel errors) {
  const Problem problem{curve, unknowns, errors_of(curve, errors)};
  const Minimum found = best_minimum(problem);
  if (!found.found() || (!found.inside && !(unknowns.yield_stress && found.x[0] < 0)))
    throw Error(std::string("the fit of the ") + name_of(model) + " model did not converge");
  const auto n = static_cast<double>(curve.rate.size()), p = static_cast<double>(unknowns.count());
  const double t = student_95(static_cast<int>(n - p)), s = std::sqrt(found.sum / (n - p));
  const auto deviation = [&](Eigen::Index k) { return s * std::sqrt(found.covariance[k]); };

  FlowFit result;
  result.model = model;
  result.free_parameters = static_cast<int>(unknowns.count());
  const Eigen::Index k = unknowns.consistency();
  if (unknowns.yield_stress) result.yield_stress = estimate(found.x[0], deviation(0), t);
  const double consistency = std::exp(found.x[k]);
  result.consistency = estimate(consistency, consistency * deviation(k), t);
  result.flow_index = {1, 1, 1};
  if (unknowns.flow_index) {
    const double index = std::exp(found.x[k + 1]);
    result.flow_index = estimate(index, index * deviation(k + 1), t);
  }
  result.residual = std::sqrt(found.sum / n) * (errors == ErrorModel::absolute ? problem.error[0] : 1);
  // The floor keeps noise-free data, whose residuals are round-off, from favouring parameters.
  const double mean = std::max(found.sum / n, 1e-20), free = p + 1;
  result.aicc = n * std::log(mean) + 2 * free + 2 * free * (free + 1) / (n - free - 1);
  return result;
}

}  // namespace

int points_needed(FlowModel model) { return 4 + static_cast<int>(model); }

std::vector<double> stresses(const FlowParameters& f, const std::vector<double>& rates,
                             const std::optional<Cylinders>& cylinders) {
  std::vector<double> result;
  result.reserve(rates.size());
  for (const double rate : rates)
    result.push_back(cylinders ? bob_stress(f, *cylinders, rate) : shear_stress(f, rate));
  return result;
}

FlowFit fit(FlowModel model, const FlowCurve& curve, ErrorModel errors) {
  if (curve.rate.size() < static_cast<std::size_t>(points_needed(model)))
    throw InputError(std::to_string(curve.rate.size()) + " points are too few for the " + name_of(model) +
                     " model: allowed: at least " + std::to_string(points_needed(model)));
  const bool power_law = model == FlowModel::herschel_bulkley;
  FlowFit free = fit_with({model != FlowModel::newtonian, power_law}, model, curve, errors);
  if (model == FlowModel::newtonian || free.yield_stress.value > 0) return free;
  FlowFit held = fit_with({false, power_law}, model, curve, errors);
  held.at_zero_yield = true;
  return held;
}

std::vector<FlowFit> fit_all(const FlowCurve& curve, ErrorModel errors) {
  std::vector<FlowFit> fits;
  for (const FlowModel model : flow_models) {
    if (curve.rate.size() < static_cast<std::size_t>(points_needed(model))) continue;
    try {
      fits.push_back(fit(model, curve, errors));
    } catch (const Error&) {
      // The others may fit; Newtonian always does.
    }
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const FlowFit& a, const FlowFit& b) { return a.aicc < b.aicc; });
  return fits;
}

}  // namespace slagflow
