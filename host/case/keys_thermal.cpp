// [thermal], and what fluids and walls of a case with heat have besides.
#include "host/case/keys_thermal.hpp"

#include <cmath>
#include <limits>

#include "host/case/case_rules.hpp"
#include "host/case/suspension.hpp"

namespace slagflow {
namespace {

const char* const property_rows =
    "rows [temperature in K, value], the temperatures rising, linear between rows, constant beyond";
const char* const fraction_rows =
    "rows [temperature in K, solid fraction], the temperatures rising, the fraction falling from 1 to 0";
const Words wall_heats{"adiabatic", "temperature", "flux", "semi_infinite"};
const char* const heat_is_off = "heat is off: a table [thermal] switches it on";
const Words freezing_laws{"lever", "scheil"};

Words formula_laws() {
  Words names;
  for (const LiquidLawInfo& law : liquid_laws)
    if (*law.unit_of_a) names.push_back(law.name);
  return names;
}

std::string row_text(const std::array<double, 2>& row) {
  return "row [" + show(row[0]) + ", " + show(row[1]) + "]";
}

Range temperatures() {
  Range range = between(200, 4000, "K");
  range.doubt = "kelvin, not degrees Celsius?";
  return range;
}

// What is wrong with a temperature; empty: nothing.
std::string temperature_fault(double t) {
  const Range allowed = temperatures();
  if (allowed.holds(t)) return "";
  return "a temperature of " + show(t) + " K; " + allowed.doubt + " allowed: " + allowed.text_for(t);
}

// Rows over temperature; `level`: whether two may have the same.
std::string order_fault(const ValueRows& rows, bool level, const char* allowed) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::string fault = temperature_fault(rows[k][0]);
    if (!fault.empty()) return row_text(rows[k]) + ": " + fault;
    if (k > 0 && !(rows[k][0] > rows[k - 1][0] || (level && rows[k][0] == rows[k - 1][0])))
      return row_text(rows[k]) + " follows " + row_text(rows[k - 1]) + ": allowed: " + allowed;
  }
  return "";
}

// A number, or rows over temperature.
bool describe_property(CaseVisitor& v, const Key& k, const Range& range, ValueRows& rows) {
  constexpr double anywhere = 298.15;
  double value = rows.size() == 1 ? rows[0][1] : 0;
  ValueRows table = rows.size() > 1 ? rows : ValueRows{};
  if (!v.number_or_rows(k, value, range, table, property_rows)) return false;
  if (table.empty()) {
    rows = {{anywhere, value}};
    return true;
  }
  const std::string fault = order_fault(table, false, property_rows);
  if (!fault.empty()) return v.problem(k.name, fault), false;
  for (const auto& row : table)
    if (!range.holds(row[1]))
      return v.problem(k.name, row_text(row) + " is out of range: allowed: values " + range.text()), false;
  rows = table;
  return true;
}

// One more kind of value for a key: {law = ..., A = ..., B = ...}.
void describe_formula(CaseVisitor& v, LiquidViscosity& liquid) {
  const Words names = formula_laws();
  int index = std::max(0, static_cast<int>(liquid.law) - 1);
  if (!v.choice(required("law", "arrhenius: A exp(B/T), weymann: A T exp(B/T), vft: A exp(B/(T − T0))"),
                index, names))
    return;
  liquid.law = static_cast<LiquidLaw>(index + 1);
  const bool vft = liquid.law == LiquidLaw::vft;
  v.number(required("A", "in Pa s; of weymann in Pa s/K"), liquid.a, above(0, "Pa s or Pa s/K"));
  v.number(required("B", "of the exponential"), liquid.b, above_to(0, 1e6, "K"));
  if (const auto with = v.only(vft, {"law", {"vft"}}))
    v.number(required("T0", "at which the viscosity would be infinite"), liquid.t0, between(0, 4000, "K"));
}

void describe_liquid(CaseVisitor& v, const Key& k, LiquidViscosity& liquid) {
  const bool written = !v.takes_defaults();
  const bool by_formula =
      written ? liquid.law >= LiquidLaw::arrhenius && liquid.law <= LiquidLaw::vft : v.is_table(k.name);
  const bool absent = written && liquid.law == LiquidLaw::constant && !(liquid.a > 0);
  if (const auto with = v.only(!by_formula && !absent, {"a number, or rows over temperature"})) {
    ValueRows rows = liquid.law == LiquidLaw::table ? liquid.rows : ValueRows{};
    if (rows.empty() && liquid.a > 0) rows = {{298.15, liquid.a}};
    if (describe_property(v, k, above(0, "Pa s"), rows)) {
      liquid = {};
      if (rows.size() == 1)
        liquid.a = rows[0][1];
      else
        liquid.law = LiquidLaw::table, liquid.rows = rows;
    }
  }
  if (const auto with = v.only(by_formula, {"a law of temperature"}))
    v.inline_table(k, [&] { describe_formula(v, liquid); });
}

