#include "host/rheometry/rheometry_melt_fit.hpp"

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

constexpr double most_b = 1e6;       // [K] that a case allows
constexpr double least_share = 0.1;  // of the coldest reading: a T0 below it is no VFT law

// Of A, B and T0.
double log_by_law(LiquidLaw law, double log_a, double b, double t0, double t) {
  switch (law) {
    case LiquidLaw::arrhenius:
      return log_arrhenius(log_a, b, t);
    case LiquidLaw::weymann:
      return log_weymann(log_a, b, t);
    default:
      return log_vft(log_a, b, t0, t);
  }
}

// Unknowns: ln A, B in units of the coldest temperature, and that share of it that is T0. Their order is the
// columns of the Jacobian.
struct Problem {
  const ViscositySeries& series;
  LiquidLaw law;

  double scale() const { return series.temperature.front(); }
  Eigen::Index unknowns() const { return law == LiquidLaw::vft ? 3 : 2; }
  Eigen::Index values() const { return static_cast<Eigen::Index>(series.count()); }
  double log_viscosity(const VectorXd& x, double t) const {
    return log_by_law(law, x[0], x[1] * scale(), law == LiquidLaw::vft ? x[2] * scale() : 0, t);
  }
  bool inside(const VectorXd& x) const {
    return x[1] > 0 && x[1] * scale() <= most_b && std::abs(x[0]) < 600 &&
           (law != LiquidLaw::vft || (x[2] > 0 && x[2] < 0.9999));
  }

  // A trial out of the limits is far from the readings.
  int operator()(const VectorXd& x, VectorXd& residuals) const {
    constexpr double far = 1e6;
    residuals.setConstant(values(), far);
    if (law == LiquidLaw::vft && !(x[2] < 0.9999)) return 0;
    for (Eigen::Index k = 0; k < values(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      residuals[k] = log_viscosity(x, series.temperature[i]) - std::log(series.viscosity[i]);
    }
    return 0;
  }

  // Central differences, a cube root of the rounding error apart.
  int df(const VectorXd& x, MatrixXd& jacobian) const {
    constexpr double apart = 6e-6;
    jacobian.resize(values(), x.size());
    VectorXd above, below;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      VectorXd y = x;
      y[k] = x[k] + apart, (*this)(y, above);
      y[k] = x[k] - apart, (*this)(y, below);
      jacobian.col(k) = (above - below) / (2 * apart);
    }
    return 0;
  }
};

// The best line c0 + c1 x1 + ... through the logarithms.
VectorXd solve(const MatrixXd& columns, const VectorXd& logs) {
  return columns.colPivHouseholderQr().solve(logs);
}

VectorXd logs_of(const ViscositySeries& series) {
  VectorXd logs(static_cast<Eigen::Index>(series.count()));
  for (std::size_t k = 0; k < series.count(); ++k)
    logs[static_cast<Eigen::Index>(k)] = std::log(series.viscosity[k]);
  return logs;
}

// With the T0 of the guess all laws are lines.
VectorXd first_guess(const Problem& problem, double share) {
  MatrixXd columns(problem.values(), 2);
  VectorXd logs = logs_of(problem.series);
  for (Eigen::Index k = 0; k < problem.values(); ++k) {
    const double t = problem.series.temperature[static_cast<std::size_t>(k)];
    columns(k, 0) = 1, columns(k, 1) = problem.scale() / (t - share * problem.scale());
    if (problem.law == LiquidLaw::weymann) logs[k] -= std::log(t);
  }
  const VectorXd line = solve(columns, logs);
  VectorXd x(problem.unknowns());
  x[0] = line[0], x[1] = line[1];
  if (problem.law == LiquidLaw::vft) x[2] = share;
  return x;
}

struct Minimum {
  VectorXd x;
  double sum = std::numeric_limits<double>::infinity();
};

Minimum minimise(const Problem& problem, double share) {
  Eigen::LevenbergMarquardt<const Problem> search(problem);
  search.parameters.xtol = 1e-12;
  search.parameters.ftol = 1e-15;
  search.parameters.gtol = 1e-12;
  search.parameters.maxfev = 2000;
  VectorXd x = first_guess(problem, share);
  const Eigen::LevenbergMarquardtSpace::Status status = search.minimize(x);
  if (status == Eigen::LevenbergMarquardtSpace::ImproperInputParameters || !x.allFinite()) return {};
  return {x, search.fnorm * search.fnorm};
}

Minimum best_minimum(const Problem& problem) {
  if (problem.law != LiquidLaw::vft) return minimise(problem, 0);
  Minimum best;
  for (const double share : {0.3, 0.6, 0.85}) {
    Minimum found = minimise(problem, share);
    if (found.sum < best.sum) best = std::move(found);
  }
  return best;
}

// With J P = Q R it is P R^-1 R^-T P^T.
VectorXd covariance_diagonal(const MatrixXd& jacobian) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(jacobian);
  const Eigen::Index p = jacobian.cols();
  const MatrixXd upper = qr.matrixR().topLeftCorner(p, p);
  const MatrixXd inverse = upper.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(p, p));
  return qr.colsPermutation() * inverse.rowwise().squaredNorm();
}

