// The declarations of keys: what the reader, the resolved case and the list of keys make of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/case/case_catalogue.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;

const char* const minimal = R"(
[case]
name = "small"
[resolution]
spacing = 1e-3
[fluid.oil]
density = 965
rheology = "newtonian"
dynamic_viscosity = 0.1
[[region]]
shapes = [{shape="sphere", center=[0,0,0], radius=0.005}]
[[wall]]
name = "floor"
shapes = [{shape="box", min=[-0.01,-0.01,-0.01], max=[0.01,0.01,-0.005]}]
[domain]
min = [-0.01, -0.01, -0.01]
max = [0.01, 0.01, 0.01]
[output]
end_time = 2
)";

std::string message_of(const std::vector<std::string>& overrides) {
  try {
    parse_case(minimal, "a.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Declares keys as a test wants them.
struct Declared {
  CaseCataloguer collect;
  double value = 1;

  void number(const char* name, const Range& range = at_least(0, "m")) {
    collect.number(key(name, "what it is"), value, range);
  }
  void with(const Words& types, const char* name, const Range& range = at_least(0, "m")) {
    if (const auto only = collect.only(true, {"type", types})) number(name, range);
  }
};

TEST(Catalogue, RefusesAKeyThatIsDeclaredTwice) {
  Declared twice;
  twice.number("radius");
  twice.number("height");
  EXPECT_THROW(twice.number("radius"), Error);
  EXPECT_THROW(twice.with({"ball"}, "height"), Error);
}

TEST(Catalogue, TakesAKeyOfTwoKindsOfEntriesUnlessTheyMeet) {
  Declared kinds;
  kinds.with({"ball"}, "radius");
  kinds.with({"pipe"}, "radius");
  kinds.with({"ball", "pipe"}, "density", above(0, "kg/m^3"));
  EXPECT_THROW(kinds.with({"pipe", "ring"}, "density"), Error);
  const std::vector<CatalogueKey> keys = kinds.collect.take();
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].where_text(), "type = \"ball\" or \"pipe\"");
}

TEST(Catalogue, KeepsApartWhatAKeyMayBeForEachKind) {
  Declared kinds;
  kinds.with({"ball"}, "radius", at_least(0, "m"));
  kinds.with({"pipe"}, "radius", at_least(0.5, "m"));
  EXPECT_EQ(kinds.collect.take().size(), 2u);
}

TEST(Catalogue, KnowsUnitRangeDefaultAndMeaning) {
  const CatalogueKey* const skin = catalogue().find("numerics", "skin");
  ASSERT_NE(skin, nullptr);
  EXPECT_EQ(skin->allowed, ">= 0.02 and <= 0.5");
  EXPECT_EQ(skin->fallback, "0.06");
  EXPECT_THAT(skin->meaning, HasSubstr("neighbour list"));
  EXPECT_EQ(catalogue().find("fluid.NAME", "density")->unit, "kg/m^3");
  EXPECT_EQ(catalogue().find("output", "until")->fallback, "\"end_time\"");
  EXPECT_THAT(catalogue().find("fluid.NAME", "yield_stress")->where[0].words,
              testing::ElementsAre("bingham", "herschel-bulkley", "casson", "bi-viscous"));
}

// Every key of the tables that a case has once, whatever else is given: in the resolved case at its default.
TEST(Catalogue, DefaultsAreThoseOfAResolvedCase) {
  const std::string written = to_toml(parse_case(minimal, "a.toml"));
  int compared = 0;
  for (const char* table : {"resolution", "gravity", "body_force", "domain", "numerics", "limits", "output"})
    for (const CatalogueKey* k : catalogue().in(table)) {
      if (k->need == Need::required || k->in_words || k->name == "scheme") continue;
      EXPECT_THAT(written, HasSubstr("\n" + k->name + " = " + k->fallback + "\n")) << table;
      ++compared;
    }
  EXPECT_GT(compared, 35);
}

bool assigns(const std::string& text, const std::string& name) {
  const auto holds = [&](const char* before) {
    return text.find(before + name + " = ") != std::string::npos;
  };
  return holds("\n") || holds("{") || holds(", ");
}

TEST(Catalogue, NamesTheKeysThatAResolvedCaseHolds) {
  const std::string written = to_toml(parse_case(minimal, "a.toml"));
  int held = 0;
  for (const CatalogueKey& k : catalogue().keys()) {
    const bool there = k.table != "region.N.waves.N" && k.table != "measure.N" && k.table != "inlet.N" &&
                       k.table != "region.N.fill" && k.table != "outlet.N" && k.name != "scheme" &&
                       k.table != "thermal";
    if (k.is_table() || !k.where.empty() || !there) continue;
    EXPECT_TRUE(assigns(written, k.name)) << k.path();
    ++held;
  }
  EXPECT_GT(held, 60);
}

TEST(CaseErrors, AKeyOfAnotherKindIsToldWhatItGoesWith) {
  EXPECT_THAT(message_of({"region.0.shapes.0.min=[0,0,0]"}),
              HasSubstr("key 'region.0.shapes.0.min': unknown: allowed: shape, center, radius, translate, "
                        "rotate, rotate_about, outside; min goes with "
                        "shape = \"box\""));
  EXPECT_THAT(
      message_of({"fluid.oil.yield_stress=3"}),
      HasSubstr("yield_stress goes with rheology = \"bingham\" or \"herschel-bulkley\" or \"casson\" or "
                "\"bi-viscous\""));
  EXPECT_THAT(message_of({"wall.0.motion={type='sine', frequency=1, velocity=[0,0,1]}"}),
              HasSubstr("velocity goes with type = \"constant\" or \"ramp\""));
}

TEST(CaseErrors, AKeyInTheWrongTableIsToldItsOwn) {
  EXPECT_THAT(
      message_of({"resolution.skin=0.1"}),
      HasSubstr("'resolution.skin': unknown: allowed: spacing, support_ratio, dimensions, origin; skin is a "
                "key of [numerics]"));
  EXPECT_THAT(message_of({"end_time=1"}), HasSubstr("; end_time is a key of [output]"));
}

TEST(CaseErrors, WhereTheKindIsNotKnownItsKeysAreNotBlamed) {
  const std::string said = message_of({"region.0.shapes.0.shape=bal"});
  EXPECT_EQ(said.find("radius"), std::string::npos) << said;
  EXPECT_THAT(message_of({"region.0.shapes.0.shape=bal", "region.0.shapes.0.radios=1"}),
              HasSubstr("'region.0.shapes.0.radios': unknown"));
}

}  // namespace
}  // namespace slagflow
