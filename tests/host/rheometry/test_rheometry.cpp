#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/rheometry/rheometry.hpp"
#include "host/rheometry_command.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::read_text_file;
using testing_tools::rheometry_command;
using testing_tools::Said;
using testing_tools::TempFolder;

// A case around a [fluid] table.
std::string case_with(const std::string& fluid) {
  return "[case]\nname = \"x\"\n[resolution]\nspacing = 1e-3\n" + fluid +
         "[[region]]\nshapes = [{shape = \"box\", min = [0, 0, 0], max = [0.01, 0.01, 0.01]}]\n"
         "[domain]\nmin = [0, 0, 0]\nmax = [0.01, 0.01, 0.01]\n[output]\nend_time = 1\n";
}

class Rheometry : public testing::Test {
 protected:
  Rheometry() {
    std::ofstream bingham(slurry());
    bingham << "# density_kg/m3 = 940\nshear_rate_1/s,shear_stress_Pa\n";
    const double noise[] = {0.02, -0.03, 0.01, 0.03, -0.02, -0.01, 0.02, -0.02};
    double rate = 1;
    for (const double e : noise) bingham << rate << "," << 2.3 + 2.25 * rate + e << "\n", rate *= 1.5;
  }
  std::string slurry() const { return folder_ / "slurry a.csv"; }

  const TempFolder folder_;
};

TEST_F(Rheometry, ReplacesWhatItWroteButNoOtherFile) {
  const std::string output = folder_ / "a.toml", curves = folder_ / "a.csv";
  for (int k = 0; k < 2; ++k) EXPECT_EQ(rheometry_command({slurry(), "-o", output}).code, 0);
  for (const std::string& other : {output, curves}) {
    const std::string kept = read_text_file(other);
    std::ofstream(other, std::ios::trunc) << "something else\n";
    const Said said = rheometry_command({slurry(), "-o", output});
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.err, HasSubstr("output " + other + ": is there and not by slagflow rheometry"));
    EXPECT_EQ(read_text_file(other), "something else\n");
    std::ofstream(other, std::ios::trunc) << kept;
  }
}

TEST_F(Rheometry, RefusesOptionsThatAreNoNumberAboveZero) {
  for (const char* value : {"nan", "inf", "0", "-1", "thick"}) {
    const Said said = rheometry_command({slurry(), "--density", value});
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.err, HasSubstr(std::string("--density: value ") + value + ": allowed: a number > 0.0"));
  }
}

TEST_F(Rheometry, GivesTheFluidTableThatACaseTakes) {
  const std::string output = folder_ / "rheology.toml";
  const Said said = rheometry_command({slurry(), "-o", output});
  EXPECT_EQ(said.code, 0) << said.err;
  const std::string table = read_text_file(output);
  EXPECT_THAT(said.out, HasSubstr(table));
  const Case c = parse_case(case_with(table), "x.toml");
  ASSERT_EQ(c.fluids.size(), 1u);
  EXPECT_EQ(c.fluids[0].name, "slurry_a");
  EXPECT_EQ(c.fluids[0].rheology, RheologyKind::bingham);
  EXPECT_DOUBLE_EQ(c.fluids[0].density, 940);
  EXPECT_NEAR(c.fluids[0].parameters[0], 2.25, 0.01);
  EXPECT_NEAR(c.fluids[0].parameters[1], 2.3, 0.06);
  EXPECT_DOUBLE_EQ(c.fluids[0].parameters[2], 1000);
}

TEST_F(Rheometry, EachModelGivesAValidTable) {
  for (const FlowModel model : flow_models) {
    const std::string output = folder_ / "rheology.toml";
    const Said said = rheometry_command(
        {slurry(), "--model", name_of(model), "-o", output, "--name", "s", "--growth-exponent", "100"});
    EXPECT_EQ(said.code, 0) << said.err;
    const Case c = parse_case(case_with(read_text_file(output)), "x.toml");
    EXPECT_STREQ(c.fluids[0].info().name, name_of(model));
    if (model == FlowModel::newtonian) continue;
    const auto last = static_cast<std::size_t>(c.fluids[0].info().parameter_count - 1);
    EXPECT_DOUBLE_EQ(c.fluids[0].parameters[last], 100);
  }
}

