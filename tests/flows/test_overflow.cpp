// A vessel that is fed until it runs over, and what its rims tell of that.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

TEST(Overflow, RectanglesOnTheRimsHaveAllThatTheVesselDoesNotHold) {
  const BuiltCase built =
      build_setup(load_case(std::string(SLAGFLOW_SOURCE_DIR) + "/cases/howto/overflow.toml"));
  const auto start = static_cast<std::int64_t>(built.setup.particles.position.size());
  EXPECT_EQ(start, 160);
  Simulation simulation(built.setup);
  const auto over = [](const Totals& t) {
    std::int64_t sum = 0;
    for (const FluxState& flux : t.fluxes) sum += flux.forward[0] - flux.backward[0];
    return sum;
  };
  std::int64_t most_held = 0;
  while (simulation.time() < 1.2) {
    for (int k = 0; k < 20; ++k) simulation.step();
    const Totals t = simulation.totals();
    most_held = std::max(most_held, t.boxes[0]);
    ASSERT_EQ(start + t.fed[0], t.boxes[0] + over(t)) << simulation.time();
  }
  const Totals t = simulation.totals();
  std::printf("fed %lld, held %lld, over the rims %lld and %lld\n", static_cast<long long>(t.fed[0]),
              static_cast<long long>(t.boxes[0]), static_cast<long long>(t.fluxes[0].forward[0]),
              static_cast<long long>(t.fluxes[1].forward[0]));
  EXPECT_GT(over(t), 50);
  EXPECT_GT(t.fluxes[0].forward[0], 20);
  EXPECT_GT(t.fluxes[1].forward[0], 20);
}

}  // namespace
}  // namespace slagflow
