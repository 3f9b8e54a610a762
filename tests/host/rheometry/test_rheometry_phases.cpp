// Tables of thermodynamics software: what is read of them, and the rows that a case takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "heat/material_table.hpp"
#include "host/case/case.hpp"
#include "host/rheometry/rheometry_freezing.hpp"
#include "host/rheometry/rheometry_phase_names.hpp"
#include "host/rheometry_command.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_tools::hot_case_with;
using testing_tools::read_text_file;
using testing_tools::rheometry_command;
using testing_tools::Said;
using testing_tools::TempFolder;

constexpr double solidus = 1473.15, liquidus = 1673.15, latent = 3e5, of_solid = 1150, of_liquid = 1400;

double solids(double t) { return std::pow(std::clamp((liquidus - t) / (liquidus - solidus), 0.0, 1.0), 1.3); }

// (H2) with the heat capacities of solid and liquid, from 1273.15 K on [J/kg].
double enthalpy(double t) {
  constexpr int steps = 4000;
  const double start = 1273.15, step = (t - start) / steps;
  double sum = latent * (1 - solids(t));
  for (int k = 0; k < steps; ++k) {
    const double phi = solids(start + (k + 0.5) * step);
    sum += step * (phi * of_solid + (1 - phi) * of_liquid);
  }
  return sum;
}

std::string line(std::initializer_list<double> values, const char* separator) {
  std::string text;
  char number[40];
  for (const double value : values) {
    std::snprintf(number, sizeof number, "%.10g", value);
    text += (text.empty() ? "" : separator) + std::string(number);
  }
  return text + "\n";
}

// FactSage's: 100 g, one liquid and two solids, with the enthalpy of all.
std::string of_factsage() {
  std::string text = "FactSage\n\nT(C),P(atm),g_ASlag-liq#1,g_Melilite,\"g_Ca2SiO4_alpha(s)\",H(J)\n";
  for (int t = 1000; t <= 1550; t += 10) {
    const double phi = solids(t + 273.15);
    text += line({t * 1.0, 1, 100 * (1 - phi), 60 * phi, 40 * phi, 0.1 * enthalpy(t + 273.15) - 1.5e6}, ",");
  }
  return text;
}

Freezing freezing_of(const std::string& text, std::vector<std::string>& warnings) {
  const PhaseTable table = parse_phases(text, "x.csv", {}, {});
  return slagflow::freezing_of(table, "x.csv", warnings);
}

