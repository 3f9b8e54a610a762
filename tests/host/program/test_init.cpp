// slagflow init: each template makes a case that can run; questions, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "backend/error.hpp"
#include "host/program/init.hpp"
#include "host/program/program.hpp"
#include "host/run/check.hpp"
#include "host/temp_folder.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::read_text_file;
using testing_tools::TempFolder;

std::string init(const InitOptions& options, const std::string& answers = "") {
  std::istringstream in(answers);
  std::ostringstream out;
  return init_case(options, in, out);
}

std::string refused(const InitOptions& options, const std::string& answers = "") {
  try {
    init(options, answers);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

class EachTemplate : public testing::TestWithParam<const char*> {};

TEST_P(EachTemplate, ChecksWithoutAWarningAndRuns) {
  const TempFolder folder;
  InitOptions options;
  options.given = GetParam(), options.output = folder / "my case.toml";
  EXPECT_THAT(init(options), HasSubstr("next: slagflow check"));
  const Case c = load_case(options.output);
  EXPECT_EQ(c.name, "my_case");
  const BuiltCase built = build_setup(c);
  const CaseCheck check = check_case(built);
  EXPECT_THAT(check.warnings, testing::IsEmpty());
  EXPECT_GE(check.wall.across, 3);
  EXPECT_LT(check.run_time, 60);
  Simulation simulation(built.setup);
  for (int k = 0; k < 60; ++k) simulation.step();
  simulation.require_sound();
  EXPECT_LT(simulation.largest_compression().value, 0.05);
}

std::vector<const char*> template_names() {
  std::vector<const char*> names;
  for (const CaseTemplate& one : case_templates()) names.push_back(one.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Init, EachTemplate, testing::ValuesIn(template_names()),
                         [](const auto& one) { return std::string(one.param); });

TEST(Init, TakesValuesFromOptions) {
  const TempFolder folder;
  InitOptions options;
  options.asked = "slump", options.output = folder / "a.toml";
  options.density = 3000, options.viscosity = 0.25, options.yield_stress = 0, options.spacing = 0.005;
  init(options);
  const Case c = load_case(options.output);
  EXPECT_EQ(c.fluids[0].density, 3000);
  EXPECT_EQ(c.fluids[0].rheology, RheologyKind::newtonian);
  EXPECT_EQ(c.fluids[0].parameters[0], 0.25);
  EXPECT_EQ(c.spacing, 0.005);
}

TEST(Init, AsksOnATerminal) {
  const TempFolder folder;
  InitOptions options;
  options.terminal = true, options.output = folder / "a.toml";
  // A wrong template, then the runner; a density, no number and then a viscosity, defaults.
  init(options, "rumner\nrunner\n2500\nthick\n4\n\n\n");
  const Case c = load_case(options.output);
  EXPECT_EQ(c.inlets.size(), 1U);
  EXPECT_EQ(c.fluids[0].density, 2500);
  EXPECT_EQ(c.fluids[0].parameters[0], 4);
  EXPECT_EQ(c.fluids[0].parameters[1], 3);
  options.output = folder / "b.toml";
  EXPECT_THAT(refused(options, "runner\n"), HasSubstr("no answer: allowed: --template NAME asks nothing"));
  EXPECT_FALSE(std::filesystem::exists(options.output));
}

TEST(Init, RefusesWhatCannotBe) {
  const TempFolder folder;
  InitOptions options;
  options.output = folder / "a.toml";
  EXPECT_THAT(refused(options), HasSubstr("no template, and no terminal to ask at: allowed: dam, runner"));
  options.given = "rumner";
  EXPECT_EQ(
      refused(options),
      "template 'rumner': unknown: did you mean 'runner'? allowed: dam, runner, pouring, slump, viscometer");
  options.given = "dam", options.density = 1e9;
  EXPECT_THAT(refused(options), HasSubstr("key 'fluid.slag.density': value"));
  EXPECT_FALSE(std::filesystem::exists(options.output));
  options.density.reset();
  init(options);
  const std::string before = read_text_file(options.output);
  options.given = "slump";
  EXPECT_THAT(refused(options), HasSubstr("is there already: allowed: -o with a name that is not"));
  EXPECT_EQ(read_text_file(options.output), before);
  options.output = folder / "none/a.toml";
  EXPECT_THAT(refused(options), HasSubstr("cannot be written"));
}

TEST(Init, RefusesASpacingThatLeavesNoParticle) {
  const TempFolder folder;
  InitOptions options;
  options.given = "dam", options.output = folder / "a.toml", options.spacing = 5;
  EXPECT_THROW(init(options), InputError);
  EXPECT_FALSE(std::filesystem::exists(options.output));
}

}  // namespace
}  // namespace slagflow
