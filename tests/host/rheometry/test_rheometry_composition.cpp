// Viscosities of liquid slag from its composition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/rheometry/rheometry_composition.hpp"
#include "host/rheometry_command.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing_tools::hot_case_with;
using testing_tools::read_text_file;
using testing_tools::rheometry_command;
using testing_tools::Said;
using testing_tools::TempFolder;

const char* const blast_furnace = "CaO=42,SiO2=36,Al2O3=14,MgO=8";
const char* const with_potash = "CaO=45,SiO2=45,K2O=10";
const char* const steelmaking = "CaO=45,SiO2=20,FeO=25,MgO=6,MnO=4";

double viscosity(SlagModel model, const char* composition, double celsius) {
  return std::exp(
      log_liquid_viscosity(slag_viscosity(model, parse_composition(composition, false)), celsius + 273.15));
}

std::string refusal(const std::string& text) {
  try {
    slag_viscosity(SlagModel::urbain, parse_composition(text, false));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// As OxideProperties by M. Humbert has them, after K. C. Mills, The Estimation of Slag Properties (2011), and
// Kekkonen et al., Viscosity Models for Molten Slags (2012).
TEST(SlagComposition, GivesThePublishedViscosities) {
  struct Known {
    const char* composition;
    double celsius, riboud, urbain;  // [Pa s]
  };
  for (const Known& k :
       {Known{blast_furnace, 1300, 1.5287787, 1.4068971}, Known{blast_furnace, 1500, 0.32399755, 0.38272783},
        Known{blast_furnace, 1650, 0.12604937, 0.17354486}, Known{with_potash, 1300, 0.72984477, 0.83764087},
        Known{with_potash, 1500, 0.24201926, 0.25374533}, Known{steelmaking, 1500, 0.015021179, 0.058491732},
        Known{steelmaking, 1650, 0.0096291199, 0.035859061}}) {
    EXPECT_NEAR(viscosity(SlagModel::riboud, k.composition, k.celsius) / k.riboud, 1, 1e-3) << k.composition;
    EXPECT_NEAR(viscosity(SlagModel::urbain, k.composition, k.celsius) / k.urbain, 1, 1e-3) << k.composition;
  }
}

TEST(SlagComposition, TakesMassAndMole) {
  const Composition c = parse_composition("CaO = 50; SiO2: 50 %", true);
  EXPECT_DOUBLE_EQ(c.mole_of("CaO"), 0.5);
  EXPECT_NEAR(c.mass_of("CaO"), 56.077 / (56.077 + 60.084), 1e-12);
  const Composition again = parse_composition("CaO=56.077,SiO₂=60.084", false);
  EXPECT_NEAR(again.mole_of("SiO2"), 0.5, 1e-12);
}

TEST(SlagComposition, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(refusal("CaO=42,SiO=36"),
              AllOf(HasSubstr("composition: \"SiO\": unknown: did you mean 'SiO2'?"),
                    HasSubstr("allowed: SiO2, P2O5, Al2O3")));
  EXPECT_THAT(refusal("CaO=42,5"), HasSubstr("\"5\": allowed: NAME=VALUE"));
  EXPECT_THAT(refusal("CaO=-1,SiO2=50"), HasSubstr("CaO: value \"-1\": allowed: a number >= 0"));
  EXPECT_THAT(refusal("CaO=40,SiO2=50,CaO=10"), HasSubstr("CaO stands twice"));
  EXPECT_THAT(refusal("CaO=x"), HasSubstr("value \"x\""));
  EXPECT_THAT(refusal("CaO=0"), HasSubstr("allowed: NAME=VALUE of at least one of"));
  EXPECT_THAT(refusal("SiO2=60,Al2O3=40"), HasSubstr("no CaO, MgO, MnO, FeO or alkali"));
}

TEST(SlagComposition, TellsWhatIsOutside) {
  const auto outside = [](const char* text) {
    return outside_range(SlagModel::riboud, parse_composition(text, false));
  };
  EXPECT_THAT(outside(with_potash), IsEmpty());
  EXPECT_THAT(outside(blast_furnace), testing::ElementsAre(HasSubstr("Al2O3 14 mass %, made for 0 to 12")));
  EXPECT_THAT(outside("CaO=40,SiO2=40,B2O3=20"), testing::Contains(HasSubstr("B2O3 is not of the model")));
}

TEST(SlagComposition, CommandShowsBothAndGivesATable) {
  const TempFolder folder;
  const Said said =
      rheometry_command({"--composition", blast_furnace, "--density", "2750", "-o", folder / "slag.toml"});
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_THAT(said.out,
              AllOf(HasSubstr("* urbain   A 3.008e-09 Pa s/K, B 19826 K"),
                    HasSubstr("riboud   A 3.573e-10 Pa s/K, B 23308 K"), HasSubstr("liquid slag only")));
  EXPECT_THAT(said.err, HasSubstr("riboud: Al2O3 14 mass %"));
  const std::string table = read_text_file(folder / "slag.toml");
  const Case c = parse_case(hot_case_with(table + "heat_capacity = 1200\nconductivity = 1\n"), "x.toml");
  EXPECT_EQ(c.fluids[0].name, "slag");
  EXPECT_NEAR(std::exp(log_liquid_viscosity(c.fluids[0].material.liquid, 1773.15)), 0.38272783, 4e-4);
  EXPECT_THAT(read_text_file(folder / "slag.csv"),
              HasSubstr("temperature_K,measured_Pas,urbain_Pas,riboud_Pas\n"));
}

TEST(SlagComposition, CommandChoosesAndWarns) {
  EXPECT_THAT(rheometry_command({"--composition", with_potash}).out, HasSubstr("* riboud"));
  EXPECT_THAT(rheometry_command({"--composition", with_potash, "--model", "urbain"}).out,
              HasSubstr("* urbain"));
  const Said apart = rheometry_command({"--composition", steelmaking});
  EXPECT_THAT(apart.err, HasSubstr("0.0585 and 0.015 Pa s, a factor of 3.9 apart"));
  EXPECT_THAT(rheometry_command({"--composition", "CaO=45,SiO2=45"}).err, HasSubstr("the sum is 90 %"));
  EXPECT_THAT(rheometry_command({"--composition", with_potash}).err, Not(HasSubstr("the sum")));
  for (const auto& arguments :
       {std::vector<std::string>{"--composition", "Cao=1,Foo=2"},
        std::vector<std::string>{"--composition", with_potash, "--model", "bingham"},
        std::vector<std::string>{"--composition", with_potash, "x.csv"}, std::vector<std::string>{}}) {
    const Said said = rheometry_command(arguments);
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.err, HasSubstr("allowed: "));
  }
}

}  // namespace
}  // namespace slagflow