std::string refusal(const std::string& text, std::optional<double> mass = {}) {
  try {
    const PhaseTable table = parse_phases(text, "x.csv", {}, mass);
    std::vector<std::string> warnings;
    slagflow::freezing_of(table, "x.csv", warnings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_solids(const std::string& text) {
  std::vector<std::string> warnings;
  const Freezing found = freezing_of(text, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  EXPECT_LE(found.solids.size(), 40u);
  EXPECT_DOUBLE_EQ(found.solids.front()[1], 1);
  EXPECT_DOUBLE_EQ(found.solids.back()[1], 0);
  EXPECT_NEAR(found.solids.front()[0], solidus, 0.01);
  EXPECT_NEAR(found.solids.back()[0], liquidus, 0.01);
  for (double t = solidus - 20; t < liquidus + 20; t += 1)
    EXPECT_NEAR(value_at(found.solids, t), solids(t), 0.003) << t;
}

TEST(PhaseTable, ReadsAmountsOfPhases) { expect_solids(of_factsage()); }

TEST(PhaseTable, ReadsFractionsInManyForms) {
  struct Form {
    const char *names, *separator;
    bool kelvin, percent, liquid;
  };
  for (const Form& form :
       {Form{"Temperature [°C],Mass fraction of all solid phases", ",", false, false, false},
        Form{"T(K)\tsolid fraction [%]", "\t", true, true, false},
        Form{"Temperatur / K;Feststoffanteil", ";", true, false, false},
        Form{"Temperature [K],Mass fraction of LIQUID", ",", true, false, true},
        Form{"T (C),wt% liquid fraction", ",", false, true, true},
        Form{"温度 [℃],固相率 [%]", ",", false, true, false},
        Form{"temperature_K,Volume fraction of LIQUID", ",", true, false, true},
        Form{"T/K,LIQUID", ",", true, false, true},
        Form{"Temperature;Liquid fraction\n[°C];[%]", ";", false, true, true}}) {
    std::string text = std::string(form.names) + "\n";
    for (double t = 1700.15; t > 1420; t -= 1)
      text += line({t - (form.kelvin ? 0 : 273.15),
                    (form.liquid ? 1 - solids(t) : solids(t)) * (form.percent ? 100 : 1)},
                   form.separator);
    SCOPED_TRACE(form.names);
    expect_solids(text);
  }
}

TEST(PhaseTable, ReadsDecimalCommasAndPhasesByNameAlone) {
  std::string text = "T(K);Slag-liq#1;Melilite;gas_ideal\n";
  for (double t = 1423.15; t < 1700; t += 2) {
    std::string row = line({t, 50 * (1 - solids(t)), 50 * solids(t), 0}, ";");
    std::replace(row.begin(), row.end(), '.', ',');
    text += row;
  }
  expect_solids(text);
}

TEST(PhaseTable, NamesTellWhatColumnsAre) {
  for (const auto& [name, role] :
       {std::pair{"g_ASlag-liq#1", PhaseRole::liquid}, std::pair{"g_Ca2SiO4_alpha(s)", PhaseRole::solid},
        std::pair{"NP(LIQUID)", PhaseRole::liquid}, std::pair{"BPW(SPINEL)", PhaseRole::solid},
        std::pair{"Spinel [g]", PhaseRole::solid}, std::pair{"Solid (g)", PhaseRole::solid},
        std::pair{"solid", PhaseRole::solid_fraction}, std::pair{"gas_ideal (mol)", PhaseRole::gas},
        std::pair{"H(J)", PhaseRole::enthalpy}, std::pair{"Enthalpy [kJ/kg]", PhaseRole::enthalpy},
        std::pair{"Cp(J/K)", PhaseRole::heat_capacity},
        std::pair{"Heat capacity [J/(kg K)]", PhaseRole::heat_capacity}, std::pair{"P(atm)", PhaseRole::none},
        std::pair{"wt%CaO_ASlag-liq#1", PhaseRole::none}})
    EXPECT_EQ(parse_phase_column(name).role, role) << name;
  EXPECT_DOUBLE_EQ(parse_phase_column("Cp [kJ/kg K]").factor, 1e3);
  EXPECT_TRUE(parse_phase_column("Cp [J kg-1 K-1]").per_mass);
  EXPECT_FALSE(parse_phase_column("H [J/mol]").unit_known);
}

TEST(PhaseTable, GivesTheHeatOfTheFile) {
  const PhaseTable table = parse_phases(of_factsage(), "x.csv", {}, {});
  EXPECT_THAT(table.how, AllOf(HasSubstr("liquid 'g_ASlag-liq#1'; solid 'g_Melilite', 'g_Ca2SiO4_alpha(s)'"),
                               HasSubstr("enthalpy from 'H(J)' of 0.1 kg"), HasSubstr("not used: 'P(atm)'")));
  std::vector<std::string> warnings;
  const Freezing freezing = slagflow::freezing_of(table, "x.csv", warnings);
  const std::optional<MeltHeat> heat = heat_of(table, freezing.solids, "x.csv", warnings);
  ASSERT_TRUE(heat && heat->latent_heat);
  EXPECT_NEAR(*heat->latent_heat / latent, 1, 0.005);
  EXPECT_NEAR(value_at(heat->heat_capacity, 1300), of_solid, 3);
  EXPECT_NEAR(value_at(heat->heat_capacity, 1800), of_liquid, 3);
  EXPECT_LT(heat->off, 0.005 * latent);
}

TEST(PhaseTable, TakesAColumnOfTheHeatCapacity) {
  std::string text = "T(K),solid fraction,Cp [kJ/(kg K)],H [kJ/kg]\n";
  for (double t = 1273.15; t < 1800; t += 5)
    text += line({t, solids(t), 1e-3 * (of_liquid + (of_solid - of_liquid) * solids(t)), 1e-3 * enthalpy(t)},
                 ",");
  const PhaseTable table = parse_phases(text, "x.csv", {}, {});
  std::vector<std::string> warnings;
  const Freezing freezing = slagflow::freezing_of(table, "x.csv", warnings);
  const std::optional<MeltHeat> heat = heat_of(table, freezing.solids, "x.csv", warnings);
  EXPECT_NEAR(*heat.value().latent_heat / latent, 1, 0.005);
  EXPECT_NEAR(value_at(heat->heat_capacity, 1573.15), of_liquid + (of_solid - of_liquid) * solids(1573.15),
              14);
}

TEST(PhaseTable, TakesOutSmallFallsAndRefusesLargeOnes) {
  const std::string head = "T(K),solid fraction\n";
  std::vector<std::string> warnings;
  const Freezing found = freezing_of(head + "1400,1\n1450,0.79\n1500,0.8\n1550,0.4\n1600,0\n", warnings);
  EXPECT_THAT(warnings, testing::ElementsAre(AllOf(HasSubstr("x.csv:3:"), HasSubstr("by 0.01"))));
  EXPECT_DOUBLE_EQ(value_at(found.solids, 1450), 0.8);
  EXPECT_THAT(refusal(head + "1400,1\n1450,0.6\n1500,0.8\n1550,0.4\n1600,0\n"),
              AllOf(HasSubstr("x.csv:3: the solid fraction falls to 0.6 from 0.8"),
                    HasSubstr("allowed: up to 0.05")));
}

TEST(PhaseTable, AddsEndsThatAreNear) {
  std::vector<std::string> warnings;
  const Freezing found = freezing_of("T(K),solid fraction\n1400,0.9\n1450,0.5\n1500,0.1\n", warnings);
  EXPECT_NEAR(found.solids.front()[0], 1387.5, 1e-9);
  EXPECT_NEAR(found.solids.back()[0], 1512.5, 1e-9);
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[0], HasSubstr("a row [1387.5, 1] is added, which is a guess"));
}

TEST(PhaseTable, KeepsJumps) {
  std::vector<std::string> warnings;
  const Freezing found =
      freezing_of("T(K),solid fraction\n1400,1\n1500,0.3\n1500,1\n1550,0.1\n1600,0\n", warnings);
  EXPECT_THAT(found.solids, testing::Contains(std::array<double, 2>{1500, 1}));
  EXPECT_THAT(found.solids, testing::Contains(std::array<double, 2>{1500, 0.3}));
}

TEST(PhaseTable, RefusesWhatItCannotUse) {
  EXPECT_THAT(refusal("T(C),P(atm)\n1000,1\n"),
              HasSubstr("x.csv: no line names the columns of a table of phases"));
  EXPECT_THAT(refusal("temperature,solid fraction\n1000,1\n1100,0\n"),
              HasSubstr("a temperature and its unit"));
  EXPECT_THAT(refusal("T(K),solid fraction\n1400,1\n1500,x\n1600,0\n"),
              HasSubstr("x.csv:3: column 'solid fraction': value \"x\" is not a number"));
  EXPECT_THAT(refusal("T(K),solid fraction\n1400,1\n1500,1.2\n1600,0\n"),
              HasSubstr("x.csv:3: column 'solid fraction': value 1.2: allowed: 0 to 1"));
  EXPECT_THAT(refusal("T(K),solid fraction\n14NaN,1\n1500,0.5\n1600,0\n"),
              HasSubstr("x.csv:2: column 'T(K)': value \"14NaN\" is not a number"));
  EXPECT_THAT(refusal("T(K),solid fraction\n14,1\n1500,0.5\n1600,0\n"), HasSubstr("14 K: allowed: > 200"));
  EXPECT_THAT(refusal("T(K),solid fraction\n1400,0.5\n1500,0.3\n1600,0\n"),
              HasSubstr("at its lowest temperature, 1400 K, the solid fraction is 0.5"));
  EXPECT_THAT(refusal("T(K),solid fraction\n1400,1\n1500,1\n1600,1\n"), HasSubstr("nothing freezes"));
  EXPECT_THAT(refusal("T(K),solid fraction\n1400,1\n1600,0\n"), HasSubstr("2 rows: allowed: at least 3"));
  const std::string joules = "T(K),solid fraction,H(J)\n1400,1,1\n1500,0.5,2\n1600,0,3\n";
  EXPECT_THAT(refusal(joules), AllOf(HasSubstr("x.csv:1: column 'H(J)'"), HasSubstr("--mass")));
  EXPECT_EQ(refusal(joules, 0.1), "accepted");
  EXPECT_THAT(refusal("T(K),solid fraction,H[J/mol]\n1400,1,1\n1500,0.5,2\n1600,0,3\n"),
              HasSubstr("column 'H[J/mol]' has no unit that is known"));
  EXPECT_THAT(refusal("T(K),g_liq,mol_A\n1400,0,1\n1500,1,1\n1600,1,0\n"),
              HasSubstr("one unit for the amounts"));
}

TEST(PhaseTable, CommandGivesTheTableThatACaseTakes) {
  const TempFolder folder;
  std::ofstream(folder / "slag.csv") << of_factsage();
  const Said said =
      rheometry_command({"--phases", folder / "slag.csv", "--density", "2750", "-o", folder / "o.toml"});
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_THAT(said.out, AllOf(HasSubstr("liquidus 1673.15 K (1400.00 C)"), HasSubstr("solidus 1473.15 K")));
  const std::string table = read_text_file(folder / "o.toml");
  const Case c = parse_case(hot_case_with(table + "liquid_viscosity = 1\nconductivity = 1\n"), "x.toml");
  const MaterialSetup& m = c.fluids.at(0).material;
  EXPECT_NEAR(m.latent_heat / latent, 1, 0.005);
  EXPECT_NEAR(solid_fraction_at(m, 1573.15), solids(1573.15), 0.003);
  EXPECT_NEAR(value_at(m.heat_capacity, 1300), of_solid, 3);
  EXPECT_THAT(read_text_file(folder / "o.csv"),
              HasSubstr("temperature_K,measured_solid_fraction,rows_solid_fraction\n"));
  EXPECT_EQ(rheometry_command({"--phases", folder / "slag.csv", "--model", "vft"}).code, 2);
  EXPECT_EQ(rheometry_command({"--phases", folder / "none.csv"}).code, 2);
}

}  // namespace
}  // namespace slagflow
