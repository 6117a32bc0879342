// SPDX-License-Identifier: Apache-2.0
#include "tagfield/poses/rigid_transform.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

double any_within(double most) { return most * (*rc::gen::inRange(-100'000, 100'001)) / 100'000.0; }

Eigen::Vector3d any_vector(double most) {
  return {any_within(most), any_within(most), any_within(most)};
}

RigidTransform any_transform() { return from_xyz_rpy(any_vector(50.0), any_vector(3.0)); }

Eigen::Matrix4d matrix_of(const RigidTransform& X) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = X.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = X.translation;
  return matrix;
}

bool near(const RigidTransform& a, const RigidTransform& b, double tolerance = 1e-12) {
  return (matrix_of(a) - matrix_of(b)).cwiseAbs().maxCoeff() < tolerance;
}

/// Rz(yaw) Ry(pitch) Rx(roll), multiplied out by hand.
Eigen::Matrix3d matrix_of_rpy(const Eigen::Vector3d& rpy) {
  const double cr = std::cos(rpy.x());
  const double sr = std::sin(rpy.x());
  const double cp = std::cos(rpy.y());
  const double sp = std::sin(rpy.y());
  const double cy = std::cos(rpy.z());
  const double sy = std::sin(rpy.z());
  Eigen::Matrix3d matrix;
  matrix << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,        //
      -sp, cp * sr, cp * cr;
  return matrix;
}

TEST(RigidTransform, TakesPointsFromTheInnerFrameToTheOuter) {
  // B is at (1, 2, 0) in A and faces along A's y.
  const RigidTransform X_AB = from_planar(1.0, 2.0, kPi / 2.0);
  EXPECT_TRUE((X_AB * Eigen::Vector3d(3.0, 0.0, 1.0)).isApprox(Eigen::Vector3d(1.0, 5.0, 1.0)));
}

TEST(AsRotation, KeepsUnitQuaternionsBitByBit) {
  const Eigen::Quaterniond almost(0.6 + 1e-12, 0.0, -0.8, 0.0);
  ASSERT_TRUE(as_rotation(almost));
  EXPECT_EQ(as_rotation(almost)->coeffs(), almost.coeffs());
}

