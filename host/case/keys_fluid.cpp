// [fluid.NAME]: a density and a rheology, or a liquid with solids in it.
#include "host/case/case_keys.hpp"
#include "host/case/case_rules.hpp"
#include "host/case/keys_thermal.hpp"
#include "host/case/suspension.hpp"

namespace slagflow {
namespace {

// Of a gas to more than any solid.
Range densities() { return between(1e-3, 1e6, "kg/m^3"); }

template <class Infos>
Words names_of(const Infos& infos) {
  Words names;
  for (const auto& info : infos) names.push_back(info.name);
  return names;
}

void describe_suspension(CaseVisitor& v, SuspensionSpec& s) {
  const bool law = describe_suspension_law(v, s.law, true);
  const bool fraction = v.number(required("solid_fraction", "φ, of the volume, below φ_c"), s.solid_fraction,
                                 law ? fractions(s.law) : between(0, 1, ""));
  const bool liquid =
      v.number(required("liquid_density", "density of the mixture: (1 − φ) liquid_density + φ solid_density"),
               s.liquid_density, densities());
  const bool solid = v.number(required("solid_density", "of the solids alone"), s.solid_density, densities());
  const bool viscous = v.number(required("liquid_viscosity",
                                         "η₀: the viscosity of the rheology becomes η₀ times the "
                                         "relative viscosity of the law"),
                                s.liquid_viscosity, above(0, "Pa s"));
  s.complete = law && fraction && liquid && solid && viscous;
}

// A number, or in a suspension rows over the solid fraction.
void describe_yield_stress(CaseVisitor& v, const Key& k, double& value, const SuspensionSpec* suspension) {
  const Range range = at_least(0, "Pa");
  if (!suspension && v.given({k.name})) {
    v.number(k, value, range);
    return;
  }
  YieldRows rows;
  if (!v.number_or_rows(k, value, range, rows, yield_rows_allowed) || rows.empty()) return;
  const std::string fault = fault_of(rows, *suspension);
  if (!fault.empty())
    v.problem(k.name, fault);
  else if (suspension->complete)
    value = yield_stress_at(suspension->solid_fraction, rows);
}

// The same where heat sets the solid fraction.
void describe_yield_stress(CaseVisitor& v, const Key& k, double& value, MaterialSetup& m) {
  const Range range = at_least(0, "Pa");
  YieldRows rows = m.yield_stress;
  if (!v.number_or_rows(k, value, range, rows, yield_rows_allowed)) return;
  m.yield_stress = rows;
  const std::string fault = fault_of(rows);
  if (!fault.empty())
    v.problem(k.name, fault);
  else if (!rows.empty() && m.solid_fraction.empty() && !v.given({"solid_fraction", "freezing"}))
    v.problem(k.name,
              "rows over the solid fraction without solids: allowed: a number, or solid_fraction too");
  else if (!rows.empty() && m.suspended && rows.back()[0] < most_fraction(m.suspension))
    v.problem(k.name, "the table ends at the solid fraction " + show(rows.back()[0]) +
                          ": allowed: rows up to where nothing flows any more, " +
                          show(most_fraction(m.suspension)));
}

// The viscosity that the solids raise is that of the liquid times the relative viscosity.
void describe_viscosity(CaseVisitor& v, const Key& k, double& value, const Range& range,
                        const SuspensionSpec* suspension) {
  if (const auto with = v.only(!suspension, {"no suspension"}, "a suspension has liquid_viscosity instead"))
    v.number(k, value, range);
  if (!suspension || !suspension->complete) return;
  value = suspension->viscosity();
  if (!range.holds(value))
    v.problem("solid_fraction", "value " + show(suspension->solid_fraction) + " gives the parameter '" +
                                    k.name + "' the value " + show(value) + ": allowed: " + range.text());
}

// What a fluid is, besides a rheology: solids in it, or a material whose temperature sets them.
struct Makeup {
  const SuspensionSpec* suspension;
  MaterialSetup* material;  // null without heat
};

void describe_parameter(CaseVisitor& v, const ParameterInfo& info, double& value, const Makeup& of) {
  Key k = key(info.key, info.meaning);
  if (info.fallback < 0) k.need = Need::required;
  if (v.takes_defaults()) value = info.fallback;
  const bool by_heat = of.material && has_liquid_viscosity(v, *of.material);
  if (info.role == ParameterRole::viscosity && by_heat) return;
  if (info.role == ParameterRole::viscosity)
    describe_viscosity(v, k, value, range_of(info), of.suspension);
  else if (info.role == ParameterRole::yield_stress && of.material)
    describe_yield_stress(v, k, value, *of.material);
  else if (info.role == ParameterRole::yield_stress)
    describe_yield_stress(v, k, value, of.suspension);
  else
    v.number(k, value, range_of(info));
}

void describe_rheology(CaseVisitor& v, FluidSpec& fluid, const Makeup& of) {
  if (!v.choice(required("rheology", "how viscosity depends on the shear rate, see Rheologies"),
                fluid.rheology, names_of(rheologies)))
    return;
  for (const RheologyInfo& info : rheologies) {
    if (const auto with = v.only(&fluid.info() == &info, {"rheology", {info.name}}))
      for (int k = 0; k < info.parameter_count; ++k)
        describe_parameter(v, info.parameters[k], fluid.parameters[static_cast<std::size_t>(k)], of);
  }
}

void describe_fluid(CaseVisitor& v, const Case& c, FluidSpec& fluid) {
  if (!is_plain_name(fluid.name) || fluid.name.find('.') != std::string::npos)
    v.problem("", "the name of a fluid: allowed: up to 100 of letters, digits, _ -");
  const bool heat = c.thermal.on;
  const bool suspended = !heat && v.given({"solid_fraction", "suspension", "liquid_density", "solid_density",
                                           "liquid_viscosity", "critical_fraction", "exponent"});
  SuspensionSpec suspension;
  if (const auto with =
          v.only(!suspended, {"no suspension"}, "a suspension has liquid_density and solid_density instead"))
    v.number(required("density", "at rest; of a suspension its own keys instead"), fluid.density,
             densities());
  if (const auto with = v.only(suspended, {"a suspension"})) describe_suspension(v, suspension);
  if (suspended) fluid.density = suspension.density();
  v.number(key("surface_tension", "σ in (20); 0: none. See Surface tension"), fluid.surface_tension,
           at_least(0, "N/m"));
  if (const auto with = v.only(heat, {"[thermal]"})) describe_material(v, fluid.material);
  describe_rheology(v, fluid, {suspended ? &suspension : nullptr, heat ? &fluid.material : nullptr});
}

}  // namespace

// The law and its constants. False where they are not known.
bool describe_suspension_law(CaseVisitor& v, Suspension& law, bool needed) {
  Key which = key("suspension", "law of the relative viscosity, see Suspensions");
  if (needed)
    which.need = Need::required;
  else
    which.fallback = "none";
  const bool known = v.choice(which, law.law, names_of(suspension_laws));
  if (!known) return false;
  bool fine = true;
  const auto constant = [&](const Key& k, double& value, double upper) {
    if (!v.number(k, value, above_to(0, upper, "")) && v.given({k.name})) fine = false;
  };
  if (v.takes_defaults()) law.critical_fraction = law.info().critical_fraction;
  Words critical;
  for (const SuspensionInfo& info : suspension_laws)
    if (info.critical_fraction > 0) critical.push_back(info.name);
  if (const auto with = v.only(law.critical_fraction > 0, {"suspension", critical}))
    constant(key("critical_fraction", "φ_c, at which nothing flows any more").by_default("of the law"),
             law.critical_fraction, 1);
  if (const auto with =
          v.only(law.law == SuspensionLaw::einstein_roscoe, {"suspension", {"einstein-roscoe"}}))
    constant(key("exponent", "n of the law"), law.exponent, 10);
  return fine;
}

void describe_fluids(CaseVisitor& v, Case& c) {
  v.named_list(required("fluid", "one or more fluids"), c.fluids,
               [&](FluidSpec& f) { describe_fluid(v, c, f); });
  check_count(v, "fluid", c.fluids.size());
}

}  // namespace slagflow