// The floor keeps noise-free data, whose residuals are round-off, from favouring parameters.
double aicc_of(double sum, double n, double p) {
  const double mean = std::max(sum / n, 1e-20), free = p + 1;
  return n * std::log(mean) + 2 * free + 2 * free * (free + 1) / (n - free - 1);
}

// Two lines of ln eta over 1/T that meet at a temperature: the sum of the squared residuals, and the line of
// the hot part.
struct TwoLines {
  double sum = std::numeric_limits<double>::infinity();
  VectorXd line;       // at the hottest reading, slope, further slope of the cold part
  double meeting = 0;  // [K]
};

TwoLines two_lines(const ViscositySeries& series, double meeting) {
  const auto n = static_cast<Eigen::Index>(series.count());
  MatrixXd columns(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = 1e3 / series.temperature[static_cast<std::size_t>(k)];
    columns(k, 0) = 1, columns(k, 1) = x, columns(k, 2) = std::max(0.0, x - 1e3 / meeting);
  }
  const VectorXd logs = logs_of(series), line = solve(columns, logs);
  return {(columns * line - logs).squaredNorm(), line, meeting};
}

// Of all that meet at or between readings.
TwoLines best_two_lines(const ViscositySeries& series) {
  constexpr std::size_t least_hot = 3;  // readings above the place
  constexpr int places = 4;             // from a reading to the next
  TwoLines best;
  for (std::size_t at = 1; at + least_hot < series.count(); ++at)
    for (int k = 0; k < places; ++k) {
      const double step = (series.temperature[at + 1] - series.temperature[at]) / places;
      TwoLines found = two_lines(series, series.temperature[at] + k * step);
      if (found.sum < best.sum) best = std::move(found);
    }
  return best;
}

}  // namespace

double MeltFit::viscosity(double temperature) const {
  return std::exp(log_by_law(law, std::log(a.value), b.value, t0.value, temperature));
}

int points_needed(LiquidLaw law) { return law == LiquidLaw::vft ? 6 : 5; }

MeltFit fit(LiquidLaw law, const ViscositySeries& series) {
  if (series.count() < static_cast<std::size_t>(points_needed(law)))
    throw InputError(std::to_string(series.count()) + " readings are too few for the law " + name_of(law) +
                     ": allowed: at least " + std::to_string(points_needed(law)));
  const Problem problem{series, law};
  const Minimum found = best_minimum(problem);
  if (found.x.size() == 0 || !problem.inside(found.x) || (law == LiquidLaw::vft && found.x[2] < least_share))
    throw Error(std::string("the fit of the law ") + name_of(law) +
                " did not converge to constants that a case allows");
  const auto n = static_cast<double>(series.count()), p = static_cast<double>(problem.unknowns());
  MatrixXd jacobian;
  problem.df(found.x, jacobian);
  const VectorXd covariance = covariance_diagonal(jacobian);
  const double reach = student_95(static_cast<int>(n - p)) * std::sqrt(found.sum / (n - p));
  const auto estimate = [&](Eigen::Index k, double factor) {
    const double value = factor * found.x[k], off = factor * reach * std::sqrt(covariance[k]);
    return Estimate{value, value - off, value + off};
  };
  MeltFit result;
  result.law = law;
  const Estimate log_a = estimate(0, 1);
  result.a = {std::exp(log_a.value), std::exp(log_a.low), std::exp(log_a.high)};
  result.b = estimate(1, problem.scale());
  if (law == LiquidLaw::vft) result.t0 = estimate(2, problem.scale());
  result.free_parameters = static_cast<int>(p);
  result.residual = std::sqrt(found.sum / n);
  result.aicc = aicc_of(found.sum, n, p);
  return result;
}

std::vector<MeltFit> fit_all(const ViscositySeries& series) {
  std::vector<MeltFit> fits;
  for (const LiquidLaw law : melt_laws) {
    if (series.count() < static_cast<std::size_t>(points_needed(law))) continue;
    try {
      fits.push_back(fit(law, series));
    } catch (const Error&) {
      // The others may fit.
    }
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const MeltFit& a, const MeltFit& b) { return a.aicc < b.aicc; });
  return fits;
}

std::optional<Kink> find_kink(const ViscositySeries& series, const std::vector<MeltFit>& fits) {
  constexpr double parameters = 4;  // two slopes, a height, the place
  constexpr double far_better = 6;  // of AICc
  constexpr double least_excess = 1.2;
  const std::size_t count = series.count();
  if (fits.empty() || count < static_cast<std::size_t>(parameters) + 3) return {};
  const TwoLines best = best_two_lines(series);
  if (!(best.sum < std::numeric_limits<double>::infinity()) || best.line[2] <= 0) return {};
  if (aicc_of(best.sum, static_cast<double>(count), parameters) > fits.front().aicc - far_better) return {};
  const double excess = std::exp(best.line[2] * (1e3 / series.temperature.front() - 1e3 / best.meeting));
  if (excess < least_excess) return {};
  return Kink{*std::lower_bound(series.temperature.begin(), series.temperature.end(), best.meeting), excess};
}

}  // namespace slagflow
