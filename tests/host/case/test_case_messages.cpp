// How much is told of what is wrong, and of what.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <string>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing_tools::tiny_case;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "case.toml", overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

long lines_of(const std::string& text) { return 1 + std::count(text.begin(), text.end(), '\n'); }

TEST(CaseMessages, OfManyUnknownKeysTheFirstAreToldAndTheRestCounted) {
  std::string many = "[numerics]\n";
  for (int k = 0; k < 6000; ++k) many += "key" + std::to_string(k) + " = 1\n";
  const std::string message = error_of(replaced(tiny_case(), "[numerics]\n", many));
  EXPECT_EQ(lines_of(message), 21);
  EXPECT_THAT(message, AllOf(HasSubstr("'numerics.key19': unknown"), Not(HasSubstr("'numerics.key20'")),
                             HasSubstr("case.toml: 5980 more keys that are unknown")));
}

// Without waiting for who writes to it.
TEST(CaseMessages, APipeIsNoCase) {
  const testing_tools::TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "case.toml").c_str(), 0600), 0);
  EXPECT_THAT([&] { load_case(folder / "case.toml"); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("case.toml: cannot be read: allowed: a case file (TOML)")));
}

// It is the rheology, not a suspension.
TEST(CaseMessages, OfSeveralReasonsTheOneThatHoldsIsTold) {
  const std::string message =
      error_of(tiny_case(), {"fluid.oil.rheology=casson", "fluid.oil.plastic_viscosity=1"});
  EXPECT_THAT(message, AllOf(HasSubstr("'fluid.oil.plastic_viscosity': unknown"),
                             HasSubstr("plastic_viscosity goes with rheology = \"bingham\""),
                             Not(HasSubstr("suspension has"))));
}

TEST(CaseMessages, HabitsOfOtherLanguagesAreToldWhatToWrite) {
  const std::pair<const char*, const char*> lines[]{
      {"a = 2.700,0", "; a decimal point, and nothing between thousands"},
      {"a = 2700;", "; a line ends without a semicolon"},
      {"a = 2700 // slag", "; a comment begins with #"},
      {"a = 2.7*10^3", "; no arithmetic: write the number, as 2.6e3"},
      {"a = True", "; true and false are written so"},
      {"a = {b=1, outside=yes}", "; true and false are written so"},
      {"a = [{b=1}\n[c]", "; a bracket above it is not closed"}};
  for (const auto& [line, advice] : lines)
    EXPECT_THAT(error_of(std::string(line) + "\n"), AllOf(HasSubstr("not TOML"), testing::EndsWith(advice)))
        << line;
  EXPECT_THAT(error_of("[a]\n[a]\n"), Not(HasSubstr("bracket")));
}

TEST(CaseMessages, OfManyMistakesTheFirstHundredAreTold) {
  std::string regions;
  for (int k = 0; k < 300; ++k) regions += "[[region]]\nshapes = 1\n";
  const std::string message = error_of(replaced(tiny_case(), "[[wall]]", regions + "[[wall]]"));
  EXPECT_EQ(lines_of(message), 101);
  EXPECT_THAT(message, HasSubstr("200 more mistakes"));
}

TEST(CaseMessages, AllKeysOfATableAreListedThoughItsTypeIsWrong) {
  const std::string text = replaced(tiny_case(), "type = \"front\"", "type = \"frond\"\ndirektion = 1");
  EXPECT_THAT(
      error_of(text),
      AllOf(
          HasSubstr("did you mean 'front'?"),
          HasSubstr(
              "'measure.0.direktion': unknown: did you mean 'direction'? allowed: name, type, "
              "fraction, direction, position, lip, outward, bottom, min, max, solid_fraction, start, end, "
              "points, rows, across, wall, about, center, normal, height, width, up, fluid, cell, outlet")));
}

TEST(CaseMessages, KeysThatAreWrittenOtherwiseAreGuessed) {
  const auto guess = [](const std::string& key) {
    return error_of(tiny_case(), {"fluid.oil." + key + "=1"});
  };
  for (const char* key : {"viscosity", "Plastic-Viscosity", "plasticViscosity", "plastic_viscocity"})
    EXPECT_THAT(guess(key), HasSubstr("did you mean 'plastic_viscosity'?")) << key;
  EXPECT_THAT(guess("DENSITY"), HasSubstr("did you mean 'density'?"));
  EXPECT_THAT(guess("entirely_else"), Not(HasSubstr("did you mean")));
  EXPECT_THAT(error_of(tiny_case(), {"density=1"}), HasSubstr("density is a key of [fluid.NAME]"));
}

TEST(CaseMessages, AMisspeltTableGoesBeforeWhatIsMissing) {
  EXPECT_THAT(error_of(replaced(tiny_case(), "[domain]", "[domian]")),
              AllOf(StartsWith("case.toml:16: key 'domian': unknown: did you mean 'domain'?"),
                    HasSubstr("key 'domain.min': missing")));
  EXPECT_THAT(error_of(replaced(tiny_case(), "[fluid.oil]", "[fluids.oil]")),
              StartsWith("case.toml:5: key 'fluids': unknown: did you mean 'fluid'?"));
  EXPECT_THAT(error_of(tiny_case(), {"domian.max=[1,1,1]"}),
              StartsWith("--set domian.max=[1,1,1]: key 'domian': unknown: did you mean 'domain'?"));
}

TEST(CaseMessages, ATableThatOnlyAnOverrideNamesIsTold) {
  EXPECT_THAT(error_of(tiny_case(), {"fluid.oyl.density=900"}), HasSubstr("did you mean 'oil'?"));
}

