// What single precision holds of the fluids of a case.
#include <cmath>
#include <cstdio>

#include "host/case/case_rules.hpp"

namespace slagflow {
namespace {

double value_of(const FluidSpec& fluid, const std::string& key) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(fluid.info().parameter_count); ++k)
    if (fluid.info().parameters[k].key == key) return fluid.parameters[k];
  return 0;
}

std::string rounded(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// A viscosity at rest [Pa s], and the key that it is raised by.
struct AtRest {
  double viscosity = 0;
  std::string key;
};

// Of the two parts of a fluid with a yield stress the larger is told.
AtRest with_yield(const FluidSpec& fluid, double own, const char* key) {
  const double growth = value_of(fluid, "growth_exponent") * value_of(fluid, "yield_stress");
  return {own + growth, growth > own ? "growth_exponent" : key};
}

AtRest at_rest(const FluidSpec& fluid) {
  const auto of = [&](const char* key) { return value_of(fluid, key); };
  switch (fluid.rheology) {
    case RheologyKind::newtonian:
      return {of("dynamic_viscosity"), "dynamic_viscosity"};
    case RheologyKind::bingham:
      return with_yield(fluid, of("plastic_viscosity"), "plastic_viscosity");
    case RheologyKind::herschel_bulkley:
      return with_yield(
          fluid, of("consistency") * std::pow(of("growth_exponent"), 1 - of("flow_index")),
          of("growth_exponent") > 1 && of("flow_index") < 1 ? "growth_exponent" : "consistency");
    case RheologyKind::casson: {
      AtRest rest = with_yield(fluid, of("casson_viscosity"), "casson_viscosity");
      rest.viscosity += 2 * std::sqrt(of("casson_viscosity") * of("growth_exponent") * of("yield_stress"));
      return rest;
    }
    case RheologyKind::biviscous:
      return {of("plastic_viscosity") * of("viscosity_ratio"), "plastic_viscosity"};
    case RheologyKind::carreau_yasuda: {
      const bool fast = of("infinite_shear_viscosity") > of("zero_shear_viscosity");
      const char* const key = fast ? "infinite_shear_viscosity" : "zero_shear_viscosity";
      return {of(key), key};
    }
  }
  return {};
}

}  // namespace

void check_fluids(const Case& c, CaseProblems& problems) {
  constexpr double most = 1e12;  // [Pa s]
  for (const FluidSpec& fluid : c.fluids) {
    const std::string table = "fluid." + fluid.name;
    if (!problems.fine_within(table)) continue;
    const AtRest rest = at_rest(fluid);
    if (rest.viscosity <= most) continue;
    problems.add(table + "." + rest.key,
                 "value " + show(value_of(fluid, rest.key)) + " gives a viscosity of " +
                     rounded(rest.viscosity) +
                     " Pa s, beyond what single precision computes with: allowed: " +
                     (rest.key == "growth_exponent" && value_of(fluid, "yield_stress") > 0
                          ? "less growth_exponent or yield_stress, so that it is "
                          : "a value with which it is ") +
                     "<= " + show(most) + " [Pa s]");
  }
}

}  // namespace slagflow