// From a phase diagram with straight lines.
struct Freezing {
  int law = 0;
  double liquidus = 0, solvent = 0, partition = 0, eutectic = 0;  // [K], [K], 1, [K]
};

// (H2): lever rule, or Scheil's with what is left freezing at the eutectic.
ValueRows freezing_rows(const Freezing& f) {
  constexpr int steps = 64;
  const double span = f.solvent - f.liquidus, slope = 1 - f.partition;
  const double solidus = f.law == 0 ? f.solvent - span / f.partition : f.eutectic;
  ValueRows rows;
  for (int k = 0; k <= steps; ++k) {
    const double t = solidus + (f.liquidus - solidus) * k / steps;
    const double below = f.solvent - t;
    const double phi =
        f.law == 0 ? (f.liquidus - t) / (slope * below) : 1 - std::pow(below / span, -1 / slope);
    rows.push_back({t, k == steps ? 0.0 : std::fmin(1, phi)});
  }
  if (f.law == 0)
    rows.front()[1] = 1;
  else
    rows.insert(rows.begin(), {solidus, 1.0});
  return rows;
}

void describe_freezing(CaseVisitor& v, MaterialSetup& m) {
  Freezing f;
  bool fine =
      v.choice(required("law", "lever: solids and liquid in equilibrium; scheil: solids stay as they froze"),
               f.law, freezing_laws);
  const auto temperature = [&](const Key& k, double& t) { fine = describe_temperature(v, k, t) && fine; };
  temperature(required("liquidus", "where it begins to freeze"), f.liquidus);
  temperature(required("solvent_melting_point", "of the pure solid, above the liquidus"), f.solvent);
  fine = v.number(required("partition", "solute in the solid over that in the liquid"), f.partition,
                  inside(0, 1, "")) &&
         fine;
  if (const auto with = v.only(f.law == 1, {"law", {"scheil"}}))
    temperature(required("eutectic", "where the rest freezes, below the liquidus"), f.eutectic);
  if (!fine) return;
  if (!(f.solvent > f.liquidus) || (f.law == 1 && !(f.eutectic < f.liquidus)))
    return v.problem("liquidus", "value " + show(f.liquidus) +
                                     ": allowed: below solvent_melting_point, above eutectic [K]");
  m.solid_fraction = freezing_rows(f);
  const std::string fault = order_fault(m.solid_fraction, true, fraction_rows);
  if (!fault.empty()) v.problem("liquidus", "gives " + fault);
}

std::string fraction_fault(const ValueRows& rows) {
  std::string fault = order_fault(rows, true, fraction_rows);
  if (!fault.empty()) return fault;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!(rows[k][1] >= 0 && rows[k][1] <= 1) || (k > 0 && rows[k][1] > rows[k - 1][1]))
      return row_text(rows[k]) + " is out of range or order: allowed: " + fraction_rows;
  if (rows.size() < 2 || rows.front()[1] != 1 || rows.back()[1] != 0)
    return "does not fall from 1 to 0: allowed: " + std::string(fraction_rows);
  return "";
}

void describe_solids(CaseVisitor& v, MaterialSetup& m) {
  const bool by_law = v.takes_defaults() && v.given({"freezing"});
  if (!v.takes_defaults() && m.solid_fraction.empty()) return;
  if (v.pairs(key("solid_fraction", std::string("φ(T), as of thermodynamics software: ") + fraction_rows +
                                        "; two rows at one temperature: it freezes there")
                  .by_default("none: it stays liquid"),
              m.solid_fraction, fraction_rows)) {
    const std::string fault = fraction_fault(m.solid_fraction);
    if (!fault.empty()) v.problem("solid_fraction", fault);
    if (by_law) v.problem("freezing", "stands beside solid_fraction: allowed: one of them");
  }
  if (v.takes_defaults())
    v.inline_table(key("freezing", "in place of solid_fraction: by a phase diagram with straight lines")
                       .by_default("none")
                       .shorthand(),
                   [&] { describe_freezing(v, m); });
}

void check_material(CaseVisitor& v, const MaterialSetup& m) {
  if (v.given({"solid_fraction"}) || v.given({"freezing"})) return;  // be it right or wrong
  if (m.latent_heat > 0 && m.solid_fraction.empty())
    v.problem("latent_heat",
              "value " + show(m.latent_heat) +
                  " without solids: allowed: 0, or solid_fraction, which tells when it is freed");
  if (m.suspended && m.solid_fraction.empty())
    v.problem("suspension", "without solids: allowed: together with solid_fraction");
}

}  // namespace

bool describe_temperature(CaseVisitor& v, const Key& k, double& value) {
  return v.number(k, value, temperatures());
}