TEST(CaseMessages, LongValuesAndKeysAreCut) {
  const std::string message =
      error_of(replaced(tiny_case(), "\"bingham\"", '"' + std::string(500, 'b') + '"'));
  EXPECT_THAT(message,
              AllOf(HasSubstr('"' + std::string(80, 'b') + "...\""), Not(HasSubstr(std::string(81, 'b')))));
  EXPECT_THAT(error_of(tiny_case(), {"numerics." + std::string(500, 'k') + "=1"}),
              Not(HasSubstr(std::string(81, 'k'))));
  // Not within a character.
  EXPECT_THAT(
      error_of(replaced(tiny_case(), "\"bingham\"", "\"a" + replaced(std::string(50, 'x'), "x", "") + "ä\"")),
      HasSubstr("ä"));
}

TEST(CaseMessages, BeyondTheLargestNumberThatIsTold) {
  for (const char* value : {"1e31", "inf", "1e400"})
    EXPECT_THAT(error_of(tiny_case(), {std::string("fluid.oil.plastic_viscosity=") + value}),
                HasSubstr("allowed: a number > 0.0 and <= 1e+30 [Pa s]"))
        << value;
}

// With a motion of so many rows, all in one line, then a mistake.
std::string with_rows(int rows) {
  std::string time, shift;
  for (int k = 0; k < rows; ++k) {
    time += (k == 0 ? "" : ", ") + std::to_string(0.001 * k);
    shift += std::string(k == 0 ? "" : ", ") + "[0.0, 0.0, " + std::to_string(1e-6 * k) + "]";
  }
  return replaced(tiny_case(), "name = \"floor\"\n",
                  "name = \"floor\"\nmotion = {type = \"table\", time = [" + time + "], displacement = [" +
                      shift + "]}\n");
}

TEST(CaseMessages, ALongLineIsReadInTimeAndKeepsTheNumbersOfLines) {
  const std::clock_t start = std::clock();
  const Case c = parse_case(with_rows(6000), "case.toml");
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2);
  EXPECT_EQ(c.walls[0].motion.time.size(), 6000U);
  EXPECT_NEAR(c.walls[0].motion.displacement.back().z, 5999e-6, 1e-12);
  EXPECT_THAT(error_of(replaced(with_rows(6000), "sound_speed = 5", "sound_speed = -5")),
              StartsWith("case.toml:22: key 'numerics.sound_speed'"));
  EXPECT_THAT(error_of(replaced(with_rows(6000), "sound_speed = 5", "sound_speed = ")),
              StartsWith("case.toml:22: not TOML"));
}

TEST(CaseMessages, StringsAndCommentsMayHoldBracketsAndDots) {
  const std::string wild(20000, '.');
  const std::string brackets(300, '[');
  for (const std::string& text :
       {"description = '" + wild + brackets + "'", "description = \"\\\"" + brackets + wild + "\"",
        "description = '''\n" + brackets + wild + "'''  # " + brackets})
    EXPECT_EQ(error_of(replaced(tiny_case(), "name = \"tiny\"", "name = \"tiny\"\n" + text)), "accepted");
  EXPECT_THAT(error_of(replaced(tiny_case(), "name = \"tiny\"", "description = 'a'\nx = " + brackets)),
              HasSubstr("case.toml:3: brackets nested deeper than 200"));
  std::string key = "a";
  for (int k = 0; k < 10001; ++k) key += ".a";
  EXPECT_THAT(error_of(key + " = 1\n"), HasSubstr("case.toml:1: a key with more than 10000 dots"));
}

TEST(CaseMessages, BackslashesOfPathsAreTold) {
  const auto with = [](const std::string& path) {
    return error_of(replaced(tiny_case(), "name = \"tiny\"", "name = \"tiny\"\ndescription = " + path));
  };
  for (const char* path : {R"("C:\Users\mould.stl")", R"("..\mould.stl")", R"("C:\temp\x.stl")"})
    EXPECT_THAT(with(path),
                HasSubstr("a backslash in \"...\" begins an escape: write / in paths, or single quotes"))
        << path;
  EXPECT_EQ(with(R"('C:\Users\mould.stl')"), "accepted");
  EXPECT_EQ(with(R"("C:\\Users\\mould.stl")"), "accepted");
}

TEST(CaseMessages, MeasuresAreLimited) {
  const auto with_volumes = [](int count) {
    std::string text = tiny_case();
    for (int k = 0; k < count; ++k)
      text +=
          "[[measure]]\nname = 'v" + std::to_string(k) + "'\ntype = 'volume'\nmin = [0,0,0]\nmax = [1,1,1]\n";
    return error_of(text);
  };
  EXPECT_EQ(with_volumes(254), "accepted");
  EXPECT_THAT(with_volumes(255),
              HasSubstr("key 'measure': 256 entries of type \"volume\": allowed: up to 255"));
}

TEST(CaseMessages, NamesAFileOfResults) {
  EXPECT_THAT(error_of(std::string("\x89HDF\r\n\x1a\n\0\0", 10)), HasSubstr("HDF5, as the results of a run"));
}

TEST(CaseMessages, SayWhereTheLeastIntervalComesFrom) {
  EXPECT_THAT(error_of("[output]\nend_time = 1e6\ninterval = 0.01\n"),
              HasSubstr("allowed: a number >= 1.0 [s, end_time / 1e+06]"));
}

}  // namespace
}  // namespace slagflow
