// A free block of Bingham fluid that spins as a rigid body keeps its angular momentum; div(eta grad v), which
// resists rotation, loses nearly all of it.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

// What is left of the angular momentum after 20 ms.
double kept(const std::vector<std::string>& overrides) {
  Flow flow("spinning_block.toml", overrides);
  const double start = norm(flow.simulation().totals().angular_momentum);
  flow.run(0.02);
  const double ratio = norm(flow.simulation().totals().angular_momentum) / start;
  std::printf("angular momentum after 20 ms: %.6f of the start\n", ratio);
  return ratio;
}

TEST(SpinningBlock, KeepsItsAngularMomentum) { EXPECT_NEAR(kept({}), 1, 0.001); }

TEST(SpinningBlock, LosesItWithTheLaplacian) { EXPECT_LT(kept({"numerics.operator=laplacian"}), 0.1); }

}  // namespace
}  // namespace slagflow