void describe_start_temperature(CaseVisitor& v, const Case& c, const Key& k, double& value) {
  if (const auto with = v.only(c.thermal.on, {"[thermal]"}, heat_is_off)) describe_temperature(v, k, value);
}

void describe_thermal(CaseVisitor& v, Case& c) {
  ThermalSetup& t = c.thermal;
  if (v.takes_defaults()) t.on = v.given({"thermal"}), t.ambient_temperature = 298.15, t.radiation = true;
  if (!v.takes_defaults() && !t.on) return;
  v.table(key("thermal", "its presence switches heat on, see Heat"), [&] {
    describe_temperature(v, key("ambient_temperature", "of the surroundings, for convection and radiation"),
                         t.ambient_temperature);
    v.number(key("surface_heat_transfer", "h of convection at free surfaces in (H7)"),
             t.surface_heat_transfer, at_least(0, "W/m^2 K"));
    v.flag(key("radiation", "of free surfaces of fluids with an emissivity"), t.radiation);
    v.flag(key("viscous_heating", "(H8); off: slag warms by it by less than a kelvin an hour"),
           t.viscous_heating);
    v.number(key("flow_until",
                 "from then on nothing moves, no wall and no inlet either, and steps are as long as "
                 "conduction allows: for "
                 "minutes and hours of cooling after seconds of flow")
                 .or_word("end_time", std::numeric_limits<double>::infinity()),
             t.flow_until, at_least(0, "s"));
  });
}

// Whether the fluid's own viscosity is given by liquid_viscosity.
bool has_liquid_viscosity(const CaseVisitor& v, const MaterialSetup& m) {
  return v.takes_defaults() ? v.given({"liquid_viscosity"})
                            : m.liquid.law != LiquidLaw::constant || m.liquid.a > 0;
}

void describe_material(CaseVisitor& v, MaterialSetup& m) {
  describe_property(
      v, required("heat_capacity", "c(T), without latent heat: a number, or rows over temperature"),
      above(0, "J/kg K"), m.heat_capacity);
  describe_property(
      v, required("conductivity", "k(T), with internal radiation: a number, or rows over temperature"),
      above(0, "W/m K"), m.conductivity);
  describe_solids(v, m);
  v.number(key("latent_heat", "L, freed as φ goes from 0 to 1; 0 for slag that turns to glass"),
           m.latent_heat, at_least(0, "J/kg"));
  v.number(key("emissivity", "ε of the free surface; 0: it does not radiate"), m.emissivity,
           between(0, 1, ""));
  v.number(key("max_viscosity", "η_max: of solid fluid, and the most of any"), m.max_viscosity,
           between(1, 1e9, "Pa s"));
  describe_liquid(
      v,
      key("liquid_viscosity",
          "η_l(T), in place of the viscosity of the rheology: a number, rows over temperature (ln η "
          "linear in 1/T), or {law, A, B}")
          .by_default("the rheology's own"),
      m.liquid);
  if (v.takes_defaults()) m.suspended = v.given({"suspension"});
  if (v.takes_defaults() || m.suspended) describe_suspension_law(v, m.suspension, m.suspended);
  check_material(v, m);
}

void describe_wall_heat(CaseVisitor& v, const Case& c, WallSpec& wall) {
  WallThermal& t = wall.thermal;
  if (const auto on = v.only(c.thermal.on, {"[thermal]"}, heat_is_off))
    if (!v.choice(key("thermal",
                      "adiabatic; at a temperature; with a flux; semi_infinite: thick, it takes up heat"),
                  t.kind, wall_heats))
      return;
  const auto on = v.only(c.thermal.on, {"[thermal]"});
  if (!on) return;
  const bool held = t.kind == WallHeat::temperature, thick = t.kind == WallHeat::semi_infinite;
  if (const auto with = v.only(held || thick, {"thermal", {"temperature", "semi_infinite"}})) {
    describe_temperature(v, required("temperature", "held, or of a thick wall at the start"), t.temperature);
    v.number(key("contact_heat_transfer", "h_c between wall and fluid; slag films to metal have 500 to 5000")
                 .or_word("perfect", 0),
             t.contact, above(0, "W/m^2 K"));
  }
  if (const auto with = v.only(t.kind == WallHeat::flux, {"thermal", {"flux"}}))
    v.number(required("heat_flux", "into the fluid"), t.heat_flux, any_number("W/m^2"));
  if (const auto with = v.only(thick, {"thermal", {"semi_infinite"}})) {
    v.number(required("conductivity", "of the wall"), t.conductivity, above(0, "W/m K"));
    v.number(required("density", "of the wall"), t.density, above(0, "kg/m^3"));
    v.number(required("heat_capacity", "of the wall"), t.heat_capacity, above(0, "J/kg K"));
  }
}

}  // namespace slagflow
