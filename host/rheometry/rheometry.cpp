#include "host/rheometry/rheometry.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"
#include "host/rheometry/rheometry_melt.hpp"
#include "host/rheometry/rheometry_phases.hpp"
#include "host/rheometry/rheometry_slag.hpp"

namespace slagflow {
namespace {

constexpr double close_call = 2;       // AICc: a smaller difference does not tell two models apart
constexpr double most_flow_index = 2;  // that a case file allows

std::vector<NamedEstimate> estimates(const FlowFit& fit) {
  switch (fit.model) {
    case FlowModel::newtonian:
      return {{"dynamic_viscosity", "Pa s", fit.consistency}};
    case FlowModel::bingham:
      return {{"plastic_viscosity", "Pa s", fit.consistency}, {"yield_stress", "Pa", fit.yield_stress}};
    default:
      return {{"consistency", "Pa s^n", fit.consistency},
              {"flow_index", "", fit.flow_index},
              {"yield_stress", "Pa", fit.yield_stress}};
  }
}

// Index of the wanted model, else of the best one. A wanted model that is missing did not converge: trying
// again says so.
std::size_t choose(const RheometryResult& result, const RheometryOptions& options) {
  if (!options.model) return 0;
  const auto is_wanted = [&](const FlowFit& fit) { return fit.model == *options.model; };
  const auto found = std::find_if(result.fits.begin(), result.fits.end(), is_wanted);
  if (found == result.fits.end()) fit(*options.model, result.measured.curve, options.errors);
  return static_cast<std::size_t>(found - result.fits.begin());
}

void add_fit_warnings(RheometryResult& result, const RheometryOptions& options) {
  const FlowFit& best = result.best();
  std::vector<std::string>& warnings = result.warnings;
  if (best.at_zero_yield)
    warnings.push_back(options.file + ": the best yield stress is not above 0: it is held at 0");
  else if (best.model != FlowModel::newtonian && best.yield_stress.low <= 0)
    warnings.push_back(options.file + ": " +
                       print("the interval of the yield stress, %.4g to %.4g Pa, reaches 0",
                             best.yield_stress.low, best.yield_stress.high));
  if (best.model != FlowModel::newtonian && best.consistency.low <= 0)
    warnings.push_back(
        options.file + ": " +
        print("the interval of the viscosity, %.4g to %.4g, reaches 0: these rates do not tell it",
              best.consistency.low, best.consistency.high));
  if (result.measured.facts.spindle && best.model != FlowModel::newtonian)
    warnings.push_back(
        options.file + ": the maker's factor of spindle " + *result.measured.facts.spindle +
        " is for Newtonian fluids; yield stress and index are as of a cylinder in a wide vessel");
  for (const FlowModel model : flow_models)
    if (!options.model && result.measured.curve.rate.size() < static_cast<std::size_t>(points_needed(model)))
      warnings.push_back(options.file + ": " +
                         print("%d points are too few to try the %s model: allowed: at least %d",
                               static_cast<int>(result.measured.curve.rate.size()), name_of(model),
                               points_needed(model)));
  if (!options.model && result.fits.size() > 1 && result.fits[1].aicc - result.fits[0].aicc < close_call)
    warnings.push_back(options.file + ": " +
                       print("the %s and %s models fit almost alike: AICc differs by %.2g",
                             name_of(result.fits[0].model), name_of(result.fits[1].model),
                             result.fits[1].aicc - result.fits[0].aicc));
}

// A stress that does not rise leaves no viscosity to be found.
void require_rise(const FlowCurve& curve, const std::string& file) {
  constexpr double least = 1e-4;  // of the mean stress, from the first rate to the last
  const auto n = static_cast<double>(curve.rate.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < curve.rate.size(); ++k) {
    const double rate = std::log(curve.rate[k]);
    x += rate, y += curve.stress[k], xx += rate * rate, xy += rate * curve.stress[k];
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x), mean = y / n;
  const double rise = slope * std::log(curve.rate.back() / curve.rate.front());
  if (rise > least * mean) return;
  const bool falls = rise < -least * mean;
  throw InputError(
      file + ": the stress " + (falls ? "falls" : "stays the same") + " while the rate rises " +
      print("%.3g-fold, ", curve.rate.back() / curve.rate.front()) +
      (falls ? print("by %.3g %% in all: no fluid of this program does; wall slip, settling, a sample "
                     "that breaks down?",
                     -100 * rise / mean)
             : print("at %.4g Pa: that would be a yield stress of %.4g Pa with a plastic viscosity of 0, "
                     "which is not determined; wall slip, a limit of the instrument?",
                     mean, mean)) +
      " allowed: a stress that rises with the rate");
}

// Rates of the curves: as many for each factor of ten, a little beyond the measured ones.
std::vector<double> curve_rates(const std::vector<double>& measured) {
  constexpr int count = 80;
  const double low = measured.front() / 1.3, high = measured.back() * 1.1;
  std::vector<double> rates;
  for (int k = 0; k < count; ++k) rates.push_back(low * std::pow(high / low, k / (count - 1.0)));
  return rates;
}

}  // namespace

RheometryResult analyse(const Measurements& measured, const RheometryOptions& options) {
  RheometryResult result;
  result.measured = measured;
  result.warnings = result.measured.warnings;
  const FlowCurve& curve = result.measured.curve;
  const std::size_t count = curve.rate.size();
  const auto needed = static_cast<std::size_t>(points_needed(options.model.value_or(FlowModel::bingham)));
  if (count < needed)
    throw InputError(
        options.file + ": " + std::to_string(count) + " points are too few " +
        (options.model ? std::string("for the ") + name_of(*options.model) + " model" : "to choose a model") +
        ": allowed: at least " + std::to_string(needed));
  require_rise(curve, options.file);
  result.fits = fit_all(curve, options.errors);
  result.chosen = choose(result, options);
  if (result.best().flow_index.value > most_flow_index)
    throw InputError(options.file + ": the flow index is " + print("%.3g", result.best().flow_index.value) +
                     ": allowed: up to 2; the stress rises faster than that of any fluid that this program "
                     "knows: turbulence or vortices at high speed?");
  add_fit_warnings(result, options);
  return result;
}

namespace {

// Stress over the rate of a Newtonian fluid, the least and the largest.
std::string viscosities(const FlowCurve& curve) {
  double least = 1e300, most = 0;
  for (std::size_t k = 0; k < curve.rate.size(); ++k) {
    const double viscosity = curve.stress[k] / curve.cylinders->nominal_rate(curve.rate[k]);
    least = std::min(least, viscosity), most = std::max(most, viscosity);
  }
  return print("%.4g to %.4g Pa s", least, most);
}

}  // namespace

std::string to_text(const RheometryResult& result) {
  const FlowCurve& curve = result.measured.curve;
  const SampleFacts& facts = result.measured.facts;
  std::string text =
      "read as " + result.measured.how + "\n" + std::to_string(curve.rate.size()) + " points, ";
  const char* const unit = curve.cylinders ? "rad/s" : "1/s";
  text += print("%.4g to %.4g %s, %.4g to %.4g Pa", curve.rate.front(), curve.rate.back(), unit,
                curve.stress.front(), curve.stress.back());
  if (facts.spindle)
    text += " at spindle " + *facts.spindle + " of Brookfield, apparent viscosities " + viscosities(curve);
  else if (const auto& c = curve.cylinders)
    text += print(" at the bob of %.4g mm in a cup of %.4g mm, exact for the gap", 1e3 * c->bob_radius,
                  1e3 * c->cup_radius);
  text += "\nfits with 95 % intervals, best first:\n";
  for (const FlowFit& fit : result.fits) {
    text += print("%c %-17s AICc %+.2f  ", &fit == &result.best() ? '*' : ' ', name_of(fit.model),
                  fit.aicc - result.fits.front().aicc);
    std::string values;
    for (const NamedEstimate& e : estimates(fit)) values += (values.empty() ? "" : ", ") + interval(e);
    text += values + "\n";
  }
  return text;
}

std::string to_fluid_table(const RheometryResult& result, const RheometryOptions& options) {
  const FlowFit& best = result.best();
  const SampleFacts& facts = result.measured.facts;
  std::string text = first_line(std::filesystem::path(options.file).filename().string(),
                                std::to_string(result.measured.curve.rate.size()) + " points, " +
                                    (options.model ? "model as asked for" : "model chosen by AICc"));
  text += "# 95 % intervals:";
  for (const NamedEstimate& e : estimates(best)) text += " " + interval(e) + ";";
  text.back() = '\n';
  text += "[fluid." + fluid_name(facts, options.file) + "]\n" + density_line(facts);
  text += std::string("rheology = \"") + name_of(best.model) + "\"\n";
  for (const NamedEstimate& e : estimates(best))
    text += std::string(e.key) + " = " + show(rounded(e.estimate.value)) + "\n";
  if (best.model != FlowModel::newtonian) text += "growth_exponent = " + show(options.growth_exponent) + "\n";
  return text;
}

std::string to_curves(const RheometryResult& result) {
  const FlowCurve& curve = result.measured.curve;
  std::string text =
      (curve.cylinders ? "rotation_rad/s" : "shear_rate_1/s") + std::string(curves_mark) + "Pa";
  for (const FlowFit& fit : result.fits) text += std::string(",") + name_of(fit.model) + "_Pa";
  text += "\n";
  const auto add = [&](const std::vector<double>& rates, const std::vector<double>& measured) {
    std::vector<std::vector<double>> models;
    for (const FlowFit& fit : result.fits)
      models.push_back(stresses(fit.parameters(), rates, curve.cylinders));
    for (std::size_t i = 0; i < rates.size(); ++i) {
      text += print("%.9g,", rates[i]) + (measured.empty() ? "" : print("%.9g", measured[i]));
      for (const std::vector<double>& model : models) text += print(",%.9g", model[i]);
      text += "\n";
    }
  };
  add(curve.rate, curve.stress);
  add(curve_rates(curve.rate), {});
  return text;
}

namespace {

void require_no_law(const RheometryOptions& options) {
  if (options.law)
    throw InputError(options.file + ": --model " + name_of(*options.law) +
                     " is of viscosity over temperature, the readings are a flow curve: allowed: auto, "
                     "newtonian, bingham, herschel-bulkley; or --over-temperature");
  if (options.above)
    throw InputError(
        options.file +
        ": --above is of viscosity over temperature, the readings are a flow curve: allowed: with "
        "--over-temperature");
}

Answer flow_answer(const Measurements& measured, const RheometryOptions& options) {
  require_no_law(options);
  const RheometryResult result = analyse(measured, options);
  Answer answer{to_text(result), to_fluid_table(result, options), to_curves(result), result.warnings};
  if (!result.measured.facts.density)
    answer.warnings.push_back(options.file +
                              ": no density, which the fluid table needs: a line `# density_kg/m3 = ...` or "
                              "the option --density");
  return answer;
}

Answer answer_of(const RheometryOptions& options) {
  if (!options.composition.empty()) return composition_answer(options);
  if (options.phases) return phases_answer(options);
  const Measurements measured = read_measurements(options.file, options.facts);
  return measured.series.empty() ? flow_answer(measured, options) : melt_answer(measured, options);
}

}  // namespace

void run_rheometry(const RheometryOptions& options) {
  if (options.file.empty() == options.composition.empty())
    throw InputError(options.file.empty()
                         ? "rheometry: neither a file nor --composition: allowed: FILE.csv, or --composition"
                         : "rheometry: a file and --composition: allowed: FILE.csv, or --composition");
  if (options.slag_model && options.composition.empty())
    throw InputError(options.file + ": --model " + name_of(*options.slag_model) +
                     " is of a composition: allowed: with --composition");
  if (options.phases && (options.model || options.law || options.above))
    throw InputError(options.file + ": --model and --above are of readings: allowed: not with --phases");
  require_output(options.output, options.file);
  deliver(answer_of(options), options.output);
}

}  // namespace slagflow
