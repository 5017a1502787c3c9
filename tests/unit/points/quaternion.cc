#include "macro/points/quaternion.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(RotationVector, IsTheAxisTimesTheAngleWhicheverSignTheQuaternionHas) {
  for (const double angle : {-3.0, -0.7, -1e-9, 0.0, 1e-9, 0.7, 3.0})
    for (int axis = 0; axis < 3; ++axis) {
      const Quaternion q = about_axis(axis, angle);
      for (const Quaternion& same : {q, Quaternion{-q.w, -q.x, -q.y, -q.z}})
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(rotation_vector(same)[c], c == axis ? angle : 0, 1e-15) << angle;
    }
}

TEST(RotationVector, IsNeverLongerThanHalfATurn) {
  EXPECT_NEAR(rotation_vector(about_axis(0, 4))[0], 4 - 2 * std::numbers::pi, 1e-15);
}

TEST(FromZ, TurnsTheZAxisIntoTheVectorOnTheShortestWay) {
  for (const Vec3& a :
       {Vec3{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0.6, 0, -0.8}, {0.48, 0.6, 0.64}}) {
    const Quaternion q = from_z_to(a);
    const Vec3 turned = times(matrix_of(q), {0, 0, 1});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(turned[c], a[c], 1e-15);
    EXPECT_NEAR(norm(rotation_vector(q)), std::acos(a[2]), 1e-14);
  }
}

} // namespace
} // namespace spall::test
