// Numerics that do not go together, and spacings that single precision cannot carry.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

std::string message_with(const std::vector<std::string>& overrides) {
  try {
    parse_case(testing_tools::tiny_case(), "case.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CaseNumerics, AnExactYieldStressNamesWhatItCannotGoWith) {
  for (const char* other :
       {"numerics.theta=0.5", "numerics.operator=laplacian", "numerics.viscous_step=explicit"}) {
    const std::string message = message_with({"numerics.yield=exact", other});
    EXPECT_NE(message.find("with numerics.yield = \"exact\": allowed: "), std::string::npos) << message;
  }
  EXPECT_EQ(message_with({"numerics.yield=exact"}), "accepted");
}

TEST(CaseNumerics, SpacingsThatSinglePrecisionCannotCarryAreRefusedByTheYieldModel) {
  for (const auto& [spacing, regularised, exact] :
       {std::tuple{"1.9e-6", false, false}, std::tuple{"2e-6", true, false},
        std::tuple{"4.9e-6", true, false}, std::tuple{"5e-6", true, true}, std::tuple{"1e3", true, true},
        std::tuple{"1001", true, false}, std::tuple{"1e4", true, false}, std::tuple{"10001", false, false}})
    for (const bool is_exact : {false, true}) {
      const std::string message =
          message_with({std::string("resolution.spacing=") + spacing,
                        is_exact ? "numerics.yield=exact" : "numerics.yield=regularised"});
      const bool accepted = message.find("key 'resolution.spacing'") == std::string::npos;
      EXPECT_EQ(accepted, is_exact ? exact : regularised) << message;
    }
}

}  // namespace
}  // namespace slagflow
