// The key that names the faces through which fluid is meant to leave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/measures/losses.hpp"
#include "host/run/check.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::tiny_case;

Case with(const std::vector<std::string>& overrides, const std::string& departure = "remove") {
  return parse_case(tiny_case("0.004", departure), "tiny.toml", overrides);
}

std::string error_of(const std::vector<std::string>& overrides, const std::string& departure = "remove") {
  try {
    with(overrides, departure);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Exits, AreNoneUnlessNamed) {
  EXPECT_EQ(exits_of(with({})), "none");
  EXPECT_THAT(to_toml(with({})), HasSubstr("\nexits = []\n"));
}

TEST(Exits, AreFacesAndSurviveTheResolvedCase) {
  const Case c = with({R"(domain.exits=["-z", "+x"])"});
  EXPECT_EQ(c.exits, (std::array<bool, 6>{false, true, false, false, true, false}));
  EXPECT_EQ(exits_of(c), "+x, -z");
  EXPECT_EQ(parse_case(to_toml(c), "again.toml").exits, c.exits);
}

TEST(Exits, RefusesWhatIsNoFace) {
  EXPECT_THAT(error_of({R"(domain.exits=["down"])"}),
              HasSubstr("key 'domain.exits': value \"down\" is not a face: allowed: -x, +x, -y, +y, -z, +z"));
  EXPECT_THAT(error_of({"domain.exits=7"}), HasSubstr("domain.exits"));
}

TEST(Exits, RefusesFacesThatNothingLeavesThrough) {
  const std::string periodic = R"(domain.periodic=["x"])";
  EXPECT_THAT(error_of({periodic, R"(domain.exits=["+x"])", "domain.min=[-0.005,-0.005,-0.008]",
                        "domain.max=[0.015,0.015,0.02]"}),
              HasSubstr("value \"+x\" is a face of the periodic axis x: allowed: -y, +y, -z, +z"));
  EXPECT_THAT(error_of({"resolution.dimensions=2", R"(domain.exits=["+y"])"}),
              HasSubstr("value \"+y\" with two dimensions: allowed: -x, +x, -z, +z"));
  EXPECT_THAT(error_of({R"(domain.exits=["+x"])"}, "stop"), HasSubstr("domain.departure = \"stop\""));
}

TEST(Exits, CheckTellsThemAndWhatElseHappens) {
  const auto check = [](const Case& c) { return to_text(check_case(build_setup(c))); };
  EXPECT_THAT(check(with({R"(domain.exits=["-z"])"})),
              HasSubstr("exits            -z: what leaves through another face"));
  EXPECT_THAT(check(with({})),
              HasSubstr("exits            none: what leaves through a face of the domain is lost"));
  EXPECT_THAT(check(with({}, "stop")), HasSubstr("exits            none: the run ends with an error"));
}

}  // namespace
}  // namespace slagflow
