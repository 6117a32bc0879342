// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/odometry_noise.h"

#include <Eigen/Geometry>
#include <cmath>

#include "tagfield/base/range_check.h"
#include "tagfield/base/trigonometry.h"

namespace tagfield {
namespace {

struct Variances {
  double heading = 0.0;  ///< [rad²]
  double way = 0.0;      ///< [m²]
};

Variances variances_of(const PlanarPose& increment, const OdometryNoise& noise) {
  const double way = std::hypot(increment.x, increment.y);
  const double turn = std::abs(increment.yaw);
  const auto squared = [](double x) { return x * x; };
  return {squared(noise.alpha1) * turn + squared(noise.alpha2) * way,
          squared(noise.alpha3) * way + squared(noise.alpha4) * turn};
}

/// The direction of an arc's chord is the heading at the middle of the arc. Not computed from x and
/// y, which have no direction when a robot turns on the spot.
Eigen::Vector2d middle_heading(const PlanarPose& increment) {
  return {cosine(0.5 * increment.yaw), sine(0.5 * increment.yaw)};
}

}  // namespace

void check(const OdometryNoise& noise) {
  require_not_negative("alpha1", noise.alpha1);
  require_not_negative("alpha2", noise.alpha2);
  require_not_negative("alpha3", noise.alpha3);
  require_not_negative("alpha4", noise.alpha4);
}

PlanarPose noisy_increment(const PlanarPose& increment, const OdometryNoise& noise,
                           RandomStream& stream) {
  const Variances variances = variances_of(increment, noise);
  const auto [first_draw, second_draw] = standard_normal_pair(stream);
  // With correlation ½.
  const double sigma = std::sqrt(variances.heading / 3.0);
  const double first = sigma * first_draw;
  const double second = sigma * (0.5 * first_draw + std::sqrt(0.75) * second_draw);
  const double way = std::sqrt(variances.way) * standard_normal(stream);
  const Eigen::Vector2d p = rotation_in_plane(first) * (Eigen::Vector2d(increment.x, increment.y) +
                                                        way * middle_heading(increment));
  return {p.x(), p.y(), increment.yaw + first + second};
}

Eigen::Matrix3d increment_covariance(const PlanarPose& increment, const OdometryNoise& noise) {
  const Variances variances = variances_of(increment, noise);
  const Eigen::Vector2d u = middle_heading(increment);
  // Of n₁, n_s, n₂.
  Eigen::Matrix3d Q;
  Q << variances.heading / 3.0, 0.0, variances.heading / 6.0, 0.0, variances.way, 0.0,
      variances.heading / 6.0, 0.0, variances.heading / 3.0;
  Eigen::Matrix3d J;
  J << -increment.y, u.x(), 0.0, increment.x, u.y(), 0.0, 1.0, 0.0, 1.0;
  return J * Q * J.transpose();
}

Eigen::Matrix3d propagated_covariance(const Eigen::Matrix3d& covariance, const PlanarPose& q_OB,
                                      const PlanarPose& increment, const OdometryNoise& noise) {
  const auto [s, c] = sine_cosine(q_OB.yaw);
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -s * increment.x - c * increment.y;
  by_pose(1, 2) = c * increment.x - s * increment.y;
  Eigen::Matrix3d by_increment = Eigen::Matrix3d::Identity();
  by_increment.topLeftCorner<2, 2>() << c, -s, s, c;
  return by_pose * covariance * by_pose.transpose() +
         by_increment * increment_covariance(increment, noise) * by_increment.transpose();
}

Eigen::Vector2d increment_variances(const PlanarPose& increment, const OdometryNoise& noise) {
  const Variances variances = variances_of(increment, noise);
  return {variances.way, variances.heading};
}

}  // namespace tagfield
