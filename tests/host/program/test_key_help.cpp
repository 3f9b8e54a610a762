// What the program says of the keys of a case: in a terminal, on its page, to editors and to the shell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "backend/error.hpp"
#include "host/case/case_catalogue.hpp"
#include "host/program/command_line.hpp"
#include "host/program/key_help.hpp"
#include "host/program/program.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string refusal(const std::string& topic) {
  try {
    return key_help(topic);
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(KeyHelp, ListsTheTables) {
  for (const char* table : {"[numerics]", "[fluid.NAME]", "[[wall]]", "[output]"})
    EXPECT_THAT(key_help(""), HasSubstr(table));
}

TEST(KeyHelp, TellsOfAKeyByItsNameOrItsPath) {
  for (const char* topic : {"skin", "numerics.skin"})
    EXPECT_THAT(key_help(topic), AllOf(StartsWith("numerics.skin\n"), HasSubstr(">= 0.02 and <= 0.5"),
                                       HasSubstr("default 0.06"), HasSubstr("neighbour list")));
  for (const char* topic : {"fluid.slag.density", "fluid.density", "fluid.NAME.density"})
    EXPECT_THAT(key_help(topic), AllOf(StartsWith("fluid.NAME.density\n"), HasSubstr("number [kg/m^3]")))
        << topic;
  EXPECT_THAT(key_help("wall.0.motion.frequency"), HasSubstr("with type = \"sine\""));
}

TEST(KeyHelp, TellsOfAllKeysOfAName) {
  EXPECT_THAT(key_help("velocity"),
              AllOf(HasSubstr("region.N.velocity\n"), HasSubstr("wall.N.motion.velocity\n")));
}

TEST(KeyHelp, TellsOfATable) {
  for (const CatalogueKey* k : catalogue().in("numerics"))
    EXPECT_THAT(key_help("numerics"), HasSubstr("numerics." + k->name + "\n"));
  EXPECT_THAT(key_help("wall.motion"), AllOf(HasSubstr("duration"), Not(HasSubstr("contact_angle"))));
  EXPECT_THAT(key_help("shapes"), HasSubstr("shape.radius\n"));
}

TEST(KeyHelp, SaysWhatMayHaveBeenMeant) {
  EXPECT_THAT(refusal("yeild_stress"),
              AllOf(HasSubstr("help yeild_stress: is no key and no table: did you mean 'yield_stress'?"),
                    HasSubstr("allowed: a key, or one of case, resolution")));
  EXPECT_THAT(refusal("numerics.skim"), HasSubstr("did you mean 'numerics.skin'?"));
}

TEST(KeyHelp, PageIsWhatTheProgramPrints) {
  std::ifstream file(SLAGFLOW_SOURCE_DIR "/host/README.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::string page = text.str(), begin = "<!-- keys: written by scripts/pages -->\n";
  const std::size_t at = page.find(begin), end = page.find("\n<!-- end of keys -->");
  ASSERT_NE(at, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(page.substr(at + begin.size(), end - at - begin.size()), key_page()) << "scripts/pages writes it";
}

TEST(KeyHelp, PageHoldsEveryKey) {
  for (const CatalogueKey& k : catalogue().keys())
    EXPECT_THAT(key_page(), HasSubstr((k.table.empty() ? "### `" : "| `") +
                                      std::string(!k.table.empty()       ? k.name + "`"
                                                  : k.form == Form::list ? "[[" + k.name + "]]`"
                                                                         : "[" + k.inside + "]`")));
}

TEST(KeyHelp, SchemaKnowsRangesWordsAndWhatIsRequired) {
  const std::string schema = key_schema();
  EXPECT_THAT(schema, HasSubstr("\"$schema\": \"http://json-schema.org/draft-07/schema#\""));
  EXPECT_THAT(schema, HasSubstr("\"enum\": [\"implicit\", \"explicit\"]"));
  EXPECT_THAT(schema, HasSubstr("\"exclusiveMinimum\": 0,\n          \"maximum\": 1.2"));
  EXPECT_THAT(schema, HasSubstr("\"required\": [\"case\""));
  for (const CatalogueKey& k : catalogue().keys()) EXPECT_THAT(schema, HasSubstr("\"" + k.name + "\": {"));
}

// What bash would offer for a command line whose last word is unfinished; words as bash splits them.
std::string offered(const std::vector<std::string>& words) {
  const testing_tools::TempFolder folder;
  const std::string script = folder / "completion";
  const CommandLine line{"",
                         {{"run", "", {{"--set", "KEY=VALUE", ""}, {"--quiet", "", ""}}}, {"help", "", {}}}};
  std::ofstream(script) << bash_completion(line);
  std::string command = "bash -c '. " + script + "; COMP_WORDS=(";
  for (const std::string& word : words) command += "\"" + word + "\" ";
  command += "); COMP_CWORD=" + std::to_string(words.size() - 1) +
             "; _slagflow 2>/dev/null; echo -n \"${COMPREPLY[*]}\"'";
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  const std::size_t length = std::fread(buffer.data(), 1, buffer.size(), pipe);
  pclose(pipe);
  return {buffer.data(), length};
}

TEST(Completion, OffersCommandsOptionsKeysAndValues) {
  EXPECT_EQ(offered({"slagflow", "r"}), "run");
  EXPECT_EQ(offered({"slagflow", "run", "--s"}), "--set");
  EXPECT_EQ(offered({"slagflow", "run", "--set", "numerics.sk"}), "numerics.skin=");
  EXPECT_EQ(offered({"slagflow", "run", "--set", "numerics.viscous_step", "="}), "implicit explicit");
  EXPECT_EQ(offered({"slagflow", "run", "--set", "numerics.viscous_step", "=", "e"}), "explicit");
  EXPECT_EQ(offered({"slagflow", "help", "limits.max_s"}), "limits.max_speed");
  EXPECT_EQ(offered({"slagflow", "rheometry", "--model", "ur"}), "urbain");
}

TEST(ManPage, HoldsCommandsAndKeysWithoutACommandOfRoffInThem) {
  const CommandLine line{"what it does", {{"run", ".a run", {{"-o,--output", "DIR", "its folder"}}}}};
  const std::string page = man_page(line, "1.2");
  EXPECT_THAT(
      page, AllOf(HasSubstr("\\&.a run\n"), HasSubstr("\\fB\\-o,\\-\\-output\\fR DIR\n"), HasSubstr("1.2")));
  for (const CatalogueKey& k : catalogue().keys())
    EXPECT_THAT(page, HasSubstr(k.table.empty() ? ".SS " + k.inside + "\n" : "\\fB" + k.name + "\\fR"));
}

TEST(KeyHelp, HelpOfACommandShowsItsOptions) {
  const std::array<const char*, 3> words{"slagflow", "help", "rheometry"};
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_program(3, words.data()), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              AllOf(HasSubstr("--composition"), HasSubstr("--phases")));
}

TEST(KeyHelp, HelpOfWhatIsNotThereGivesTwo) {
  const std::array<const char*, 3> wrong{"slagflow", "help", "nothing_like_it"},
      right{"slagflow", "help", "skin"};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_program(3, wrong.data()), 2);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), StartsWith("error: help nothing_like_it:"));
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_program(3, right.data()), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), StartsWith("numerics.skin"));
}

}  // namespace
}  // namespace slagflow
