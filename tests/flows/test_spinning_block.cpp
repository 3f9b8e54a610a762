// A free block of Bingham fluid that spins as a rigid body keeps its angular momentum; div(eta grad v), which
// resists rotation, would lose 96 % of it in this time.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

TEST(SpinningBlock, KeepsItsAngularMomentum) {
  Flow flow("spinning_block.toml");
  const double start = norm(flow.simulation().totals().angular_momentum);
  ASSERT_GT(start, 0);
  flow.run(0.02);
  const double ratio = norm(flow.simulation().totals().angular_momentum) / start;
  std::printf("angular momentum after 20 ms: %.6f of the start\n", ratio);
  EXPECT_NEAR(ratio, 1, 0.01);
}

}  // namespace
}  // namespace slagflow
