#include "host/rheometry/rheometry_fit.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_matrix.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "backend/error.hpp"

namespace slagflow {
namespace {

// GSL's default handler ends the program.
class QuietGsl {
 public:
  QuietGsl() : before_(gsl_set_error_handler_off()) {}
  ~QuietGsl() { gsl_set_error_handler(before_); }
  QuietGsl(const QuietGsl&) = delete;
  QuietGsl& operator=(const QuietGsl&) = delete;

 private:
  gsl_error_handler_t* before_;
};

// Which parameters are free, and their order as unknowns: tau_B, ln K, ln n. The logarithms keep K and n
// positive during the iteration; intervals are of K and n themselves.
struct Unknowns {
  bool yield_stress, flow_index;

  std::size_t count() const { return 1 + (yield_stress ? 1u : 0u) + (flow_index ? 1u : 0u); }
  std::size_t consistency() const { return yield_stress ? 1 : 0; }
  FlowParameters parameters(const gsl_vector* x) const {
    FlowParameters f;
    if (yield_stress) f.yield_stress = gsl_vector_get(x, 0);
    f.consistency = std::exp(gsl_vector_get(x, consistency()));
    if (flow_index) f.flow_index = std::exp(gsl_vector_get(x, consistency() + 1));
    return f;
  }
};

struct Problem {
  const FlowCurve& curve;
  Unknowns unknowns;
  std::vector<double> error;  // of each stress [Pa], up to a factor
};

int residuals(const gsl_vector* x, void* data, gsl_vector* result) {
  const Problem& problem = *static_cast<const Problem*>(data);
  const FlowParameters f = problem.unknowns.parameters(x);
  constexpr double most = 1e9;  // a wild trial: K in Pa s^n, or a flow index that overflows
  if (!(f.consistency < most && f.consistency > 1 / most && f.flow_index < 20 && f.flow_index > 0.02))
    return GSL_EDOM;
  const std::vector<double> model = stresses(f, problem.curve.rate, problem.curve.cylinders);
  for (std::size_t i = 0; i < model.size(); ++i)
    gsl_vector_set(result, i, (model[i] - problem.curve.stress[i]) / problem.error[i]);
  return GSL_SUCCESS;
}

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

using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>;
using Matrix = std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)>;
using Vector = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;

// A minimum that was found: where, sum of the squared residuals, covariance up to the factor s^2.
struct Minimum {
  std::vector<double> x;
  double sum = std::numeric_limits<double>::infinity();
  std::vector<double> covariance;  // diagonal
};

Minimum minimise(Problem& problem, const FlowParameters& guess) {
  const std::size_t n = problem.curve.rate.size(), p = problem.unknowns.count();
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;
  const Workspace work(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, p),
                       &gsl_multifit_nlinear_free);
  const Vector start(gsl_vector_alloc(p), &gsl_vector_free);
  if (problem.unknowns.yield_stress) gsl_vector_set(start.get(), 0, guess.yield_stress);
  gsl_vector_set(start.get(), problem.unknowns.consistency(), std::log(guess.consistency));
  if (problem.unknowns.flow_index)
    gsl_vector_set(start.get(), problem.unknowns.consistency() + 1, std::log(guess.flow_index));
  gsl_multifit_nlinear_fdf system{};
  system.f = &residuals, system.n = n, system.p = p, system.params = &problem;
  Minimum found;
  if (gsl_multifit_nlinear_init(start.get(), &system, work.get()) != GSL_SUCCESS) return found;
  constexpr std::size_t most_iterations = 500;
  int reason = 0;
  const int status =
      gsl_multifit_nlinear_driver(most_iterations, 1e-10, 1e-12, 0, nullptr, nullptr, &reason, work.get());
  // No progress is the end where the start was the minimum, or the residuals are round-off.
  if (status != GSL_SUCCESS && status != GSL_ENOPROG && reason != GSL_ENOPROG) return found;
  const Matrix covariance(gsl_matrix_alloc(p, p), &gsl_matrix_free);
  gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work.get()), 0, covariance.get());
  found.sum = 0;
  const gsl_vector* r = gsl_multifit_nlinear_residual(work.get());
  for (std::size_t i = 0; i < n; ++i) found.sum += gsl_vector_get(r, i) * gsl_vector_get(r, i);
  for (std::size_t k = 0; k < p; ++k) {
    found.x.push_back(gsl_vector_get(gsl_multifit_nlinear_position(work.get()), k));
    found.covariance.push_back(gsl_matrix_get(covariance.get(), k, k));
  }
  return found;
}

// The best minimum from several starts: the sum of squares of a power law may have more than one.
Minimum best_minimum(Problem& problem) {
  const FlowParameters guess = first_guess(problem.curve, problem.unknowns);
  Minimum best = minimise(problem, guess);
  if (!problem.unknowns.flow_index) return best;
  for (const double n : {0.4, 0.7}) {
    FlowParameters other{0.5 * guess.yield_stress, guess.consistency, n};
    Minimum found = minimise(problem, other);
    if (found.sum < best.sum) best = std::move(found);
  }
  return best;
}

Estimate estimate(double value, double deviation, double t) {
  return {value, value - t * deviation, value + t * deviation};
}

FlowFit fit_with(const Unknowns& unknowns, FlowModel model, const FlowCurve& curve, ErrorModel errors) {
  Problem problem{curve, unknowns, errors_of(curve, errors)};
  const Minimum found = best_minimum(problem);
  if (found.x.empty())
    throw Error(std::string("the fit of the ") + name_of(model) + " model did not converge");
  const auto n = static_cast<double>(curve.rate.size()), p = static_cast<double>(unknowns.count());
  const double t = gsl_cdf_tdist_Pinv(0.975, n - p), s = std::sqrt(found.sum / (n - p));
  const auto deviation = [&](std::size_t k) { return s * std::sqrt(found.covariance[k]); };

  FlowFit result;
  result.model = model;
  result.free_parameters = static_cast<int>(unknowns.count());
  const std::size_t k = unknowns.consistency();
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
  const QuietGsl quiet;
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
