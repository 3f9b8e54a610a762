#include "host/rheometry/rheometry_melt.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"

namespace slagflow {
namespace {

constexpr double close_call = 2;         // AICc: a smaller difference does not tell two laws apart
constexpr double narrow = 100;           // [K] range of temperature
constexpr double beyond = 100;           // [K] below the coldest reading, where the laws are compared
constexpr double fair_difference = 0.1;  // of the viscosities there
constexpr double ice = 273.15;           // [K]

std::vector<NamedEstimate> estimates(const MeltFit& fit) {
  std::vector<NamedEstimate> all{{"A", liquid_laws[static_cast<std::size_t>(fit.law)].unit_of_a, fit.a},
                                 {"B", "K", fit.b}};
  if (fit.law == LiquidLaw::vft) all.push_back({"T0", "K", fit.t0});
  return all;
}

std::string both_scales(double kelvin) { return print("%.0f K (%.0f C)", kelvin, kelvin - ice); }

// Those that --above takes.
ViscositySeries taken(const ViscositySeries& all, const RheometryOptions& options) {
  ViscositySeries some;
  for (std::size_t k = 0; k < all.count(); ++k)
    if (all.temperature[k] >= options.above.value_or(0)) {
      some.temperature.push_back(all.temperature[k]);
      some.viscosity.push_back(all.viscosity[k]);
    }
  return some;
}

void require_readings(const ViscositySeries& series, const RheometryOptions& options) {
  const auto needed = static_cast<std::size_t>(points_needed(options.law.value_or(LiquidLaw::arrhenius)));
  if (series.count() < needed)
    throw InputError(options.file + ": " + std::to_string(series.count()) + " readings" +
                     (options.above ? print(" above %.6g K", *options.above) : "") + " are too few " +
                     (options.law ? std::string("for the law ") + name_of(*options.law) : "to choose a law") +
                     ": allowed: at least " + std::to_string(needed) +
                     "; or liquid_viscosity = [[temperature in K, viscosity], ...] in the case");
  const double mean = [&] {
    double sum = 0;
    for (const double t : series.temperature) sum += 1 / t;
    return sum / static_cast<double>(series.count());
  }();
  double slope = 0, spread = 0;
  for (std::size_t k = 0; k < series.count(); ++k) {
    slope += (1 / series.temperature[k] - mean) * std::log(series.viscosity[k]);
    spread += (1 / series.temperature[k] - mean) * (1 / series.temperature[k] - mean);
  }
  if (!(spread > 0) || !(slope > 0))
    throw InputError(
        options.file +
        ": the viscosity does not fall while the temperature rises: allowed: one that falls; are "
        "the columns and units right, or is it a flow curve whose temperature drifts?");
}

std::size_t choose(const MeltResult& result, const RheometryOptions& options) {
  std::string others;
  for (const MeltFit& one : result.fits) others += std::string(", ") + name_of(one.law);
  if (result.fits.empty())
    throw InputError(options.file +
                     ": no law of temperature fits the readings: allowed: liquid_viscosity = "
                     "[[temperature in K, viscosity], ...] in the case");
  if (!options.law) return 0;
  const auto found = std::find_if(result.fits.begin(), result.fits.end(),
                                  [&](const MeltFit& one) { return one.law == *options.law; });
  if (found == result.fits.end())
    throw InputError(options.file + ": the law " + name_of(*options.law) +
                     " fits with no constants that a case allows: allowed: auto" + others);
  return static_cast<std::size_t>(found - result.fits.begin());
}

bool is_infinite(const MeltFit& one, double temperature) {
  return one.law == LiquidLaw::vft && one.t0.value > temperature - 1;
}

// Largest over least viscosity of the laws at a temperature.
double disagreement(const MeltResult& result, double temperature) {
  double least = 1e300, most = 0;
  for (const MeltFit& one : result.fits) {
    if (is_infinite(one, temperature)) continue;
    least = std::min(least, one.viscosity(temperature)), most = std::max(most, one.viscosity(temperature));
  }
  return most / least;
}

void warn_of_kink(MeltResult& result, const RheometryOptions& options) {
  if (!result.kink) return;
  result.warnings.push_back(
      options.file + ": from " + both_scales(result.kink->temperature) +
      print(" down the viscosity rises above the trend of the hotter readings, %.3g-fold at the coldest: "
            "crystals? The law is meant for the liquid: --above %.0f leaves the colder readings out, "
            "solid_fraction with suspension says what crystals do",
            result.kink->excess, std::floor(result.kink->temperature)));
}

void add_warnings(MeltResult& result, const RheometryOptions& options) {
  const auto warn = [&](const std::string& what) { result.warnings.push_back(options.file + ": " + what); };
  const std::vector<double>& t = result.series.temperature;
  const double range = t.back() - t.front();
  warn_of_kink(result, options);
  if (range < narrow)
    warn(print("the readings are over %.3g K alone: B and what is outside of them are guesses", range));
  const auto count = static_cast<int>(result.series.count());
  if (!options.law && count < points_needed(LiquidLaw::vft))
    warn(print("%d readings are too few to try the law vft: allowed: at least %d", count,
               points_needed(LiquidLaw::vft)));
  const MeltFit& best = result.best();
  if (best.b.low <= 0) warn(print("the interval of B, %.4g to %.4g K, reaches 0", best.b.low, best.b.high));
  if (best.law == LiquidLaw::vft && best.t0.low <= 0)
    warn(print("the interval of T0, %.4g to %.4g K, reaches 0: the readings do not tell it", best.t0.low,
               best.t0.high));
  if (!options.law && result.fits.size() > 1 && result.fits[1].aicc - result.fits[0].aicc < close_call &&
      disagreement(result, t.front() - beyond) > 1 + fair_difference)
    warn(print(
        "the laws %s and %s fit almost alike: AICc differs by %.2g; 100 K below the readings all laws "
        "differ by %.2g %%",
        name_of(result.fits[0].law), name_of(result.fits[1].law), result.fits[1].aicc - result.fits[0].aicc,
        100 * (disagreement(result, t.front() - beyond) - 1)));
}

std::string to_text(const MeltResult& result, const Measurements& measured) {
  const ViscositySeries& s = result.series;
  std::string text = "read as " + measured.how + "\n" + std::to_string(s.count()) +
                     " readings over temperature, " + both_scales(s.temperature.front()) + " to " +
                     both_scales(s.temperature.back()) +
                     print(", %.4g to %.4g Pa s", s.viscosity.front(), s.viscosity.back());
  text += "\nfits of ln viscosity with 95 % intervals, best first:\n";
  for (const MeltFit& one : result.fits) {
    text += print("%c %-10s AICc %+.2f  ", &one == &result.best() ? '*' : ' ', name_of(one.law),
                  one.aicc - result.fits.front().aicc);
    std::string values;
    for (const NamedEstimate& e : estimates(one)) values += (values.empty() ? "" : ", ") + interval(e);
    text += values + print("; off by %.2g %%\n", 100 * std::expm1(one.residual));
  }
  text += "Outside of " + both_scales(s.temperature.front()) + " to " + both_scales(s.temperature.back()) +
          " they are extrapolated: ";
  const double t = s.temperature.front() - beyond;
  if (is_infinite(result.best(), t))
    return text + "the chosen law is infinite at " + both_scales(result.best().t0.value) + ".\n";
  return text + "at " + both_scales(t) +
         print(" %.4g Pa s by the chosen, the laws differ by %.2g %%.\n", result.best().viscosity(t),
               100 * (disagreement(result, t) - 1));
}

std::string to_table(const MeltResult& result, const Measurements& measured,
                     const RheometryOptions& options) {
  const std::vector<double>& t = result.series.temperature;
  std::string text = first_line(std::filesystem::path(options.file).filename().string(),
                                std::to_string(t.size()) + " readings over temperature, " +
                                    (options.law ? "law as asked for" : "law chosen by AICc"));
  text += "# 95 % intervals:";
  for (const NamedEstimate& e : estimates(result.best())) text += " " + interval(e) + ";";
  text.back() = '\n';
  text += "# Measured from " + both_scales(t.front()) + " to " + both_scales(t.back()) +
          ". For a case with [thermal].\n";
  if (result.kink)
    text += "# From " + both_scales(result.kink->temperature) +
            " down they are above the trend of the liquid, crystals?, and in the law all the same.\n";
  return text + melt_table(fluid_name(measured.facts, options.file), measured.facts, result.best().liquid());
}

std::string to_curves(const MeltResult& result) {
  constexpr int count = 80;
  const ViscositySeries& s = result.series;
  std::string text = std::string("temperature_K") + curves_mark + "Pas";
  for (const MeltFit& one : result.fits) text += std::string(",") + name_of(one.law) + "_Pas";
  text += "\n";
  const auto add = [&](double t, const std::string& measured) {
    text += print("%.9g,", t) + measured;
    for (const MeltFit& one : result.fits) text += print(",%.9g", one.viscosity(t));
    text += "\n";
  };
  for (std::size_t k = 0; k < s.count(); ++k) add(s.temperature[k], print("%.9g", s.viscosity[k]));
  const double low = s.temperature.front(), high = s.temperature.back(), margin = 0.1 * (high - low);
  for (int k = 0; k < count; ++k) add(low - margin + (high - low + 2 * margin) * k / (count - 1.0), "");
  return text;
}

}  // namespace

MeltResult analyse_melt(const Measurements& measured, const RheometryOptions& options) {
  if (options.model)
    throw InputError(options.file + ": --model " + name_of(*options.model) +
                     " is of a flow curve, the readings are over temperature: allowed: auto, arrhenius, "
                     "weymann, vft");
  MeltResult result;
  result.series = taken(measured.series, options);
  result.warnings = measured.warnings;
  require_readings(result.series, options);
  result.fits = fit_all(result.series);
  result.chosen = choose(result, options);
  result.kink = find_kink(result.series, result.fits);
  add_warnings(result, options);
  if (!measured.facts.density)
    result.warnings.push_back(options.file +
                              ": no density, which the fluid table needs: a line `# density_kg/m3 = ...` or "
                              "the option --density");
  return result;
}

Answer melt_answer(const Measurements& measured, const RheometryOptions& options) {
  const MeltResult result = analyse_melt(measured, options);
  return {to_text(result, measured), to_table(result, measured, options), to_curves(result), result.warnings};
}

std::string melt_table(const std::string& name, const SampleFacts& facts, const LiquidViscosity& liquid) {
  std::string text = "[fluid." + name + "]\n" + density_line(facts) + "rheology = \"newtonian\"\n";
  text += std::string("liquid_viscosity = {law = \"") + name_of(liquid.law) +
          "\", A = " + show(rounded(liquid.a)) + ", B = " + show(rounded(liquid.b)) +
          (liquid.law == LiquidLaw::vft ? ", T0 = " + show(rounded(liquid.t0)) : "") + "}\n";
  return text +
         "# heat_capacity = ...  # [J/kg K] must be added, rows over temperature or a number\n"
         "# conductivity = ...  # [W/m K] must be added\n";
}

}  // namespace slagflow