TEST(AsRotation, NormalizesTheRoundedAndRefusesTheRest) {
  EXPECT_NEAR(as_rotation({0.71, 0.0, 0.0, 0.71})->norm(), 1.0, 1e-15);
  EXPECT_FALSE(as_rotation({0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(as_rotation({1.2, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(as_rotation({std::nan(""), 0.0, 0.0, 1.0}));
}

TEST(RigidTransform, BeginsAsTheIdentity) {
  EXPECT_EQ(matrix_of(RigidTransform()), Eigen::Matrix4d::Identity());
}

RC_GTEST_PROP(RigidTransform, ComposesAsMatricesDo, ()) {
  const RigidTransform X_AB = any_transform();
  const RigidTransform X_BC = any_transform();
  const Eigen::Matrix4d product = matrix_of(X_AB) * matrix_of(X_BC);
  RC_ASSERT((matrix_of(X_AB * X_BC) - product).cwiseAbs().maxCoeff() < 1e-12);
  const Eigen::Vector3d p_C = any_vector(20.0);
  RC_ASSERT(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm() < 1e-12);
}

RC_GTEST_PROP(RigidTransform, InverseUndoesIt, ()) {
  const RigidTransform X_AB = any_transform();
  RC_ASSERT(near(X_AB * X_AB.inverse(), RigidTransform(), 1e-13 * 100.0));
  RC_ASSERT(near(X_AB.inverse() * X_AB, RigidTransform(), 1e-13 * 100.0));
  RC_ASSERT((matrix_of(X_AB.inverse()) - matrix_of(X_AB).inverse()).cwiseAbs().maxCoeff() < 1e-11);
}

TEST(RigidTransform, StaysAUnitQuaternionOverManyProducts) {
  const RigidTransform step = from_xyz_rpy({0.0, 0.0, 0.0}, {0.1, 0.2, 0.3});
  RigidTransform product;
  for (int i = 0; i < 100'000; ++i) product = product * step;
  EXPECT_NEAR(product.rotation.norm(), 1.0, 1e-15);
}

TEST(FromTranslation, DoesNotTurn) {
  EXPECT_EQ(from_translation({1, 2, 3}) * Eigen::Vector3d(10, 0, 0), Eigen::Vector3d(11, 2, 3));
}

RC_GTEST_PROP(FromXyzRpy, IsYawThenPitchThenRoll, ()) {
  const Eigen::Vector3d rpy = any_vector(7.0);
  const RigidTransform X = from_xyz_rpy({1.0, 2.0, 3.0}, rpy);
  RC_ASSERT((X.rotation.toRotationMatrix() - matrix_of_rpy(rpy)).cwiseAbs().maxCoeff() < 1e-14);
  RC_ASSERT(X.translation == Eigen::Vector3d(1.0, 2.0, 3.0));
}

RC_GTEST_PROP(YawOf, ReturnsTheYawOfAPlanarPose, ()) {
  const double yaw = any_within(3.14159);
  RC_ASSERT(std::abs(yaw_of(from_planar(0.0, 0.0, yaw).rotation) - yaw) < 1e-14);
}

RC_GTEST_PROP(YawOf, IgnoresRollAndGentlePitch, ()) {
  const Eigen::Vector3d rpy(any_within(3.0), any_within(1.5), any_within(3.14));
  RC_ASSERT(std::abs(yaw_of(from_xyz_rpy({0, 0, 0}, rpy).rotation) - rpy.z()) < 1e-12);
}

TEST(YawOf, BackwardsIsPiInSize) {
  EXPECT_NEAR(std::abs(yaw_of(from_planar(0.0, 0.0, kPi).rotation)), kPi, 1e-15);
}

RC_GTEST_PROP(Interpolate, EndsAtBothEnds, ()) {
  const RigidTransform from = any_transform();
  const RigidTransform to = any_transform();
  RC_ASSERT(near(interpolate(from, to, 0.0), from));
  RC_ASSERT(near(interpolate(from, to, 1.0), to));
}

TEST(Interpolate, IsHalfWayInTheMiddle) {
  const RigidTransform middle =
      interpolate(from_planar(1.0, 0.0, 0.2), from_planar(3.0, 4.0, 1.0), 0.5);
  EXPECT_TRUE(near(middle, from_planar(2.0, 2.0, 0.6)));
}

RC_GTEST_PROP(Interpolate, TurnsAsEigensSlerp, ()) {
  const auto angle = [] { return 1e-3 * *rc::gen::inRange(-3141, 3142); };
  const auto any = [&] { return from_xyz_rpy({}, {angle(), angle(), angle()}); };
  const RigidTransform from = any();
  // Far from it, and as close as neighbouring poses.
  const RigidTransform near = from * from_xyz_rpy({}, {1e-6 * angle(), 0.0, 1e-9 * angle()});
  for (const RigidTransform& to : {any(), near}) {
    const double fraction = 0.01 * *rc::gen::inRange(0, 101);
    const Eigen::Quaterniond slerp = from.rotation.slerp(fraction, to.rotation);
    RC_ASSERT(interpolate(from, to, fraction).rotation.angularDistance(slerp) < 1e-7);
    RC_ASSERT(std::abs(interpolate(from, to, fraction).rotation.norm() - 1.0) < 1e-12);
  }
}

RC_GTEST_PROP(RotationInPlane, IsEigens, ()) {
  const double angle = 1e-3 * *rc::gen::inRange(-10'000, 10'000);
  RC_ASSERT((rotation_in_plane(angle) - Eigen::Rotation2Dd(angle).toRotationMatrix()).norm() <
            1e-15);
}

TEST(Interpolate, TurnsTheShorterWay) {
  // From 170° to -170° through 180°, whatever the sign of the quaternions.
  const RigidTransform from = from_planar(0.0, 0.0, radians(170.0));
  RigidTransform to = from_planar(0.0, 0.0, radians(-170.0));
  for (int sign = 0; sign < 2; ++sign) {
    EXPECT_TRUE(near(interpolate(from, to, 0.25), from_planar(0.0, 0.0, radians(175.0))));
    to.rotation.coeffs() = -to.rotation.coeffs();
  }
}

}  // namespace
}  // namespace tagfield