TEST_F(Rheometry, LeavesTheCurvesBesideTheTable) {
  const Said said = rheometry_command({slurry(), "-o", folder_ / "rheology.toml"});
  EXPECT_EQ(said.code, 0) << said.err;
  const std::string curves = read_text_file(folder_ / "rheology.csv");
  EXPECT_EQ(curves.substr(0, curves.find('\n')),
            "shear_rate_1/s,measured_Pa,bingham_Pa,herschel-bulkley_Pa,newtonian_Pa");
}

TEST_F(Rheometry, SaysThatTheDensityIsMissing) {
  std::string text = read_text_file(slurry());
  const std::string file = folder_ / "without.csv";
  std::ofstream(file) << text.substr(text.find('\n') + 1);
  const Said said = rheometry_command({file});
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.err, HasSubstr("--density"));
  EXPECT_THAT(said.out, HasSubstr("# density = "));
  EXPECT_THAT(rheometry_command({file, "--density", "940"}).out, HasSubstr("\ndensity = 940"));
}

TEST_F(Rheometry, WarnsWhenTheYieldStressIsNotCertain) {
  const std::string file = folder_ / "oil.csv";
  std::ofstream(file)
      << "shear_rate_1/s,shear_stress_Pa\n1,0.98\n2,2.03\n4,3.98\n8,8.04\n16,15.97\n32,32.01\n";
  EXPECT_THAT(rheometry_command({file}).out, HasSubstr("rheology = \"newtonian\""));
  EXPECT_THAT(rheometry_command({file, "--model", "bingham"}).err, HasSubstr("reaches 0"));
}

TEST_F(Rheometry, BadInputGivesTwo) {
  EXPECT_EQ(rheometry_command({folder_ / "none.csv"}).code, 2);
  EXPECT_EQ(rheometry_command({slurry(), "--model", "casson"}).code, 2);
  EXPECT_EQ(rheometry_command({slurry(), "--bob-radius", "-1"}).code, 2);
  const Said other = rheometry_command({slurry(), "-o", folder_ / "rheology.csv"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("ends in .toml"));
  const Said same = rheometry_command({slurry(), "-o", folder_ / "slurry a.toml"});
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.err, HasSubstr("would replace the measurements"));
}

TEST_F(Rheometry, RefusesACurveThatNoFluidOfACaseHas) {
  const std::string file = folder_ / "steep.csv";
  std::ofstream(file) << "shear_rate_1/s,shear_stress_Pa\n1,1\n2,8\n4,64\n8,512\n16,4096\n32,32768\n";
  const Said said = rheometry_command({file, "--model", "herschel-bulkley"});
  EXPECT_EQ(said.code, 2);
  EXPECT_THAT(said.err, HasSubstr("flow index"));
}

TEST_F(Rheometry, TellsTooFewPointsForAModel) {
  const std::string file = folder_ / "few.csv";
  std::ofstream(file) << "shear_rate_1/s,shear_stress_Pa\n1,3\n2,4\n4,6\n8,10.1\n16,18\n";
  EXPECT_THAT(rheometry_command({file, "--model", "herschel-bulkley"}).err,
              HasSubstr("5 points are too few for the herschel-bulkley model: allowed: at least 6"));
  const Said said = rheometry_command({file});
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.err, HasSubstr("too few to try the herschel-bulkley model"));
}

TEST_F(Rheometry, RefusesAStressThatDoesNotRise) {
  const std::string flat = folder_ / "flat.csv", falling = folder_ / "falling.csv";
  std::ofstream(flat) << "shear_rate_1/s,shear_stress_Pa\n1,5\n2,5\n5,5\n10,5\n50,5\n";
  std::ofstream(falling) << "shear_rate_1/s,shear_stress_Pa\n1,5\n2,4.9\n5,4.8\n10,4.7\n50,4.5\n";
  for (const char* model : {"auto", "bingham"}) {
    const Said said = rheometry_command({flat, "--model", model});
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.err, HasSubstr("stays the same while the rate rises 50-fold, at 5 Pa: that would be a "
                                    "yield stress of 5 Pa"));
    EXPECT_EQ(rheometry_command({falling, "--model", model}).code, 2);
  }
  EXPECT_THAT(rheometry_command({falling}).err, HasSubstr("the stress falls while the rate rises 50-fold"));
}

}  // namespace
}  // namespace slagflow
