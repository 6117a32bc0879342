// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/planar_pose.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace tagfield {
namespace {

PlanarPose any_pose() {
  return {*rc::gen::inRange(-10'000, 10'000) * 1e-3, *rc::gen::inRange(-10'000, 10'000) * 1e-3,
          *rc::gen::inRange(-10'000, 10'000) * 1e-3};
}

/// Reference from an independent library.
Eigen::Isometry2d isometry(const PlanarPose& pose) {
  return Eigen::Translation2d(pose.x, pose.y) * Eigen::Rotation2Dd(pose.yaw);
}

void expect_alike(const PlanarPose& pose, const Eigen::Isometry2d& X) {
  RC_ASSERT((isometry(pose).matrix() - X.matrix()).cwiseAbs().maxCoeff() < 1e-9);
}

RC_GTEST_PROP(Compose, IsTheProductOfTransforms, ()) {
  const PlanarPose a = any_pose();
  const PlanarPose b = any_pose();
  expect_alike(compose(a, b), isometry(a) * isometry(b));
}

RC_GTEST_PROP(Compose, IsAssociativeAndKeepsWholeTurns, ()) {
  const PlanarPose a = any_pose();
  const PlanarPose b = any_pose();
  const PlanarPose c = any_pose();
  expect_alike(compose(compose(a, b), c), isometry(compose(a, compose(b, c))));
  RC_ASSERT(std::abs(compose(a, b).yaw - (a.yaw + b.yaw)) < 1e-12);
}

RC_GTEST_PROP(Between, LeadsFromOneToTheOther, ()) {
  const PlanarPose a = any_pose();
  const PlanarPose b = any_pose();
  expect_alike(between(a, b), isometry(a).inverse() * isometry(b));
  expect_alike(compose(a, between(a, b)), isometry(b));
  const double yaw = between(a, b).yaw;
  RC_ASSERT(yaw >= -kPi && yaw < kPi);
}

RC_GTEST_PROP(Between, IsNothingFromAPoseToItself, ()) {
  const PlanarPose a = any_pose();
  const PlanarPose nothing = between(a, a);
  RC_ASSERT(std::abs(nothing.x) < 1e-12 && std::abs(nothing.y) < 1e-12 && nothing.yaw == 0.0);
}

RC_GTEST_PROP(Transformed, IsATransformOfAPoint, ()) {
  const PlanarPose a = any_pose();
  const PlanarPose b = any_pose();
  const Eigen::Vector2d p = position_of(any_pose());
  RC_ASSERT((transformed(a, p) - isometry(a) * p).norm() < 1e-9);
  RC_ASSERT((transformed(compose(a, b), p) - transformed(a, transformed(b, p))).norm() < 1e-9);
  // Distances are preserved.
  RC_ASSERT(std::abs((transformed(a, p) - position_of(a)).norm() - p.norm()) < 1e-9);
}

TEST(IsFinite, MindsEachNumber) {
  EXPECT_TRUE(is_finite(PlanarPose{1.0, -2.0, 3.0}));
  constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_finite(PlanarPose{kNever, 0.0, 0.0}));
  EXPECT_FALSE(is_finite(PlanarPose{0.0, -kFar, 0.0}));
  EXPECT_FALSE(is_finite(PlanarPose{0.0, 0.0, kNever}));
}

}  // namespace
}  // namespace tagfield
