// Morris' factor of wall pairs.
#include <gtest/gtest.h>

#include "fluid/params.hpp"

namespace slagflow {
namespace {

constexpr Real dx = 1;
const Quad up{0, 0, 1, Real(0.5)}, none{};

double factor(Vec3 d, Quad face, Quad back, Real slip_length = 0) {
  return static_cast<double>(no_slip_factor(WallPairGeometry<Real, Quad>{d, face, back}, dx, slip_length));
}

TEST(NoSlip, MirrorsTheVelocityAtEqualDistances) {
  EXPECT_DOUBLE_EQ(factor({0, 0, 1}, up, none), 2);  // 0.5 below, 0.5 above
  EXPECT_DOUBLE_EQ(factor({3, 2, 1}, up, none), 2);  // only the distance along the normal counts
  EXPECT_DOUBLE_EQ(factor({0, 0, Real(2.5)}, up, none), 1.25);
}

TEST(NoSlip, IsBoundedCloseToTheSurfaceAndBehindIt) {
  for (Real z : {Real(0.7), Real(0.5), Real(0.2), Real(-1)}) EXPECT_EQ(factor({0, 0, z}, up, none), 3);
  const Quad deep{0, 0, 1, Real(2.5)};
  EXPECT_EQ(factor({0, 0, 3}, deep, none), 3);  // 1 + 2.5/0.5
}

TEST(NoSlip, BehindAPlateItsBackFaceCounts) {
  const Quad face{0, 0, 1, Real(0.5)}, back{0, 0, -1, Real(1.5)};
  EXPECT_DOUBLE_EQ(factor({0, 0, 1}, face, back), 2);             // above: 0.5 below, 0.5 above
  EXPECT_DOUBLE_EQ(factor({0, 0, Real(-4.5)}, face, back), 1.5);  // below: 1.5 behind, 3 before the back
  EXPECT_EQ(factor({0, 0, Real(-4.5)}, face, none), 3);
  EXPECT_EQ(factor({2, 0, Real(-1)}, face, back), 3);  // inside the plate
}

// u = G (height + b): the velocity 0.5 above the surface less that 0.5 below it is G, and the factor its
// ratio to the former.
TEST(NoSlip, ASlipLengthPutsTheZeroBehindTheSurface) {
  for (const Real b : {Real(0.25), Real(0.5), Real(2), Real(7.5)})
    EXPECT_NEAR(factor({0, 0, 1}, up, none, b), 1 / (0.5 + static_cast<double>(b)), 1e-6);
  EXPECT_NEAR(factor({0, 0, Real(0.4)}, up, none, Real(1)), 0.6, 1e-6);  // 0.25 + 0.5 over 0.25 + 1
  EXPECT_NEAR(factor({0, 0, 1}, up, none, Real(1e6)), 0, 2e-6);          // free slip
}

}  // namespace
}  // namespace slagflow
