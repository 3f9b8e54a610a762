// Suspensions: the laws, the fluid that a case file describes by its solid fraction, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "backend/error.hpp"
#include "fluid/rheology/suspension.hpp"
#include "host/case/case.hpp"

namespace slagflow {
namespace {

// Values of the closed forms, worked out apart from this code, to five digits.
struct Figures {
  double fraction;
  double roscoe_20, roscoe_25;    // phi_c 0.74, n 2.0 and 2.5
  double krieger_64, krieger_57;  // phi_c 0.64 and 0.57
  double maron_605, thomas;
};

constexpr Figures figures[] = {{0.05, 1.1502, 1.1911, 1.139, 1.1398, 1.1883, 1.1564},
                               {0.1, 1.3369, 1.4376, 1.3124, 1.3164, 1.4353, 1.3649},
                               {0.2, 1.8779, 2.1983, 1.8212, 1.8511, 2.2315, 1.9775},
                               {0.3, 2.8285, 3.6682, 2.7512, 2.9002, 3.9347, 3.0516},
                               {0.4, 4.737, 6.9885, 4.8034, 5.607, 8.7097, 5.6967},
                               {0.45, 6.5113, 10.401, 6.9804, 9.2106, 15.235, 8.9502},
                               {0.5, 9.5069, 16.694, 11.378, 19.854, 33.2, 15.748},
                               {0.55, 15.169, 29.936, 23.073, 118.35, 121, 30.608}};

double relative(SuspensionLaw law, double critical, double exponent, double fraction) {
  return relative_viscosity({law, critical, exponent}, fraction);
}

TEST(Suspension, LawsGiveTheirFigures) {
  constexpr double digits = 1e-4;
  for (const Figures& f : figures) {
    SCOPED_TRACE(f.fraction);
    EXPECT_NEAR(relative(SuspensionLaw::einstein_roscoe, 0.74, 2.0, f.fraction) / f.roscoe_20, 1, digits);
    EXPECT_NEAR(relative(SuspensionLaw::einstein_roscoe, 0.74, 2.5, f.fraction) / f.roscoe_25, 1, digits);
    EXPECT_NEAR(relative(SuspensionLaw::krieger_dougherty, 0.64, 2, f.fraction) / f.krieger_64, 1, digits);
    EXPECT_NEAR(relative(SuspensionLaw::krieger_dougherty, 0.57, 2, f.fraction) / f.krieger_57, 1, digits);
    EXPECT_NEAR(relative(SuspensionLaw::maron_pierce, 0.605, 2, f.fraction) / f.maron_605, 1, digits);
    EXPECT_NEAR(relative(SuspensionLaw::thomas, 0, 2, f.fraction) / f.thomas, 1, digits);
  }
}

TEST(Suspension, WithoutSolidsTheLiquidIsLeft) {
  for (const auto law :
       {SuspensionLaw::einstein_roscoe, SuspensionLaw::krieger_dougherty, SuspensionLaw::maron_pierce})
    EXPECT_EQ(relative(law, 0.64, 2.5, 0), 1);
  EXPECT_NEAR(relative(SuspensionLaw::thomas, 0, 0, 0), 1.00273, 1e-12);  // the fit does not pass through 1
}

// Einstein's slope of 2.5 at infinite dilution; Maron-Pierce and Roscoe have n / phi_c.
TEST(Suspension, DiluteSlopes) {
  const auto slope = [](SuspensionLaw law, double critical, double n) {
    return (relative(law, critical, n, 1e-7) - relative(law, critical, n, 0)) / 1e-7;
  };
  EXPECT_NEAR(slope(SuspensionLaw::krieger_dougherty, 0.64, 2), 2.5, 1e-5);
  EXPECT_NEAR(slope(SuspensionLaw::maron_pierce, 0.8, 3), 2.5, 1e-5);
  EXPECT_NEAR(slope(SuspensionLaw::einstein_roscoe, 0.74, 1.85), 2.5, 1e-5);
}

std::string fluid_case(const std::vector<std::string>& fluid) {
  std::string text = "[case]\nname='slurry'\n[resolution]\nspacing=1e-3\n[fluid.slurry]\n";
  for (const std::string& line : fluid) text += line + "\n";
  return text +
         "[[region]]\nshapes=[{shape='sphere', center=[0,0,0], radius=0.005}]\n"
         "[domain]\nmin=[-0.01,-0.01,-0.01]\nmax=[0.01,0.01,0.01]\n[output]\nend_time=1\n";
}

const std::vector<std::string> good_fluid{
    "solid_fraction = 0.5",            // line 6 of the file
    "suspension = 'einstein-roscoe'",  // 7
    "liquid_density = 965",            // 8
    "solid_density = 920",             // 9
    "liquid_viscosity = 0.0482",       // 10
    "rheology = 'bingham'",            // 11
    "yield_stress = 5",                // 12
};

// The good fluid with one line (1: the first) replaced; 0: none.
std::string case_with(std::size_t line, const std::string& replacement) {
  std::vector<std::string> lines = good_fluid;
  if (line > 0) lines[line - 1] = replacement;
  return fluid_case(lines);
}

FluidSpec fluid_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_case(text, "case.toml", overrides).fluids.at(0);
}

// Oils A and B of the paper with beads of 920 kg/m^3; viscosities by equation (8), worked out apart.
TEST(SuspensionFluid, OilsWithBeadsHaveTheirDensityAndViscosity) {
  struct Mixture {
    const char *density, *viscosity, *fraction;
    double mixed, eta_20, eta_25;
  };
  for (const Mixture& m : {Mixture{"965", "0.0482", "0.3", 951.5, 0.13633, 0.17681},
                           Mixture{"965", "0.0482", "0.5", 942.5, 0.45823, 0.80463},
                           Mixture{"970", "0.324", "0.3", 955.0, 0.91644, 1.18848},
                           Mixture{"970", "0.324", "0.5", 945.0, 3.08025, 5.40874}}) {
    const std::vector<std::string> oil{std::string("fluid.slurry.liquid_density=") + m.density,
                                       std::string("fluid.slurry.liquid_viscosity=") + m.viscosity,
                                       std::string("fluid.slurry.solid_fraction=") + m.fraction};
    const FluidSpec by_default = fluid_of(case_with(0, ""), oil);
    EXPECT_NEAR(by_default.density, m.mixed, 1e-9);
    EXPECT_NEAR(by_default.parameters[0], m.eta_20, 6e-6);
    const FluidSpec steeper = fluid_of(case_with(1, "exponent = 2.5"), oil);
    EXPECT_NEAR(steeper.parameters[0], m.eta_25, 6e-6);
    EXPECT_EQ(steeper.parameters[1], 5);
  }
}

TEST(SuspensionFluid, EveryLawHasItsDefaultCriticalFraction) {
  for (const SuspensionInfo& info : suspension_laws) {
    const FluidSpec fluid = fluid_of(case_with(2, std::string("suspension = '") + info.name + "'"));
    Suspension law;
    law.law = static_cast<SuspensionLaw>(&info - suspension_laws.data());
    law.critical_fraction = info.critical_fraction;
    EXPECT_DOUBLE_EQ(fluid.parameters[0], 0.0482 * relative_viscosity(law, 0.5)) << info.name;
  }
  EXPECT_NEAR(fluid_of(case_with(2, "suspension = 'maron-pierce'")).parameters[0],
              0.0482 / std::pow(1 - 0.5 / 0.64, 2), 1e-12);
  EXPECT_NEAR(fluid_of(case_with(2, "suspension = 'maron-pierce'\ncritical_fraction = 0.6")).parameters[0],
              0.0482 * 36, 1e-9);
}

TEST(SuspensionFluid, RaisesTheViscosityOfEveryRheology) {
  for (const RheologyInfo& info : rheologies) {
    std::vector<std::string> lines(good_fluid.begin(), good_fluid.begin() + 5);
    lines.push_back(std::string("rheology = '") + info.name + "'");
    for (int k = 0; k < info.parameter_count; ++k)
      if (info.parameters[k].fallback < 0 && info.parameters[k].role != ParameterRole::viscosity)
        lines.push_back(std::string(info.parameters[k].key) + " = 1");
    const FluidSpec fluid = fluid_of(fluid_case(lines));
    for (std::size_t k = 0; k < static_cast<std::size_t>(info.parameter_count); ++k) {
      const ParameterInfo& p = info.parameters[k];
      if (p.role == ParameterRole::viscosity) {
        EXPECT_NEAR(fluid.parameters[k], 0.45823, 6e-6) << info.name;
      } else {
        EXPECT_EQ(fluid.parameters[k], p.fallback < 0 ? 1 : p.fallback) << info.name << " " << p.key;
      }
    }
  }
}

TEST(SuspensionFluid, YieldStressComesFromItsTable) {
  const std::string text = case_with(7, "yield_stress = [[0.4, 1], [0.45, 3.0], [0.55, 13]]");
  const auto stress = [&](const std::string& fraction) {
    return fluid_of(text, {"fluid.slurry.solid_fraction=" + fraction}).parameters[1];
  };
  EXPECT_EQ(stress("0"), 0);
  EXPECT_EQ(stress("0.399"), 0);
  EXPECT_EQ(stress("0.4"), 1);
  EXPECT_NEAR(stress("0.425"), 2, 1e-12);
  EXPECT_EQ(stress("0.45"), 3);
  EXPECT_NEAR(stress("0.5"), 8, 1e-12);
  EXPECT_EQ(stress("0.55"), 13);
}

TEST(SuspensionFluid, WrittenCaseHoldsTheResolvedNumbers) {
  const Case c = parse_case(case_with(7, "yield_stress = [[0.4, 0], [0.6, 7]]"), "case.toml");
  const std::string written = to_toml(c);
  EXPECT_NE(written.find("density = 942.5\n"), std::string::npos) << written;
  for (const char* key : {"solid_fraction", "suspension", "liquid"})
    EXPECT_EQ(written.find(key), std::string::npos) << key;
  const Case again = parse_case(written, "written.toml");
  EXPECT_EQ(to_toml(again), written);
  EXPECT_EQ(again.fluids[0].density, c.fluids[0].density);
  EXPECT_EQ(again.fluids[0].parameters, c.fluids[0].parameters);
}

struct Wrong {
  std::size_t line;
  std::string replacement;
  std::vector<std::string> fragments;
};

const std::vector<Wrong> wrong_fluids{
    {1,
     "solid_fraction = 0.74",
     {"case.toml:6: key 'fluid.slurry.solid_fraction': value 0.74 is out of range: allowed: a number >= 0.0 "
      "and "
      "< 0.74"}},
    {1, "solid_fraction = -0.1", {"case.toml:6", "value -0.1 is out of range"}},
    {1, "solid_fraction = nan", {"case.toml:6", "value nan is out of range"}},
    {1, "solid_fraction = 'half'", {"case.toml:6", "has the wrong type"}},
    {1, "", {"case.toml:5: key 'fluid.slurry.solid_fraction': missing"}},
    {1, "solid_fracton = 0.5", {"case.toml:6", "unknown: did you mean 'solid_fraction'?"}},
    {1,
     "solid_fraction = 0.7399999999\nexponent = 10",
     {"case.toml:6: key 'fluid.slurry.solid_fraction': value 0.7399999999 gives the parameter "
      "'plastic_viscosity' the value",
      "allowed: a number > 0.0"}},
    {1, "solid_fraction = 0.5\ncritical_fraction = 0.5", {"case.toml:6", "< 0.5"}},
    {1,
     "solid_fraction = 0.5\ncritical_fraction = 1.1",
     {"case.toml:7: key 'fluid.slurry.critical_fraction': value 1.1 is out of range: allowed: a number > 0.0 "
      "and "
      "<= 1.0"}},
    {1, "solid_fraction = 0.5\nexponent = 0", {"case.toml:7: key 'fluid.slurry.exponent': value 0 is out"}},
    {2,
     "",
     {"case.toml:5: key 'fluid.slurry.suspension': missing: required: einstein-roscoe, krieger-dougherty"}},
    {2,
     "suspension = 'thoma'\ncritical_fraction = 0.6",
     {"case.toml:7: key 'fluid.slurry.suspension': value \"thoma\" is unknown: did you mean 'thomas'?"}},
    {2, "suspension = 'thomas'\ncritical_fraction = 0.6", {"case.toml:8", "critical_fraction': unknown"}},
    {2, "suspension = 'maron-pierce'\nexponent = 2", {"case.toml:8", "exponent': unknown"}},
    {3, "", {"case.toml:5: key 'fluid.slurry.liquid_density': missing"}},
    {3, "liquid_density = 0", {"case.toml:8", "allowed: a number >= 0.001"}},
    {3,
     "liquid_density = 965\ndensity = 965",
     {"case.toml:9: key 'fluid.slurry.density': does not go with the other keys: a suspension has "
      "liquid_density"}},
    {4, "", {"case.toml:5: key 'fluid.slurry.solid_density': missing"}},
    {4, "solid_density = -920", {"case.toml:9", "out of range"}},
    {5, "", {"case.toml:5: key 'fluid.slurry.liquid_viscosity': missing"}},
    {5, "liquid_viscosity = 0", {"case.toml:10", "allowed: a number > 0.0 [Pa s]"}},
    {5,
     "liquid_viscosity = 1\nplastic_viscosity = 1",
     {"case.toml:11: key 'fluid.slurry.plastic_viscosity': does not go with the other keys"}},
    {6, "rheology = 'newtonian'", {"case.toml:12: key 'fluid.slurry.yield_stress': unknown"}},
    {7, "", {"case.toml:5: key 'fluid.slurry.yield_stress': missing"}},
    {7, "yield_stress = -5", {"case.toml:12", "allowed: a number >= 0.0 [Pa]"}},
    {7, "yield_stress = []", {"case.toml:12: key 'fluid.slurry.yield_stress': value [] is empty"}},
    {7,
     "yield_stress = [0.5, 3]",
     {"case.toml:12", "has the wrong type: allowed: in a suspension rows [solid fraction"}},
    {7, "yield_stress = [[0.5, 3, 4]]", {"case.toml:12", "has the wrong type"}},
    {7,
     "yield_stress = [[0.4, 1], [0.4, 2], [0.6, 3]]",
     {"case.toml:12: key 'fluid.slurry.yield_stress': row [0.4, 2.0] is out of range or order",
      "increasing"}},
    {7, "yield_stress = [[0.5, 1], [0.4, 2]]", {"case.toml:12", "row [0.4, 2.0]"}},
    {7, "yield_stress = [[0.5, -1]]", {"case.toml:12", "row [0.5, -1.0]"}},
    {7, "yield_stress = [[-0.5, 1]]", {"case.toml:12", "row [-0.5, 1.0]"}},
    {7, "yield_stress = [[0.5, nan]]", {"case.toml:12", "row [0.5, nan]"}},
    {7,
     "yield_stress = [[0.4, 0], [0.45, 3]]",
     {"case.toml:12", "the table ends at the solid fraction 0.45: allowed: rows up to solid_fraction = 0.5"}},
};

std::string message_of(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(SuspensionErrors, EachMistakeIsNamedWithItsPlace) {
  ASSERT_EQ(message_of(case_with(0, "")), "accepted");
  for (const Wrong& wrong : wrong_fluids) {
    const std::string message = message_of(case_with(wrong.line, wrong.replacement));
    for (const std::string& fragment : wrong.fragments)
      EXPECT_NE(message.find(fragment), std::string::npos)
          << wrong.replacement << "\nwanted: " << fragment << "\ngot: " << message;
  }
}

// One mistake, one line: a faulty key does not draw others after it.
TEST(SuspensionErrors, AFaultyLawOrFractionIsReportedAlone) {
  for (const auto& [line, text] :
       std::vector<std::pair<std::size_t, std::string>>{{1, "solid_fraction = 2"},
                                                        {2, "suspension = 'x'\ncritical_fraction = 0.6"},
                                                        {2, "suspension = 'x'\nexponent = 2"}}) {
    const std::string message = message_of(case_with(line, text));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(SuspensionErrors, AYieldStressTableNeedsASolidFraction) {
  const std::string message = message_of(fluid_case(
      {"density = 965", "rheology = 'bingham'", "plastic_viscosity = 1", "yield_stress = [[0.4, 1]]"}));
  EXPECT_NE(message.find("case.toml:9: key 'fluid.slurry.yield_stress': value [[0.4, 1]] has the wrong type"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace slagflow
