// Vectors and matrices.
#include <gtest/gtest.h>

#include "fluid/math.hpp"

namespace slagflow {
namespace {

TEST(Vector3, CrossProductIsNormalToBothAndAntisymmetric) {
  const Vec3d a{1, -2, 3}, b{4, 5, -6};
  EXPECT_EQ(cross(a, b), (Vec3d{-3, 18, 13}));
  EXPECT_EQ(cross(b, a), -cross(a, b));
  EXPECT_EQ(dot(cross(a, b), a), 0);
}

TEST(Vector3, ArithmeticWorksByComponent) {
  Vec3d a{1, 2, 3};
  const Vec3d b{10, 20, 30};
  EXPECT_EQ(a + b, (Vec3d{11, 22, 33}));
  EXPECT_EQ(b - a, (Vec3d{9, 18, 27}));
  EXPECT_EQ(2.0 * a, (Vec3d{2, 4, 6}));
  EXPECT_EQ(a * 2.0, 2.0 * a);
  a[1] = 7;
  EXPECT_EQ(a, (Vec3d{1, 7, 3}));
  EXPECT_EQ(b[0] + b[1] + b[2], 60);
  EXPECT_FALSE(a == (Vec3d{1, 7, 4}));
}

TEST(Vector3, NormIsTheEuclideanLength) { EXPECT_DOUBLE_EQ(norm(Vec3d{2, 3, -6}), 7); }

TEST(Vector3, ToRealRoundsToNearest) {
  const double beyond = 1 + 1e-12;
  EXPECT_EQ(to_real(Vec3d{beyond, 0.5, -2}).x, static_cast<Real>(beyond));
  EXPECT_EQ(to_double(Vector3<float>{0.5F, 1, -2}), (Vec3d{0.5, 1, -2}));
}

TEST(Numbers, SmallerAndLargerKeepTheirFirstArgumentAgainstNotANumber) {
  const double nan = std::nan("");
  EXPECT_EQ(smaller(1.0, 2.0), 1);
  EXPECT_EQ(larger(1.0, 2.0), 2);
  EXPECT_EQ(smaller(1.0, nan), 1);
  EXPECT_EQ(larger(1.0, nan), 1);
  EXPECT_TRUE(std::isnan(larger(nan, 1.0)));
}

TEST(Quad, HoldsAVectorAndANumberAlignedForOneLoad) {
  const Quad q = quad(Vec3{1, 2, 3}, 4);
  EXPECT_EQ(xyz(q), (Vec3{1, 2, 3}));
  EXPECT_EQ(q.w, 4);
  EXPECT_EQ(alignof(Quad), 4 * sizeof(Real));
  EXPECT_EQ(sizeof(Quad), 4 * sizeof(Real));
}

TEST(Symmetric3, OuterProductProjectsOntoItsVector) {
  Symmetric3 m;
  const Vec3 s{1, -2, 3}, t{0, 4, 1}, v{5, 6, 7};
  m.add_outer(1, s);
  EXPECT_EQ(m * v, s * dot(s, v));
  m.add_outer(1, t);
  EXPECT_EQ(m * v, s * dot(s, v) + t * dot(t, v));
}

}  // namespace
}  // namespace slagflow
