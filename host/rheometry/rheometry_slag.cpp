#include "host/rheometry/rheometry_slag.hpp"

#include <cmath>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_melt.hpp"

namespace slagflow {
namespace {

constexpr double ice = 273.15;                               // [K]
constexpr double coldest = 1300, hottest = 1650, step = 50;  // [C] that are shown
constexpr double compared_at = 1500;                         // [C]

struct Models {
  LiquidViscosity urbain, riboud;

  const LiquidViscosity& of(SlagModel model) const { return model == SlagModel::urbain ? urbain : riboud; }
};

double viscosity(const LiquidViscosity& liquid, double celsius) {
  return std::exp(log_liquid_viscosity(liquid, celsius + ice));
}

// Riboud's where the slag is of the kind that it was made for.
SlagModel choose(const Composition& c, const RheometryOptions& options) {
  if (options.slag_model) return *options.slag_model;
  return outside_range(SlagModel::riboud, c).empty() ? SlagModel::riboud : SlagModel::urbain;
}

std::string shares(const Composition& c, bool mole) {
  std::string text;
  for (std::size_t k = 0; k < slag_components.size(); ++k) {
    const double share = 100 * (mole ? c.mole : c.mass)[k];
    if (share > 0)
      text += (text.empty() ? "" : ", ") + std::string(slag_components[k].name) + print(" %.4g", share);
  }
  return text;
}

std::string text_of(const Composition& c, const Models& models, SlagModel chosen) {
  std::string text = "mass %: " + shares(c, false) + "\nmole %: " + shares(c, true) + "\n";
  text += "liquid slag, A T exp(B/T):\n";
  for (const SlagModel model : slag_models)
    text += print("%c %-8s A %.4g Pa s/K, B %.0f K  %s\n", model == chosen ? '*' : ' ', name_of(model),
                  models.of(model).a, models.of(model).b,
                  model == SlagModel::urbain
                      ? "made for SiO2-Al2O3 with CaO, MgO, MnO; others by likeness"
                      : "made for mould powders: mass % SiO2 27 to 56, CaO 8 to 46, Al2O3 0 "
                        "to 12, alkali 0 to 22, CaF2 0 to 18");
  text += "    T [C]    T [K]   urbain [Pa s]   riboud [Pa s]   urbain/riboud\n";
  for (double t = coldest; t <= hottest; t += step) {
    const double u = viscosity(models.urbain, t), r = viscosity(models.riboud, t);
    text += print("%9.0f%9.0f%16.4g%16.4g%16.2f\n", t, t + ice, u, r, u / r);
  }
  return text +
         "Both hold for liquid slag only, above a liquidus that they do not know, and to some 30 % at "
         "best.\n";
}

void add_warnings(const Composition& c, const Models& models, const RheometryOptions& options,
                  std::vector<std::string>& warnings) {
  constexpr double fair_total = 2, close = 1.5;
  if (std::abs(c.total - 100) > fair_total && std::abs(c.total - 1) > fair_total / 100)
    warnings.push_back(print("composition: the sum is %.4g %%: it is scaled to 100 %%", c.total));
  for (const SlagModel model : slag_models)
    for (const std::string& what : outside_range(model, c))
      warnings.push_back(std::string("composition: ") + name_of(model) + ": " + what);
  const double u = viscosity(models.urbain, compared_at), r = viscosity(models.riboud, compared_at);
  if (std::abs(std::log(u / r)) > std::log(close))
    warnings.push_back(
        print("composition: at %.0f C the models give %.3g and %.3g Pa s, a factor of %.2g "
              "apart: measure it, or run both",
              compared_at, u, r, std::exp(std::abs(std::log(u / r)))));
  if (!options.facts.density)
    warnings.push_back("composition: no density, which the fluid table needs: the option --density");
}

std::string curves(const Models& models, SlagModel chosen) {
  const SlagModel other = chosen == SlagModel::urbain ? SlagModel::riboud : SlagModel::urbain;
  std::string text = std::string("temperature_K") + curves_mark + "Pas," + name_of(chosen) + "_Pas," +
                     name_of(other) + "_Pas\n";
  for (double t = coldest; t <= hottest; t += step / 5)
    text +=
        print("%.2f,,%.6g,%.6g\n", t + ice, viscosity(models.of(chosen), t), viscosity(models.of(other), t));
  return text;
}

}  // namespace

Answer composition_answer(const RheometryOptions& options) {
  if (options.model || options.law)
    throw InputError(std::string("--model ") +
                     (options.model ? name_of(*options.model) : name_of(*options.law)) +
                     " with --composition: allowed: auto, urbain, riboud");
  const Composition c = parse_composition(options.composition, options.mole);
  const Models models{slag_viscosity(SlagModel::urbain, c), slag_viscosity(SlagModel::riboud, c)};
  const SlagModel chosen = choose(c, options);
  Answer answer;
  answer.text = text_of(c, models, chosen);
  answer.table =
      first_line("Composition in mass %, " + shares(c, false),
                 std::string(name_of(chosen)) + " model" + (options.slag_model ? ", as asked for" : "")) +
      "# Liquid slag only. For a case with [thermal].\n" +
      melt_table(fluid_name(options.facts, "slag"), options.facts, models.of(chosen));
  answer.curves = curves(models, chosen);
  add_warnings(c, models, options, answer.warnings);
  return answer;
}

}  // namespace slagflow
